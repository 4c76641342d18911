"""What the scenes of learning share: the problem, and runs of it at full scale."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from functools import lru_cache

import numpy as np
import traitlets

from ...builders import BUILDERS
from ...experiments.arms import PAPER_STEPS, SCALES, Arm, Scale
from ...experiments.plan import SEED, STREAMS
from ...experiments.problem import Problem, build_guides, target_tasks
from ...experiments.results import read_results
from ...learning import q_learning, q_learning_runs
from ...plotting.style import arm_style
from ..base import ArrayTrait, MapTrait, Scene
from ..files import WINDOWS

RUNS = 50  # of the stored experiments
STORED = "goal-target"
NAMES = {name: arm_style(name).name for name in ("none", "rand", *BUILDERS)}
NAMES["yours"] = "yours"  # a policy that the reader wrote
_done = {}  # runs made in this process


class RunScene(Scene):
    """
    A scene of runs that learn in a target, with advice from a source.

    Run `luck` has the seed of that run of the stored experiments.
    """

    map = MapTrait("target")
    source = MapTrait("source")
    luck = traitlets.Int(1, min=1, max=RUNS).tag(sync=True)
    steps = traitlets.Int(PAPER_STEPS, min=600_000, max=PAPER_STEPS).tag(sync=True)

    @property
    def problem(self) -> Problem:
        """The problem that is learned."""
        return Problem(source=self.source, target=self.map)

    @property
    def seed(self) -> np.random.SeedSequence:
        """The seed of the runs: pass it to ``q_learning`` as `rng`."""
        key = STREAMS["report"], self.luck - 1
        return np.random.SeedSequence(SEED, spawn_key=key)

    @property
    def scale(self) -> Scale:
        """Steps of a run and of a window."""
        window = int(self.steps / WINDOWS + 0.5)
        return Scale(WINDOWS * window, window)

    def advice(self, arm: Arm, own: np.ndarray | None = None) -> np.ndarray | None:
        """Return the policy (S, A) that advises an arm; `own` (Z, A) is "yours"."""
        if arm.guide is None:
            return None
        if arm.guide == "yours":
            policy = self.policy if own is None else own
        else:
            policy = _built(self.problem, arm.guide)
        return policy[target_tasks(self.problem).rho]

    def learn(self, arm: Arm, own: np.ndarray | None = None) -> np.ndarray:
        """
        Return the goals of an arm by window (B,): stored ones, or a run of it.

        `own` (Z, A) advises the arm "yours"; by default the policy of the scene.
        """
        stored = _stored(self.problem) if self.scale == SCALES["paper"] else None
        if stored is not None and arm in stored.arms:
            return stored.curves(arm.name, arm.tau)[self.luck - 1]
        if arm.guide == "yours" and own is None:
            own = self.policy
        key = (
            self.problem,
            arm,
            self.steps,
            self.luck,
            own is not None and own.tobytes(),
        )
        if key not in _done:
            guide = self.advice(arm, own)
            _done[key] = q_learning(
                target_tasks(self.problem).mdp,
                self.scale.steps,
                rng=self.seed,
                guide=guide,
                strategy=arm.strategy,
                tau=0 if guide is None else scaled(arm, self.steps),
                window=self.scale.window,
            ).goals
        return _done[key]


def alone(
    tasks, scale: Scale, seed, notes: Mapping[Hashable, Callable[[], np.ndarray]]
) -> list[np.ndarray]:
    """
    Return the goals by window of robots that no guide advises, one for each key.

    A key says what a run is; its notes, (S, A), are asked for if it is new.  New ones
    take turns to learn, in half the time.
    """
    if new := [key for key in notes if key not in _done]:
        runs = q_learning_runs(
            tasks.mdp,
            scale.steps,
            rngs=[seed] * len(new),
            q0s=[notes[key]() for key in new],
            window=scale.window,
        )
        _done.update((key, run.goals) for key, run in zip(new, runs, strict=True))
    return [_done[key] for key in notes]


class PolicyTrait(ArrayTrait):
    """A trait that holds an abstract policy (Z, A), or None."""

    info_text = "an abstract policy: rows of probabilities, one per abstract state"

    def __init__(self, **options):
        super().__init__(**options)
        self.tag(to_json=_to_rows, from_json=_from_rows)

    def validate(self, obj, value):
        """Return the policy as an array; refuse what is none, and say why."""
        if value is None:
            return None
        policy = np.asarray(value, dtype=float)
        shape = _uniform().shape
        if policy.shape != shape:
            raise ValueError(f"policy must have shape {shape}, got {policy.shape}")
        bad = (policy < 0).any(axis=1) | ~np.isclose(policy.sum(axis=1), 1)
        if bad.any():
            z = int(bad.argmax())
            raise ValueError(
                "each row of policy must hold probabilities that sum to 1, got "
                f"{policy[z].tolist()} for abstract state {z}"
            )
        return policy


def scaled(arm: Arm, steps: int) -> int:
    """Return the steps of advice of an arm in a shorter run, as the browser does."""
    return int(arm.tau * steps / PAPER_STEPS + 0.5)


@lru_cache(maxsize=16)
def _built(problem: Problem, name: str) -> np.ndarray:
    return build_guides(problem, [name])[name]


@lru_cache(maxsize=2)
def _stored(problem: Problem):
    """Return the stored results of a problem, None if there are none."""
    try:
        results = read_results(STORED)
    except FileNotFoundError:
        return None
    made = results.record["parameters"]
    wanted = problem.record(), SEED, "report", RUNS
    found = made["reading"], made["seed"], made["stream"], made["runs"]
    return results if found == wanted else None


@lru_cache(maxsize=1)
def _uniform() -> np.ndarray:
    """Return the policy (Z, A) that draws from all that is seen, uniformly."""
    possible = target_tasks(Problem()).possible
    return possible / possible.sum(axis=1, keepdims=True)


def _to_rows(policy, _=None) -> dict:
    """Return the rows of a policy that are not uniform, by abstract state."""
    if policy is None:
        return {}
    rows = np.flatnonzero((policy != _uniform()).any(axis=1))
    return {str(z): policy[z].tolist() for z in rows}


def _from_rows(rows, _=None):
    if not rows:
        return None
    policy = _uniform().copy()
    for z, row in rows.items():
        policy[int(z)] = row
    return policy
