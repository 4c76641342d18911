// What Python says to a bundle, for tests that run without a page: a file of JSON that
// pytest has written, named on the command line.

import { readFileSync } from "node:fs";

globalThis.python = JSON.parse(readFileSync(Deno.args[0], "utf8"));
const { worker } = globalThis.python;
globalThis.python.worker = new Function("self", worker);
