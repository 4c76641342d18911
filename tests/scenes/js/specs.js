// Prints what each scene says of its state, as JSON, for the tests in Python.

import "./python.js";

const specs = {};
for (const name of Deno.args) {
  await import(`../../../abstransfer/scenes/${name}/${name}.js`);
  const { state, limits, local } = globalThis.python.spec;
  specs[name] = { state, limits, local };
}
console.log(JSON.stringify(specs));
