// What lets a page reply: bound to what the page holds, whatever that is.

import { bindBets } from "./bets.js";
import { bindMoments } from "./moments.js";
import { bindQuiz } from "./quiz.js";
import { bindReset } from "./reset.js";

bindBets();
bindQuiz();
bindMoments();
bindReset();
