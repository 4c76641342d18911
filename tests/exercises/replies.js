// Judges tables of answers as the page does.  Read is [tasks by id, [[id, answers], ...]];
// the replies are printed: for each id the [name, text] of each answer, in turn.

import { makeJudge } from "../../abstransfer/exercises/page/judge.js";

const [tasks, table] = await new Response(Deno.stdin.readable).json();
const replies = table.map(([id, answers]) => {
  const judge = makeJudge(tasks[id]);
  return answers.map((answer) => {
    const { name, text } = judge.reply(answer);
    return [name, text];
  });
});
console.log(JSON.stringify(replies));
