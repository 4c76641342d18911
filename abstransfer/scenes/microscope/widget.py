"""The scene of page 3: Q-learning, one step after another, forward and back."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import traitlets

from ...learning import Learner, loop, q_learning
from ...learning._runs import RunState, set_up
from ...learning.settings import Settings
from ...navigation import NavigationTasks, navigation_tasks
from ...plotting.style import count, number
from ..base import MapTrait, Scene, Still
from ..parts.stills import building_svg

TWO_ROOMS = """\
+-----+-----+
|     |     |
|     |     |
|  *  |  *  |
|     |     |
|     |     |
+--d--+--d--+
|. . . . . .|
|           |
|. . . . . .|
+-----------+"""
STEPS = 300  # that can be looked at
BET = 100  # steps after which cells are counted
STARTS = {  # reward, value to start from, and how it is called
    "goal": ("goal", 0.0, "1 at the goal, Q starts at 0"),
    "cost": ("cost", 0.0, "\u22121 a step, Q starts at 0"),
    "low": ("cost", -10.0, "\u22121 a step, Q starts at \u221210"),
}


class Microscope(Scene):
    """
    Q-learning under the microscope: every step forward and back.

    Parameters
    ----------
    map : Map, text or name, default a building of two rooms
    start : {"goal", "cost", "low"}
        Reward 1 at the goal, or -1 a step with values that start at 0 or at -10.
    task : int
        Which of the map's goals, counted from 0.
    luck : int
        Seed of the run: that of :func:`abstransfer.learning.q_learning`.
    t : int
        The step that is looked at, 0 to 300.
    update : callable, optional
        Your own rule, in place of Eq. 1.  It is called after every step as
        ``update(q, s, a, r, s_next, alpha, gamma)`` with the values `q` (S, A) before
        the step, and returns the new value of ``q[s, a]``.  The run is computed here
        and shown in the browser, step by step, with the same luck as ever.

    Examples
    --------
    >>> Microscope(start="cost", t=24)
    Microscope(start='cost', t=24)
    >>> def forgetful(q, s, a, r, s_next, alpha, gamma):
    ...     return r + gamma * q[s_next].max()
    >>> scene = Microscope(update=forgetful)
    >>> len(scene.trace)
    300
    """

    scene = "microscope"
    map = MapTrait(TWO_ROOMS)
    start = traitlets.Enum(tuple(STARTS), "goal").tag(sync=True)
    task = traitlets.Int(0, min=0).tag(sync=True)
    luck = traitlets.Int(4, min=1, max=99).tag(sync=True)
    t = traitlets.Int(111, min=0, max=STEPS).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True)
    trace = traitlets.List().tag(sync=True)  # of a rule of the reader's own

    def __init__(self, *, update: Callable | None = None, **options):
        super().__init__(**options)
        self._update = update
        if update:
            self.observe(self._follow, ["map", "start", "task", "luck"])
            self._follow()

    @property
    def tasks(self) -> NavigationTasks:
        """The task of the scene; its states are the cells of the map."""
        task = min(self.task, len(self.map.goals) - 1)
        return navigation_tasks(self.map, reward=STARTS[self.start][0], keep=[task])

    def _follow(self, _=None):
        self.trace = own_trace(
            self.tasks, STARTS[self.start][1], self.luck, self._update
        )

    def still(self) -> Still:
        """Return three moments, and the cells visited from each start."""
        task = min(self.task, len(self.map.goals) - 1)
        counts = {
            start: _explored(self.map, start, task, self.luck) for start in STARTS
        }
        rows = [
            (STARTS[start][2], f"{cells[0]} of {self.map.n_cells}", number(cells[1]))
            for start, cells in counts.items()
        ]
        most = max(counts, key=lambda start: counts[start][1])
        least = min(counts, key=lambda start: counts[start][1])
        caption = (
            f"Q-learning, one step at a time. Within {BET} steps a robot with reward "
            f"{STARTS[most][2]}, has stood on {number(counts[most][1])} of "
            f"{self.map.n_cells} cells, on average over 20 seeds; with reward "
            f"{STARTS[least][2]}, on {number(counts[least][1])}. Values that start "
            "above what can be had make a robot look around."
        )
        head = (
            "reward and first values",
            f"cells visited in {BET} steps",
            "mean of 20",
        )
        moments = sorted({self.t or 1, (self.t + STEPS) // 2, STEPS})
        return Still([self._frame(t) for t in moments], caption, head, rows)

    def _frame(self, t: int) -> str:
        tasks, (_, q0, _) = self.tasks, STARTS[self.start]
        q = np.full(tasks.available.shape, q0)
        if self.trace:
            for s, a, *_, after, _ in self.trace[:t]:
                q[s, a] = after
            robot = self.trace[t - 1][3]
        else:
            learned = q_learning(tasks.mdp, t, rng=self.luck, q0=q0, trace=t)
            q, robot = learned.q, learned.trace.next_state[-1]
        best = np.where(tasks.mdp.terminal, np.nan, q.max(axis=1))
        known = np.append(best[np.isfinite(best)], 0.2 if self.start == "goal" else 0.0)
        texts = [_short(v) if v not in (q0,) and v == v else "" for v in best]
        n_new = sum(map(bool, texts))
        changed = f"{count(n_new, 'cell')} of {len(best)} changed their value"
        alt = f"The building after step {t}: {changed}."
        limits = known.min(), known.max()
        return building_svg(
            self.map,
            alt,
            values=best,
            limits=limits,
            texts=texts,
            robot=robot,
            goal=tasks.goal[0],
        )


def _short(v: float) -> str:
    """Return a value as it fits into a cell."""
    return number(v, 2).replace("0.", ".")


def own_trace(tasks: NavigationTasks, q0: float, rng, update: Callable) -> list[list]:
    """
    Return the steps of a run whose values a function of the reader's own changes.

    Each is [state, action, how it was chosen, next state, reward, value before,
    value after, state the next step begins in].
    """
    settings = Settings(tasks.mdp, q0=q0, trace=STEPS)
    setup = set_up(settings)
    run = RunState(setup, rng)
    q = run.plain.q
    rows = []
    for t in range(1, STEPS + 1):
        before = q[:, : tasks.mdp.n_actions].copy()
        record = run.who[t - 1 :], run.what[t - 1 :]
        world, guide, rule = setup.world, setup.guide, setup.rule
        loop.learn(t, t, world, guide, rule, run.plain, *record)
        s, a, how, s_next = map(int, run.who[t - 1])
        reward = float(run.what[t - 1, 0])
        after = float(update(before, s, a, reward, s_next, rule.alpha, rule.gamma))
        if not np.isfinite(after):
            raise ValueError(
                f"update must return a finite number, got {after} in step {t}"
            )
        q[s, a] = after
        here = int(run.plain.place[0])
        rows.append([s, a, how, s_next, reward, float(before[s, a]), after, here])
    return rows


def _explored(map_, start: str, task: int, luck: int) -> tuple[int, float]:
    """Return the cells visited with this luck, and the mean over seeds 1 to 20."""
    reward, q0, _ = STARTS[start]
    mdp = navigation_tasks(map_, reward=reward, keep=[task]).mdp
    learner = Learner(mdp, rngs=[luck, *range(1, 21)], q0=q0, trace=BET)
    learner.advance(BET)
    traces = [result.trace for result in learner.results()]
    cells = [len({*trace.state, *trace.next_state}) for trace in traces]
    return cells[0], float(np.mean(cells[1:]))
