// The ballot box, page 5: states that look alike vote for what is best in them; a dial
// makes a page of advice of the votes, from ND (0) over Prob (1) to the winner.

(function ballot(at) {
  "use strict";

  const { A, LAST, STEP, WINNER, BETAS, pageOf, betaText } = at.ballot;
  const PAGES = { nd: [0, "ND"], prob: [1, "Prob"], winner: [WINNER, "Winner"] };
  const MORE = { between: "yes, between ND and Prob", beyond: "yes, between Prob and the winner", no: "no" };
  const SIDES = [["small", "source", "dial-hard"], ["large", "map", "dial-soft"]];

  at.scene("ballot", {
    title: "The ballot box",
    state: {
      map: at.mapTexts?.target ?? "", source: at.mapTexts?.source ?? "", z: 19, task: 7, beta: 1,
      bet: "", bet_more: "",
    },
    limits: { z: [0, 2 ** 11 - 1], task: [0, 999], beta: [0, WINNER] },
    local: ["bet", "bet_more"],

    build(scene) {
      const { ui } = at;
      const { make, number, plural } = ui;
      const { state } = scene;
      let sides; // of both buildings: map, and its tasks as far as they are made
      let election = null; // null until all votes are counted
      let drives = {}; // by beta: what the page is worth in both buildings
      let shown = null; // the task that is seen
      let timer = null;

      const words = make("p", {});
      const steps = [["A box with more votes", -1], ["A box with fewer votes", 1]].map(([text, by]) =>
        ui.button(text, () => scene.set({ z: election.boxes[place() + by] })),
      );
      const view = ui.building({
        label: "The small building: the states of the box are lit, arrows are their votes",
        describe: (cell) => describe(cell),
        onAct: ({ cell }) => act(cell),
        keys: [["Enter, Space", "open the box of the cell; on a hollow star: make it the goal"]],
      });
      const cast = ui.barChart({ label: "Votes in the box", format: (x) => number(x), low: 0 });
      const chances = ui.barChart({ label: "Probabilities on the page", format: (x) => number(x, 3), low: 0, high: 1 });
      const now = make("p", {});
      const y = { label: "Mean value of a cell if the whole page is obeyed", format: (v) => number(v, 0) };
      const chart = ui.lineChart({
        label: "What the whole page is worth, by beta", height: 260, y,
        x: { label: "β (ND at 0, Prob at 1)", format: (beta) => number(beta, 0), min: 0, max: LAST + 1 },
      });
      const note = make("p", { class: "ab-note" }, "Hollow, in colour, at 0 and 1: the paper's ND and Prob.");
      const found = make("div", { class: "ab-scene" }, now, chart.node, note);
      const column = (...nodes) => make("div", { class: "ab-scene" }, nodes);
      const goals = () => sides?.[0].map.goals ?? [];
      scene.add(
        words,
        scene.row(...steps.map(({ node }) => node)),
        make(
          "div", { class: "ab-columns" },
          column(scene.slider("task", { label: "Goal", step: 1, format: (n) => `${n + 1} of ${goals().length}` }), view.node),
          column(
            make("p", {}, "Votes in this box:"), cast.node,
            scene.slider("beta", { label: "The dial: β", format: betaText, step: STEP }),
            make("p", {}, "So the page of advice says, with what probability:"), chances.node,
          ),
        ),
        scene.bet("bet", {
          question: "Bet first: which page drives best in the small building, where the votes were cast?",
          options: Object.fromEntries(Object.entries(PAGES).map(([key, [, name]]) => [key, name])),
        }),
        scene.bet("bet_more", { question: "And is there a page that beats all three and needs nothing but the same votes?", options: MORE }),
        found,
      );
      scene.onLeave(() => clearTimeout(timer));

      // ---- the election, and drives along the dial, in slices

      function begin() {
        sides = SIDES.map(([, of]) => ({ map: at.parseMap(state[of]), each: [] }));
        scene.limit("task", [0, goals().length - 1]);
        view.map(sides[0].map, { aim: goals()[state.task] });
        [election, drives, shown] = [null, {}, null];
        start(work());
      }
      function start(job) {
        clearTimeout(timer);
        timer = setTimeout(advance, 0, job);
      }
      function advance(job) {
        const end = performance.now() + 15;
        let done = false;
        while (!done && performance.now() < end) ({ done } = job.next());
        timer = null;
        if (!done) start(job);
        scene.redraw();
      }
      function* work() {
        const [home, { map, each }] = sides;
        election = yield* at.ballot.elect(home.map, home.each);
        for (let task = 0; task < map.goals.length; task++) {
          each.push(at.navigationTasks(map, { keep: [task] }));
          yield;
        }
        yield* driveAll();
      }
      // Where the reader stands comes first, then the three pages.
      const next = () => [state.beta, 0, 1, ...BETAS.slice(-1), ...BETAS].find((beta) => !drives[beta]);
      function* driveAll() {
        for (let beta; (beta = next()) !== undefined; ) {
          const page = pageOf(election.prob, beta);
          const means = [];
          for (const { each } of sides) means.push(yield* at.ballot.drive(each, page));
          drives[beta] = means;
        }
      }

      // ---- one box

      const place = () => election.boxes.indexOf(state.z);
      const row = (array, z) => array.subarray(A * z, A * z + A);
      const sight = (a) => ui.sight(at.LABELS[a]);
      const actions = () => [...at.LABELS.keys()].filter((a) => row(shown.possible, state.z)[a]);
      const chance = (beta) => pageOf(row(election.prob, state.z), beta);

      function describe(cell) {
        const where = ui.place(view.plan, cell);
        if (!shown) return where;
        if (shown.terminal[cell]) return `${where}: the goal, which has no vote`;
        const star = goals().includes(cell) ? "the goal of another task; " : "";
        const votes = row(shown.best, cell);
        return `${where}: ${star}votes for ${ui.list(actionsWith(votes))}`;
      }
      const actionsWith = (votes) => [...votes.keys()].filter((a) => votes[a]).map(sight);
      function act(cell) {
        const other = goals().indexOf(cell);
        if (!shown) return;
        if (shown.terminal[cell]) scene.say("This is the goal: it has no vote.");
        else scene.set(other >= 0 ? { task: other } : { z: shown.rho[cell] });
      }
      function showBox() {
        const { boxes, votes, states } = election;
        const { rho, terminal, labels, best, nWays } = shown;
        const isHere = (cell) => rho[cell] === state.z && !terminal[cell];
        const here = [...rho.keys()].filter(isHere);
        view.lit(here);
        view.arrows(Float64Array.from(labels, (a, i) =>
          a >= 0 && isHere(i >> 2) ? best[A * (i >> 2) + a] / nWays[A * (i >> 2) + a] : 0,
        ));
        view.rename();
        words.textContent = place() < 0
          ? `No state of the small building looks like this: ${ui.sights(state.z)}. Every action that is available gets the same chance.`
          : `Box ${place() + 1} of ${boxes.length}: ${ui.sights(state.z)}. ${plural(states[state.z], "state")} of ` +
            `${plural(goals().length, "task")} vote here, ${here.length} of them in the task shown.`;
        steps[0].enable(place() > 0);
        steps[1].enable(place() >= 0 && place() < boxes.length - 1);
        const bars = (values) => actions().map((a) => ({ name: sight(a), value: values[a] }));
        cast.set(bars(row(votes, state.z)));
        chances.set(bars(chance(state.beta)));
      }

      // ---- the whole page

      const hasBet = () => state.bet && state.bet_more;
      const isDone = () => election && next() === undefined;
      const value = (beta, side, digits = 1) => (drives[beta] ? number(drives[beta][side], digits) : "…");
      const best = (side) => BETAS.reduce((a, b) => (drives[b][side] > drives[a][side] ? b : a));

      function showPage() {
        found.hidden = !hasBet();
        if (found.hidden) return;
        now.textContent =
          `At β = ${betaText(state.beta)} the whole page is worth ${value(state.beta, 0, 2)} a cell in the small building, ` +
          `${value(state.beta, 1, 2)} in the large one.`;
        const known = BETAS.filter((beta) => beta <= LAST && drives[beta]);
        const curves = SIDES.flatMap(([name, , arm], side) => [
          { arm, points: known.map((beta) => [beta, drives[beta][side]]) },
          { name, arm, points: drives[WINNER] ? [[LAST + 1, drives[WINNER][side]]] : [] },
        ]);
        const isPapers = SIDES.every(([, of]) => state[of] === scene.spec.state[of]);
        note.hidden = !isPapers;
        if (isPapers) for (const paper of [at.PAPER.source, at.PAPER.target]) {
          for (const [key, beta] of [["nd", 0], ["prob", 1]]) curves.push({ arm: `${key}-soft`, points: [[beta, paper[key]]] });
        }
        const values = curves.flatMap(({ points }) => points.map(([, v]) => v));
        [y.min, y.max] = values.length ? [Math.min(...values) - 2, 0.9 * Math.max(...values)] : [-100, 0]; // room for words
        const marks = [{ x: LAST + 1, label: "winner" }];
        if (isDone()) marks.push({ x: Math.min(best(0), LAST + 1), label: "best" });
        chart.set({ curves, marks, cursor: state.beta > LAST ? LAST + 1 : state.beta });
      }
      function closing() {
        if (!hasBet() || !isDone()) return "";
        const worth = (beta) => drives[beta][0];
        const top = Object.keys(PAGES).reduce((a, b) => (worth(PAGES[b][0]) > worth(PAGES[a][0]) ? b : a));
        const isMore = worth(best(0)) > worth(PAGES[top][0]) + 1e-9;
        const side = (i) =>
          `β = ${betaText(best(i))} with ${value(best(i), i)} a cell (${Object.values(PAGES).map(([beta, name]) => `${name} ${value(beta, i)}`).join(", ")})`;
        return (
          `${scene.betResult("bet", top)} ${scene.betResult("bet_more", isMore ? (best(0) < 1 ? "between" : "beyond") : "no")} ` +
          `Of ${BETAS.length} places of the dial, best in the small building is ${side(0)}; in the large one ${side(1)}.`
        ).trim();
      }
      function twin() {
        const places = [state.beta, 0, 1, WINNER];
        const rows = places.map(chance);
        const whole = SIDES.map(([name], side) => [
          `the whole page, ${name} building`, "", ...places.map((beta) => (hasBet() ? value(beta, side, 8) : "–")),
        ]);
        return {
          caption: `${words.textContent} Probabilities in this box, and mean values of the whole page.`,
          head: ["action", "votes", `β = ${betaText(state.beta)}`, "ND", "Prob", "winner"],
          rows: [...actions().map((a) => [sight(a), number(row(election.votes, state.z)[a], 4), ...rows.map((p) => number(p[a], 6))]), ...whole],
        };
      }

      return function draw(_, changed) {
        if (changed.has("map") || changed.has("source")) begin();
        if (!election) {
          words.textContent = `Counting the votes of ${plural(goals().length, "task")} …`;
          found.hidden = true;
          return scene.close(false);
        }
        shown = sides[0].each[state.task];
        view.map(sides[0].map, { aim: shown.goal[0] });
        if (!timer && !isDone()) start(driveAll());
        showBox();
        showPage();
        if (changed.has("beta") && hasBet()) scene.say(now.textContent);
        else if (changed.has("z") || changed.has("task")) scene.say(words.textContent);
        scene.twin(twin);
        scene.close(closing());
      };
    },
  });
})((globalThis.abstransfer ??= {}));
