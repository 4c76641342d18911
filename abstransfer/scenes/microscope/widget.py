"""The scene of page 3: Q-learning, one step after another, forward and back."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import traitlets

from ...learning.settings import Settings
from ...navigation import NavigationTasks, navigation_tasks
from ..base import MapTrait, Scene

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
    constants = {
        "bet": BET,
        "starts": {
            name: {"reward": reward, "q0": q0, "text": text}
            for name, (reward, q0, text) in STARTS.items()
        },
        "bets": {
            "bet": {
                "question": "Bet first: which start makes the robot visit most cells "
                f"in {BET} steps, on average?",
                "options": {name: text for name, (_, _, text) in STARTS.items()},
            }
        },
    }
    map = MapTrait(TWO_ROOMS)
    start = traitlets.Enum(tuple(STARTS), "goal").tag(sync=True)
    task = traitlets.Int(0, min=0).tag(sync=True)
    luck = traitlets.Int(4, min=1, max=99).tag(sync=True)
    t = traitlets.Int(111, min=0, max=STEPS).tag(sync=True)
    bet = traitlets.Unicode("").tag(sync=True, local=True)
    trace = traitlets.List().tag(sync=True, local=True)  # of a rule of the reader's own

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


def own_trace(tasks: NavigationTasks, q0: float, rng, update: Callable) -> list[list]:
    """
    Return the steps of a run whose values a function of the reader's own changes.

    Each is [state, action, how it was chosen, next state, reward, value before,
    value after, state the next step begins in].
    """
    from ...learning import loop  # it loads the compiler
    from ...learning._runs import RunState, set_up

    settings = Settings(tasks.mdp, q0=q0, trace=STEPS)
    setup = set_up(settings)
    run = RunState(setup, rng, settings.q0)
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
