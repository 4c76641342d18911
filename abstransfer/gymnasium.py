"""
The navigation tasks as an environment of Gymnasium, for learners that others wrote.

Importing this module registers ``abstransfer/Navigation-v0``; it needs the extra
``abstransfer[gymnasium]``.  Our own loops do not go through it: a call for each step
takes hundreds of times as long.
"""

from __future__ import annotations

import gymnasium
import numpy as np
from gymnasium.spaces import Discrete

from .learning._rng import STARTS, STEPS, next_word, seed_state
from .learning._tables import make_world
from .learning.settings import Settings
from .maps import ROOM, Map, read_map
from .navigation import navigation_tasks

ID = "abstransfer/Navigation-v0"


class Navigation(gymnasium.Env):
    """
    A robot in a building: one task and one start an episode, drawn anew each time.

    An observation is a state of ``tasks.mdp``, a task and a cell; an action is a label,
    go to what I see.  An episode ends at the goal; Gymnasium cuts it after
    ``max_episode_steps``, 5000 by default as in ``q_learning``.  ``info`` holds
    ``task``, ``cell``, ``rho`` (the abstract state), ``action_mask`` (what leads
    anywhere) and ``luck``, a random word of 32 bits: who chooses the next action by it,
    as ``learning.loop`` does, repeats with the same seed a run of ``q_learning``.

    Parameters
    ----------
    maps : Map, name or path, or several
    render_mode : {"ansi", "rgb_array"}, optional
    **options
        Those of :func:`abstransfer.navigation.navigation_tasks`, as ``reward="goal"``.

    Examples
    --------
    >>> env = gymnasium.make(ID, maps="source", reward="goal", render_mode="ansi")
    >>> state, info = env.reset(seed=1, options={"task": 0, "cell": 78})
    >>> state, info["task"], info["cell"]
    (78, 0, 78)
    >>> env.step(0)[1:4]  # reward, at the goal, cut
    (0.0, False, False)
    """

    metadata = {"render_modes": ["ansi", "rgb_array"], "render_fps": 4}

    def __init__(self, maps="source", *, render_mode=None, **options):
        modes = (None, *self.metadata["render_modes"])
        if render_mode not in modes:
            raise ValueError(f"render_mode must be one of {modes}, got {render_mode!r}")
        several = maps if isinstance(maps, (list, tuple)) else [maps]
        maps = [map_ if isinstance(map_, Map) else read_map(map_) for map_ in several]
        self.tasks = navigation_tasks(maps, **options)
        self.render_mode = render_mode
        mdp = self.tasks.mdp
        self.observation_space = Discrete(mdp.n_states)
        self.action_space = Discrete(mdp.n_actions)
        self._world = make_world(mdp, Settings(mdp).start)
        self._words = None  # of the generators of steps and of starts
        self._state = None

    def reset(self, *, seed=None, options=None):
        """Begin an episode; `options` may name its ``task``, its ``cell``, or both."""
        super().reset(seed=seed)
        if seed is not None or self._words is None:
            self._words = seed_state(self.np_random if seed is None else seed)
            self._luck = int(next_word(self._words[STEPS]))
        start, named = self._world.start, dict(options or {})
        for name in ("task", "cell"):
            if name in named:
                start = start[getattr(self.tasks, name)[start] == named.pop(name)]
        if named or not len(start):
            wanted = "a task, a cell that is not its goal, or both"
            raise ValueError(f"options must name {wanted}, got {options!r}")
        word = int(next_word(self._words[STARTS]))
        self._state = int(start[word * len(start) >> 32])
        return self._state, self._info()

    def step(self, action):
        """Take an action; one that leads nowhere spends a step."""
        world, s = self._world, self._state
        if s is None or world.terminal[s]:
            raise ValueError("no episode is going on; call reset")
        fate = int(next_word(self._words[STEPS]))
        k = int(np.searchsorted(world.bound[s, action], fate, side="right"))
        s = self._state = int(world.next_state[s, action, k])
        self._luck = int(next_word(self._words[STEPS]))
        return s, float(world.reward[s]), bool(world.terminal[s]), False, self._info()

    def render(self):
        """Return the building as text, or as an array (height, width, 3) of bytes."""
        if self.render_mode is None or self._state is None:
            return None
        task, cell = self.tasks.task[self._state], int(self.tasks.cell[self._state])
        map_, goal = self.tasks.maps[self.tasks.building[task]], self.tasks.goal[task]
        if self.render_mode == "ansi":
            return _text(map_, goal, cell)
        from .plotting import pixels

        return pixels(map_, goal, cell)

    def _info(self) -> dict:
        s, tasks = self._state, self.tasks
        found = {name: int(getattr(tasks, name)[s]) for name in ("task", "cell", "rho")}
        mask = tasks.available[s].astype(np.int8)
        return found | {"action_mask": mask, "luck": self._luck}


def _text(map_: Map, goal: int, cell: int) -> str:
    """Return a map with its one goal, and the robot as "@"."""
    chars, others = map_.chars.copy(), np.setdiff1d(map_.goals, goal)
    for where, char in ((others, ROOM), (cell, "@")):
        row, column = np.divmod(where, map_.shape[1])
        chars[2 * row + 1, 2 * column + 1] = char
    return "\n".join("".join(line) for line in chars)


gymnasium.register(ID, entry_point=Navigation, max_episode_steps=Settings.max_episode)
