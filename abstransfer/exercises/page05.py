"""Exercises of page 5: inducing, or counting votes."""

import numpy as np

from ._model import Open, Wrong, function, stub, value


def _votes(policies, rhos, n_abstract):
    votes = np.zeros((n_abstract, np.shape(policies[0])[1]))
    for policy, rho in zip(policies, rhos, strict=True):
        np.add.at(votes, rho, policy)
    return votes


def _shares(votes, axis=1):
    total = votes.sum(axis=axis, keepdims=True)
    return votes / np.where(total > 0, total, 1)


def induce_prob(policies, rhos, n_abstract):
    """Return pi_AbsProb (Z, A): the share of votes of each action."""
    votes = np.zeros((n_abstract, policies[0].shape[1]))
    for policy, rho in zip(policies, rhos, strict=True):
        np.add.at(votes, rho, policy)
    total = votes.sum(axis=1, keepdims=True)
    return votes / np.maximum(total, 1e-300)


def induce_prob_by_loops(policies, rhos, n_abstract):
    policy, rho = np.concatenate(policies), np.concatenate(rhos)
    advice = np.zeros((n_abstract, policy.shape[1]))
    for z in range(n_abstract):
        votes = sum(policy[rho == z], np.zeros(policy.shape[1]))
        if votes.sum() > 0:
            advice[z] = votes / votes.sum()
    return advice


def induce_nd(policies, rhos, n_abstract):
    """Return pi_AbsND (Z, A): uniform over the actions that got a vote."""
    voted = _votes(policies, rhos, n_abstract) > 0
    return voted / np.maximum(voted.sum(axis=1, keepdims=True), 1)


def induce_nd_by_sets(policies, rhos, n_abstract):
    advice = np.zeros((n_abstract, policies[0].shape[1]))
    for policy, rho in zip(policies, rhos, strict=True):
        for row, z in zip(policy, rho, strict=True):
            advice[z, row > 0] = 1
    return _shares(advice)


def _goals_vote(policies, rhos, n_abstract):
    cells = np.bincount(np.concatenate(rhos), minlength=n_abstract)[:, None]
    return _votes(policies, rhos, n_abstract) / np.maximum(cells, 1)


def _task_by_task(policies, rhos, n_abstract):
    each = [
        induce_prob([p], [r], n_abstract) for p, r in zip(policies, rhos, strict=True)
    ]
    return _shares(np.sum(each, axis=0))


def _last_task_only(policies, rhos, n_abstract):
    return induce_prob(policies[-1:], rhos[-1:], n_abstract)


def _lost_votes(policies, rhos, n_abstract):
    votes = np.zeros((n_abstract, policies[0].shape[1]))
    for policy, rho in zip(policies, rhos, strict=True):
        votes[rho] += policy
    return _shares(votes)


def _winner(policies, rhos, n_abstract):
    votes = _votes(policies, rhos, n_abstract)
    top = votes.max(axis=1, keepdims=True)
    return _shares(((votes == top) & (top > 0)).astype(float))


def _always_best(policies, rhos, n_abstract):
    votes, n = 0, 0
    for policy, rho in zip(policies, rhos, strict=True):
        n = n + _votes([1.0 * (policy.sum(1, keepdims=True) > 0)], [rho], n_abstract)
        votes = votes + _votes([1.0 * (policy > 0)], [rho], n_abstract)
    return _shares(1.0 * ((votes == n) & (n > 0)))


def _uniform_without_votes(policies, rhos, n_abstract):
    votes = _votes(policies, rhos, n_abstract)
    return _shares(np.where(votes.sum(axis=1, keepdims=True) > 0, votes, 1))


def _uniform_without_votes_nd(policies, rhos, n_abstract):
    voted = _votes(policies, rhos, n_abstract) > 0
    return _shares(1.0 * np.where(voted.any(axis=1, keepdims=True), voted, True))


def _whole_votes(policies, rhos, n_abstract):
    return induce_prob([1.0 * (policy > 0) for policy in policies], rhos, n_abstract)


def _first_of_ties(policies, rhos, n_abstract):
    first = [np.eye(p.shape[1])[p.argmax(axis=1)] * (p > 0) for p in policies]
    return induce_prob(first, rhos, n_abstract)


def _of_all_votes(policies, rhos, n_abstract):
    votes = _votes(policies, rhos, n_abstract)
    return votes / votes.sum()


def _half_votes_lost(policies, rhos, n_abstract):
    return _shares(1.0 * (_votes(policies, rhos, n_abstract) >= 1))


def _by_all_actions(policies, rhos, n_abstract):
    voted = _votes(policies, rhos, n_abstract) > 0
    return voted / voted.shape[1]


def _buildings(rng):
    """Yield tasks of different sizes; the last cell of each is its goal."""
    tie, none = [0.5, 0.5], [0.0, 0.0]
    yield [np.array([tie, [1.0, 0.0], none])], [np.array([0, 1, 1])], 3
    yield [np.array([[0.0, 1.0], tie, none])], [np.array([0, 0, 1])], 2
    for n_actions, n_abstract in ((4, 5), (4, 7), (3, 6)):
        rarer = 0.5 ** np.arange(n_actions)
        for sizes in ((5, 9, 14), (5, 9, 14), (20, 6, 8)):
            policies, rhos = [], []
            for n in sizes:
                best = rng.choice(n_actions, n, p=rarer / rarer.sum())
                policy = np.eye(n_actions)[best]
                policy[0], policy[0, :2] = 0, 0.5  # a tie
                policy[-1] = 0
                policies.append(policy)
                rhos.append(rng.integers(4, size=n))  # the others are never seen
            rhos[0][-1], rhos[1][-1] = rhos[0][0], rhos[1][0]
            yield policies, rhos, n_abstract


TASK = (
    "`policies` is a list with one array (S, A) per task, the optimal policy; equally "
    "good actions share a row, and the row of a goal is 0. `rhos` holds the abstract "
    "state of each state, again one array (S,) per task. A row without a vote stays 0."
)

EXERCISES = [
    function(
        "ex-5-1",
        "Write `induce_prob`, the array (Z, A) of pi_AbsProb. " + TASK,
        induce_prob,
        cases=_buildings,
        stub=stub(
            """\
def induce_prob(policies, rhos, n_abstract):
    votes = np.zeros((n_abstract, policies[0].shape[1]))
    for policy, rho in zip(policies, rhos, strict=True):
        {count}
    total = votes.sum(axis=1, keepdims=True)
    return {shares}
""",
            count=(
                "np.add.at(votes, rho, policy)",
                {
                    "votes[rho] += policy": "votes[rho] += policy",
                    "a tie casts whole votes": "np.add.at(votes, rho, policy > 0)",
                },
            ),
            shares=(
                "votes / np.where(total > 0, total, 1)",
                {
                    "counts instead of shares": "votes",
                    "divided by all votes": "votes / votes.sum()",
                    "shares over abstract states": "votes / votes.sum(axis=0)",
                    "uniform where nobody votes": (
                        "np.where(total > 0, votes / np.maximum(total, 1), "
                        "1 / votes.shape[1])"
                    ),
                },
            ),
        ),
        same=(induce_prob_by_loops,),
        hints=(
            "One ballot box for each abstract state, for all tasks together.",
            "Add each state's row of `policy` to the row of its abstract state; "
            "`np.add.at(votes, rho, policy)` does so for a task.",
            "Divide each row by its sum, once, at the end: `votes.sum(axis=1, "
            "keepdims=True)`. Mind the rows whose sum is 0.",
        ),
        wrong=[
            Wrong(
                "goal cells vote",
                _goals_vote,
                "You divide by the number of cells, goals included. A goal casts no "
                "vote: divide by the number of votes.",
            ),
            Wrong(
                "tasks averaged before counting",
                _task_by_task,
                "You take shares in each task, then their mean. Then a task with one "
                "such cell weighs as much as a task with twenty. Count first.",
            ),
            Wrong(
                "a set instead of counts",
                induce_nd,
                "You ask *whether* an action was ever best; here it matters how often. "
                "What you wrote is pi_AbsND.",
            ),
            Wrong(
                "counts instead of shares",
                _votes,
                "These are the votes. Divide each row by its sum.",
            ),
            Wrong(
                "shares over abstract states",
                lambda policies, rhos, n: _shares(_votes(policies, rhos, n), axis=0),
                "Your columns sum to 1. For each abstract state, that is each *row*, "
                "the "
                "actions must.",
            ),
            Wrong(
                "one task only",
                _last_task_only,
                "Only the last task was counted. Is `votes` made anew in the loop?",
            ),
            Wrong(
                "votes[rho] += policy",
                _lost_votes,
                "If two states of a task look alike, this keeps only one of the two "
                "votes. `np.add.at(votes, rho, policy)` keeps both.",
            ),
            Wrong(
                "the winner takes all",
                _winner,
                "You keep the most frequent action only; all keep their share.",
            ),
            Wrong(
                "uniform where nobody votes",
                _uniform_without_votes,
                "Here a row without a vote stays 0; filling it is left to the caller.",
            ),
            Wrong(
                "a tie casts whole votes",
                _whole_votes,
                "Two equally good actions share the one vote of their state: add "
                "`policy`, not `policy > 0`.",
            ),
            Wrong(
                "the first of equals gets the vote",
                _first_of_ties,
                "`argmax` takes the first of equals. Each of them gets its share.",
            ),
            Wrong(
                "divided by all votes",
                _of_all_votes,
                "Divide each row by the votes in *that* row.",
            ),
        ],
    ),
    function(
        "ex-5-2",
        "Write `induce_nd`, the array (Z, A) of pi_AbsND: uniform over its set of "
        "actions. " + TASK,
        induce_nd,
        cases=_buildings,
        stub=stub(
            """\
def induce_nd(policies, rhos, n_abstract):
    votes = np.zeros((n_abstract, policies[0].shape[1]))
    for policy, rho in zip(policies, rhos, strict=True):
        np.add.at(votes, rho, policy)
    ever = {ever}
    return {advice}
""",
            ever=(
                "votes > 0",
                {
                    "half a vote is none": "votes >= 1",
                    "the winner takes all": (
                        "(votes > 0) & (votes == votes.max(axis=1, keepdims=True))"
                    ),
                    "uniform where nobody votes": (
                        "(votes > 0) | (votes.sum(axis=1, keepdims=True) == 0)"
                    ),
                },
            ),
            advice=(
                "ever / np.maximum(ever.sum(axis=1, keepdims=True), 1)",
                {
                    "counts instead of a set": (
                        "votes / np.maximum(votes.sum(axis=1, keepdims=True), 1)"
                    ),
                    "a set without probabilities": "1.0 * ever",
                    "shares over abstract states": (
                        "ever / np.maximum(ever.sum(axis=0), 1)"
                    ),
                    "divided by the number of all actions": "ever / ever.shape[1]",
                },
            ),
        ),
        same=(induce_nd_by_sets,),
        hints=(
            "For each abstract state and action: was it ever best, in any task?",
            "`votes > 0` says so; then the actions of a row share the probability.",
            "Divide `votes > 0` by its sum over each row, where that is not 0.",
        ),
        wrong=[
            Wrong(
                "counts instead of a set",
                induce_prob,
                "That is pi_AbsProb. ND forgets how often: once is enough.",
            ),
            Wrong(
                "a set without probabilities",
                lambda policies, rhos, n: 1.0 * (_votes(policies, rhos, n) > 0),
                "These are the sets, as 0 and 1. The robot draws uniformly: each row "
                "must sum to 1.",
            ),
            Wrong(
                "best everywhere instead of somewhere",
                _always_best,
                "You keep actions that are optimal in *every* state of the abstract "
                "state. The definition says there exists one.",
            ),
            Wrong(
                "the winner takes all",
                _winner,
                "You keep the most frequent action only. ND keeps every action that "
                "was "
                "ever best.",
            ),
            Wrong(
                "shares over abstract states",
                lambda policies, rhos, n: _shares(
                    1.0 * (_votes(policies, rhos, n) > 0), axis=0
                ),
                "Your columns sum to 1; each row must.",
            ),
            Wrong(
                "uniform where nobody votes",
                _uniform_without_votes_nd,
                "Here a row without a vote stays 0; filling it is left to the caller.",
            ),
            Wrong(
                "half a vote is none",
                _half_votes_lost,
                "An action that tied once has half a vote, and it was best: ask for "
                "more than 0, not for 1.",
            ),
            Wrong(
                "divided by the number of all actions",
                _by_all_actions,
                "The actions of the set share the probability, not all that there are.",
            ),
            Wrong(
                "one task only",
                lambda policies, rhos, n: induce_nd(policies[-1:], rhos[-1:], n),
                "Only the last task was counted. Is `votes` made anew in the loop?",
            ),
        ],
    ),
    value(
        "ex-5-3",
        "Three actions have the shares 0.6, 0.3 and 0.1. What is the probability of "
        "the "
        "first one under the dial beta = 2?",
        0.36 / 0.46,
        also=(6.6303,),  # beta for 99 percent
        share=True,
        tolerance=2e-3,
        hints=(
            "The dial raises each share to the power beta: square all three.",
            "The squares are 0.36, 0.09 and 0.01. Do they sum to 1?",
            "Divide by their sum: `0.36 / (0.36 + 0.09 + 0.01)`.",
        ),
        wrong=[
            Wrong("not normalised", 0.36, "The three squares do not sum to 1: divide."),
            Wrong("the dial at 1", 0.6, "That is Prob itself, beta = 1."),
            Wrong("the dial at 0", 1 / 3, "That is ND, beta = 0."),
            Wrong("the dial at infinity", 1, "That is the winner taking all."),
            Wrong(
                "times instead of to the power",
                1.2,
                "Beta is an exponent; and a probability is at most 1.",
            ),
        ],
    ),
    value(
        "ex-5-3b",
        "The shares are 0.6, 0.3 and 0.1. How large must beta be until the first "
        "action has 99 percent? One decimal is enough.",
        6.6303,
        tolerance=1e-2,
        hints=(
            "Try `at.beta_policy` with a few numbers.",
            "The first action has twice the share of the second; at beta = 2 it leads "
            "four to one. By how much must it lead?",
            "It leads by 2 to the power beta; that must be 99 to 1, nearly: "
            "`np.log2(99)`.",
        ),
        wrong=[
            Wrong(
                "times instead of to the power",
                49.5,
                "At beta the lead is not twice beta, but 2 to the power beta.",
            ),
            Wrong(
                "the natural logarithm",
                float(np.log(99)),
                "Which power of 2, not of e, is 99?",
            ),
            Wrong(
                "not normalised",
                float(np.log(0.99) / np.log(0.6)),
                "The powers do not sum to 1. Below beta = 1 the first action even "
                "loses.",
            ),
            Wrong(
                "the second action alone",
                float(np.log(0.01) / np.log(0.3)),
                "There its power is 0.01; but the power of the first has become small, "
                "too.",
            ),
        ],
    ),
]

OPEN = [
    Open(
        "ex-5-4",
        hints=(
            "`at.navigation_tasks` takes a list of maps.",
            "The maps are called `source`, `target_b`, `target_c` and `target_d`; "
            "`drive` and `new_to` stand in the first cell of this page.",
            "What does one more vote do to a frequency, and what to a set?",
        ),
        good="nothing looks new any more; Prob hardly changes (0.9 worse in the end), "
        "ND gets worse (by 7.3), for a set only grows",
    ),
]
