"""The scene of page 0: robots that differ in the advice they get learn side by side."""

from __future__ import annotations

import traitlets

from ...experiments.arms import ARMS, PAPER_STEPS, Arm
from ...experiments.problem import target_tasks
from ...learning import q_learning
from ...plotting.buildings import place
from ..base import Still
from ..parts.curves import curves_svg
from ..parts.runs import NAMES, PolicyTrait, RunScene, scaled
from ..parts.stills import CELL, building_svg, paint

FIRST = 1000  # steps that can be looked at
RACERS = ("none", "rand-hard", "prob-hard", "nd-hard")
LETTERS = {"none": "Q", "rand": "R", "prob": "P", "nd": "N", "yours": "Y"}


class Race(RunScene):
    """
    Four robots in one building: which advice helps most to learn?

    They share the tasks, the starts and the luck; one gets no advice, the others
    random advice, that of Prob and that of ND.

    Parameters
    ----------
    policy : ndarray of float, shape (Z, A), optional
        Your own abstract policy: a fifth robot that it advises joins the race.
    tau : int
        Steps for which your policy advises, out of 30 million.
    luck : int
        Run of the stored experiments, 1 to 50: the random numbers are the same.
    t : int
        The step that is looked at, 0 to 1000.
    full : bool
        Whether all steps are learned.
    map, source : Map, text or name
        Where the robots learn, and where the advice comes from.
    steps : int
        Length of a run.

    Examples
    --------
    >>> Race(t=76)
    Race(t=76)
    >>> scene = Race()
    >>> scene.goals  # by robot and window, once the page has learned all steps
    {}
    """

    scene = "race"
    luck = traitlets.Int(8, min=1, max=50).tag(sync=True)
    t = traitlets.Int(39, min=0, max=FIRST).tag(sync=True)
    policy = PolicyTrait()
    tau = traitlets.Int(3_500_000, min=0, max=PAPER_STEPS).tag(sync=True)
    full = traitlets.Bool(False).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True)
    goals = traitlets.Dict().tag(sync=True)

    @property
    def arms(self) -> tuple[Arm, ...]:
        """Those who race."""
        arms = sorted(
            (arm for arm in ARMS if arm.name in RACERS),
            key=lambda arm: RACERS.index(arm.name),
        )
        if self.policy is not None:
            arms.append(Arm("yours", "yours", "hard", self.tau))
        return tuple(arms)

    def first_steps(self, arm: Arm):
        """Return the trace of the first 1000 steps of an arm."""
        tasks = target_tasks(self.problem)
        guide = self.advice(arm)
        tau = 0 if guide is None else scaled(arm, self.steps)
        return q_learning(
            tasks.mdp, FIRST, rng=self.seed, guide=guide, tau=tau, trace=FIRST
        ).trace

    def still(self) -> Still:
        """Return the start, the robots on their way, and all steps of all runs."""
        runs = {arm.guide or "none": self.learn(arm) for arm in self.arms}
        order = sorted(runs, key=lambda name: -runs[name].sum())
        best, steps = order[0], f"{self.scale.steps / 1e6:g} million steps"
        each = [f"{NAMES[name]} {runs[name].sum():,}" for name in order]
        caption = (
            f"The race: robots that differ only in the advice they get. In {steps}, "
            f"with the luck of run {self.luck}, the robot that {_got(best)} reached "
            f"most goals: {', '.join(each)}."
        )
        alt = f"Goals in {steps}: {', '.join(each)}."
        look = {"yours": "uniform_available"}
        curves = curves_svg(
            {look.get(name, name): goals for name, goals in runs.items()},
            alt,
            names={look.get(name, name): NAMES[name] for name in runs},
            steps=self.scale.steps,
        )
        half = self.scale.steps // 2
        rows = [
            (
                f"{NAMES[name]} ({LETTERS[name]})",
                f"{runs[name][: len(runs[name]) // 2].sum():,}",
                f"{runs[name].sum():,}",
            )
            for name in order
        ]
        head = ("advice", f"goals in the first {half / 1e6:g} million", "goals in all")
        return Still([*self._moments(), curves], caption, head, rows)

    def _moments(self) -> list[str]:
        """Return the building at the start, and at the step that is looked at."""
        traces = {arm.guide or "none": self.first_steps(arm) for arm in self.arms}
        n_cells = self.map.n_cells
        start = int(traces["none"].state[0])
        goal = int(target_tasks(self.problem).goal[start // n_cells])
        where = place(self.map, start % n_cells, "")
        begin = building_svg(
            self.map,
            f"All robots start in{where}, with one goal.",
            robot=start % n_cells,
            goal=goal,
        )
        t = max(self.t, 1)
        letters = {}
        for name, trace in traces.items():
            cell = int(trace.next_state[t - 1]) % n_cells
            letters[cell] = letters.get(cell, "") + LETTERS[name]
        key = ", ".join(f"{LETTERS[name]} {NAMES[name]}" for name in traces)
        alt = f"Where the robots are after step {t}: {key}."
        later = building_svg(self.map, alt, goal=goal)
        robots = "".join(
            _robot(*divmod(cell, self.map.shape[1]), text)
            for cell, text in letters.items()
        )
        return [begin, later.replace("</svg>", robots + "</svg>")]


def _robot(row: int, column: int, text: str) -> str:
    """Return a robot, or several in one cell, larger than the cell, by letters."""
    x, y, half = CELL * (column + 0.5), CELL * (row + 0.5), 9 + 6 * len(text)
    style = f"fill:{paint('ground')};stroke:{paint('ink')};stroke-width:2"
    return (
        f'<rect x="{x - half:g}" y="{y - 14:g}" width="{2 * half}" height="28" rx="14" '
        f'style="{style}"/><text x="{x:g}" y="{y:g}" dy=".35em" '
        f'style="font-size:20px">{text}</text>'
    )


def _got(name: str) -> str:
    return {
        "none": "got no advice",
        "rand": "got random advice",
        "yours": "your policy advised",
    }.get(name, f"{NAMES[name]} advised")
