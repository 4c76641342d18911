"""A solution that is bent anywhere is refused: by a frozen argument, by a mutation."""

import copy
import inspect
import textwrap

import numpy as np
import pytest
from mutations import mutants

from abstransfer.exercises import all_exercises, check

CODING = {exercise.key: exercise for exercise in all_exercises() if exercise.cases}

# Arguments that a right solution does not use.
UNUSED = {("ex-3-1", "cut"): "a step that was cut is learned from like any other"}
# Mutants that are right, by what they change and why it changes nothing.
EACH_TASK = "for policy, rho in zip(policies, rhos, strict=True):: True -> False"
LENGTHS = (
    "both lists have one array for each task, so there is nothing to be strict about"
)
ACTIONS = "all tasks have the same actions, so any of them tells how many"
EQUIVALENT = {
    "ex-3-2": {
        "if rng.random() < epsilon:: rng.random() < epsilon -> rng.random() <= epsilon":
            "a draw equals epsilon once in 2**53 times",
    },
    "ex-5-1": {
        EACH_TASK: LENGTHS,
        "votes = np.zeros((n_abstract, policies[0].shape[1])): 0 -> -1": ACTIONS,
        "return votes / np.maximum(total, 1e-300): 1e-300 -> 1.0":
            "a state casts one vote in all, so a row with votes has one or more",
    },
    "ex-5-2": {
        EACH_TASK: LENGTHS,
        "votes = np.zeros((n_abstract, np.shape(policies[0])[1])): 0 -> -1": ACTIONS,
    },
    "ex-8-1": {"if t > tau:: t > tau -> t >= tau": "(tau - t) / tau is 0 at t = tau"},
}  # fmt: skip


def shape(argument):
    """Return what two arguments must share for one to stand in for the other."""
    if isinstance(argument, list):
        return tuple(shape(part) for part in argument)
    return np.shape(argument) if isinstance(argument, np.ndarray) else ()


def frozen(exercise, name):
    """Return the solution, with one argument always the first of its shape."""
    place, first = exercise.parameters.index(name), {}
    for case in exercise.cases(np.random.default_rng(2015)):
        first.setdefault(tuple(map(shape, case)), copy.deepcopy(case[place]))

    def solution(*case):
        stand_in = first[tuple(map(shape, case))]
        return exercise.solution(*case[:place], stand_in, *case[place + 1 :])

    parameters = [
        inspect.Parameter(p, inspect.Parameter.POSITIONAL_OR_KEYWORD)
        for p in exercise.parameters
    ]
    solution.__signature__ = inspect.Signature(parameters)
    return solution


@pytest.mark.parametrize(
    ("key", "name"),
    [
        pytest.param(key, name, id=f"{key}-{name}")
        for key, exercise in CODING.items()
        for name in exercise.parameters
    ],
)
def test_a_solution_that_ignores_an_argument_is_wrong(key, name):
    """Even if it has the right shape: so every argument varies among the cases."""
    reply = check(key, frozen(CODING[key], name))

    if (key, name) in UNUSED:
        assert reply
    else:
        assert reply.verdict == "not yet"


def bent(exercise):
    """Yield the name of each mutant of a solution, and the function."""
    solution = exercise.solution
    own = solution.__globals__
    helpers = [
        own[name]
        for name in solution.__code__.co_names
        if inspect.isfunction(own.get(name)) and own[name].__module__ == own["__name__"]
    ]
    sources = [textwrap.dedent(inspect.getsource(f)) for f in (*helpers, solution)]
    for i, source in enumerate(sources):
        for name, mutant in mutants(source):
            names = dict(own)
            for text in (*sources[:i], mutant, *sources[i + 1 :]):
                exec(compile(text, name, "exec"), names)
            yield name, names[solution.__name__]


@pytest.mark.parametrize("exercise", CODING.values(), ids=CODING)
def test_every_mutant_of_a_solution_that_differs_is_refused(exercise):
    judged = [(name, bool(check(exercise.key, f))) for name, f in bent(exercise)]

    assert len(judged) >= 4
    accepted = {name for name, right in judged if right}
    assert accepted == set(EQUIVALENT.get(exercise.key, ()))
