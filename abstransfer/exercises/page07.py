"""Exercises of page 7: the driving test."""

import numpy as np

from ._model import Wrong, function, stub, value
from ._read import word


def evaluate(P, r, gamma):
    """Return the value of each state: the solution of (I - gamma P) V = r."""
    return np.linalg.solve(np.eye(len(r)) - gamma * P, r)


def evaluate_by_sweeps(P, r, gamma):
    v = np.zeros(len(r))
    for _ in range(3000):
        v = r + gamma * P @ v
    return v


def _loop_at_the_goal(P, r, gamma):
    stuck = P + np.diag(P.sum(axis=1) == 0)
    return evaluate(stuck, r, gamma)


def _first_reward_free(P, r, gamma):
    return gamma * P @ evaluate(P, r, gamma)


def _reward_of_next_only(P, r, gamma):
    return evaluate(P, P @ r, gamma)


def _one_sweep(P, r, gamma):
    return r + gamma * P @ r


def _drivers(rng):
    yield np.array([[0.1, 0.9], [0.0, 0.0]]), np.array([-1.0, 0.0]), 0.99
    yield np.array([[0.2, 0.8], [0.0, 0.0]]), np.array([0.0, 1.0]), 0.9
    for n, gamma in ((3, 0.9), (3, 0.95), (5, 0.9), (8, 0.8)):
        P = rng.random((n, n))
        P /= P.sum(axis=1, keepdims=True)
        P[-1] = 0
        yield P, np.append(rng.choice([-1.0, -2.0], n - 1), 1.0), gamma


EXERCISES = [
    function(
        "ex-7-1",
        "Write `evaluate`, the value of each state for a driver with the moves P (S, "
        "S) "
        "and the rewards r (S,). The row of a goal in P is 0.",
        evaluate,
        cases=_drivers,
        stub=stub(
            """\
def evaluate(P, r, gamma):
    return {values}
""",
            values=(
                "np.linalg.solve(np.eye(len(r)) - gamma * P, r)",
                {
                    "no discount": "np.linalg.solve(np.eye(len(r)) - P, r)",
                    "from where instead of to where": (
                        "np.linalg.solve(np.eye(len(r)) - gamma * P.T, r)"
                    ),
                    "the reward of now is missing": (
                        "gamma * P @ np.linalg.solve(np.eye(len(r)) - gamma * P, r)"
                    ),
                    "the reward of the next state": (
                        "np.linalg.solve(np.eye(len(r)) - gamma * P, P @ r)"
                    ),
                    "one sweep is not the solution": "r + gamma * P @ r",
                    "plus instead of minus": (
                        "np.linalg.solve(np.eye(len(r)) + gamma * P, r)"
                    ),
                },
            ),
        ),
        same=(
            evaluate_by_sweeps,
            lambda P, r, gamma: np.linalg.inv(np.eye(len(r)) - gamma * P) @ r,
        ),
        hints=(
            "The value of a state stands on both sides of its equation; of the first "
            "cell, V = -1 + 0.99 * 0.1 * V.",
            "Collect the unknowns on the left: V - gamma P V = r.",
            "`A = np.eye(len(r)) - gamma * P`; then `np.linalg.solve(A, r)`.",
        ),
        wrong=[
            Wrong(
                "no discount",
                lambda P, r, gamma: evaluate(P, r, 1),
                "What comes one step later counts gamma times as much.",
            ),
            Wrong(
                "from where instead of to where",
                lambda P, r, gamma: evaluate(P.T, r, gamma),
                "The matrix is transposed. Row s of P says where s leads *to*.",
            ),
            Wrong(
                "the goal goes on",
                _loop_at_the_goal,
                "You give the goal a move to itself, so its reward is paid for ever. "
                "The "
                "row of the goal is empty: the episode ends.",
            ),
            Wrong(
                "the reward of now is missing",
                _first_reward_free,
                "V(s) begins with r(s), in full; only the rest is discounted.",
            ),
            Wrong(
                "the reward of the next state",
                _reward_of_next_only,
                "Here the reward belongs to the state itself: r, not P r.",
            ),
            Wrong(
                "one sweep is not the solution",
                _one_sweep,
                "You put r in place of V on the right. V itself stands there: solve.",
            ),
            Wrong(
                "plus instead of minus",
                lambda P, r, gamma: np.linalg.solve(np.eye(len(r)) + gamma * P, r),
                "Bringing gamma P V to the other side changes its sign.",
            ),
        ],
    ),
    value(
        "ex-7-2",
        "What is the mean value, in the target building, of a robot that draws only "
        "from "
        "the actions available in each state?",
        -93.878854,
        also=(3.169556,),  # points of the wanderer's cost that are waiting
        tolerance=1e-3,  # the scenes print one digit
        hints=(
            "It is a uniform policy over fewer actions: `target.available` says which "
            "have somewhere to go.",
            "`at.uniform_policy` takes such a mask: `policy = "
            "at.uniform_policy(target.available)`.",
            "`at.evaluate_policy(target.mdp, policy).mean()`, over all states.",
        ),
        wrong=[
            Wrong(
                "the wanderer",
                -97.04841,
                "This one draws from all 8 actions, and waits where it sees nothing.",
            ),
            Wrong(
                "goals left out",
                -94.053026,
                "You average over the cells that are no goals. Table 1 counts all "
                "cells.",
            ),
            Wrong(
                "the other building",
                -78.539476,
                "That is the source building; what is asked for is the target.",
            ),
            Wrong(
                "the sign",
                93.878854,
                "The size is right. But the robot pays, so its value is below 0.",
            ),
        ],
    ),
    value(
        "ex-7-2b",
        "How many points of the wanderer's mean cost, in the target building, are "
        "waiting: by how much is that robot better?",
        3.169556,
        tolerance=1e-3,
        hints=(
            "Both robots go in random directions. Only one of them waits.",
            "The wanderer is `wanderer = at.uniform_policy(target.mdp.allowed)`; Table "
            "1 has both.",
            "Subtract: `-93.878854 - at.evaluate_policy(target.mdp, wanderer).mean()`.",
        ),
        wrong=[
            Wrong("the sign", -3.169556, "The size is right. Better is more."),
            Wrong(
                "a share, not points",
                0.032660,
                "That is which share of its cost it is. Asked are points of Table 1.",
            ),
            Wrong(
                "the steps, not the cost",
                0.730251,
                "So many of its steps are waiting. Asked is what that costs it.",
            ),
            Wrong(
                "the other building",
                10.195740,
                "That is the source building; what is asked for is the target.",
            ),
        ],
    ),
    value(
        "ex-7-3",
        "What is the mean value of Grad in the target building, if *near* is taken "
        "literally?",
        -66.660865,
        tolerance=2e-3,
        hints=(
            "Only what the robot sees changes, so only the three rows of advice can. "
            "In the scene, set *near* and *almost near* to 4.",
            "`home, away = (at.navigation_tasks(m, near=4, almost_near=4) for m in "
            "(source_map, target_map))`: advice is made in one, drives in the other.",
            '`grad = at.abstract_policies(home)["grad"][away.rho]`; then '
            "`at.evaluate_policy(away.mdp, grad).mean()`.",
        ),
        wrong=[
            Wrong("the usual reading", -71.177, 'That is "at most", as in the ladder.'),
            Wrong("Prob", -70.004307, "That is Prob. What is asked for is Grad."),
            Wrong("ND", -83.955786, "That is ND. What is asked for is Grad."),
            Wrong(
                "some are almost near",
                -69.397067,
                "There *almost near* still reaches to 8. Taken literally, it is never "
                "true.",
            ),
            Wrong(
                "5 or fewer",
                -70.488984,
                'The other part of "5 or more" is 4 or fewer.',
            ),
            Wrong(
                "the other building",
                -32.868957,
                "That is the source building; what is asked for is the target.",
            ),
            Wrong(
                "the sign",
                66.660865,
                "The size is right. But the robot pays, so its value is below 0.",
            ),
        ],
    ),
    value(
        "ex-7-4",
        "Does the order of the drivers depend on whether a move succeeds with "
        'probability 1, 0.9 or 0.8? "yes" or "no"',
        "no",
        read=word,
        hints=(
            "Make the source tasks three times; `at.table1` with one argument gives "
            "the source column alone.",
            "`at.navigation_tasks(source_map, success=0.9)` are those for 0.9.",
            "Compare the order of the four numbers in each line, not their size.",
        ),
        wrong=[
            Wrong(
                "the size for the order",
                "yes",
                "All values move, but does any driver overtake another?",
            ),
        ],
    ),
]
