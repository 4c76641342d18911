"""Exercises of page 10: why the worst driver teaches best."""

import numpy as np

from ._model import Open, Wrong, function, stub


def diluted(advice, possible, share):
    """Return advice (Z, A) mixed with that of the eager robot."""
    eager = possible / possible.sum(axis=1, keepdims=True)
    return (1 - share) * advice + share * eager


def diluted_row_by_row(advice, possible, share):
    rows = []
    for p, mask in zip(advice, possible, strict=True):
        noise = share / sum(bool(m) for m in mask)
        pairs = zip(p, mask, strict=True)
        rows.append([x * (1 - share) + noise * bool(m) for x, m in pairs])
    return rows


def _over_all(advice, possible, share):
    return (1 - share) * advice + share / advice.shape[1]


def _other_share(advice, possible, share):
    return diluted(advice, possible, 1 - share)


def _adds(advice, possible, share):
    return advice + share * possible / possible.sum(axis=1, keepdims=True)


def _counts_the_actions(advice, possible, share):
    mixed = (1 - share) * advice + share * possible
    return mixed / mixed.sum(axis=1, keepdims=True)


def _within_the_list(advice, possible, share):
    support = advice > 0
    return (1 - share) * advice + share * support / support.sum(axis=1, keepdims=True)


def _advice(rng):
    for share in (0, 0.1, 0.25, 0.5, 0.75, 1):
        for shape in ((2, 3), (5, 8)):
            possible = rng.random(shape) < 0.5
            possible[:, 0] = True
            advice = rng.random(shape) * possible * (rng.random(shape) < 0.6)
            advice[:, 0] += 0.1
            yield advice / advice.sum(axis=1, keepdims=True), possible, share


def share_closed(low, middle, high):
    """Return how much of the way from `low` to `high` lies below `middle`."""
    return (np.mean(middle) - np.mean(low)) / (np.mean(high) - np.mean(low))


def share_closed_by_sums(low, middle, high):
    return float(sum(middle) - sum(low)) / float(sum(high) - sum(low))


def _runs(rng):
    for middle in (410, 450, 500, 560, 600):
        yield tuple(rng.normal(mean, 8, 20).round() for mean in (450, middle, 550))


EXERCISES = [
    function(
        "ex-10-2",
        "Write `diluted`, which mixes advice (Z, A) with that of the eager robot. "
        "It draws uniformly among the possible actions. `possible` (Z, A) is True or "
        "False; `share` is the eager robot's part, 0 to 1.",
        diluted,
        cases=_advice,
        stub=stub(
            """\
def diluted(advice, possible, share):
    eager = {eager}
    return {mixed}
""",
            eager=(
                "possible / possible.sum(axis=1, keepdims=True)",
                {
                    "uniform over all actions": (
                        "np.full(advice.shape, 1 / advice.shape[1])"
                    ),
                    "uniform over its own list": (
                        "(advice > 0) / (advice > 0).sum(axis=1, keepdims=True)"
                    ),
                },
            ),
            mixed=(
                "(1 - share) * advice + share * eager",
                {
                    "the shares the other way round": (
                        "share * advice + (1 - share) * eager"
                    ),
                    "added on top": "advice + share * eager",
                },
            ),
        ),
        same=(diluted_row_by_row,),
        hints=(
            "Two arrays of advice, each with rows that sum to 1, are mixed.",
            "The eager robot's advice is `possible`, each row divided by its sum: "
            "`eager = possible / possible.sum(axis=1, keepdims=True)`.",
            "`(1 - share) * advice + share * eager`.",
        ),
        wrong=[
            Wrong(
                "uniform over all actions",
                _over_all,
                "You mix in the wanderer: it tries things that are not there, and "
                "wastes the step.",
            ),
            Wrong(
                "the shares the other way round",
                _other_share,
                "With `share` = 0 the advice should stay as it is.",
            ),
            Wrong(
                "added on top",
                _adds,
                "The rows now sum to more than 1. What the eager robot gets, the "
                "advice must give.",
            ),
            Wrong(
                "actions counted, not shared out",
                _counts_the_actions,
                "Mixing before dividing gives views with many actions more noise. Make "
                "the eager advice first.",
            ),
            Wrong(
                "uniform over its own list",
                _within_the_list,
                "That moves toward ND: no action is added that was not listed.",
            ),
        ],
    ),
    function(
        "ex-10-3",
        "Write `share_closed`: goals of the runs of Prob (`low`), of a changed Prob "
        "(`middle`), and of ND (`high`). Return which part of the gap between the "
        "means of Prob and ND the change closes: 0 none, 1 all of it.",
        share_closed,
        cases=_runs,
        stub=stub(
            """\
def share_closed(low, middle, high):
    gap = np.mean(high) - np.mean(low)
    return {closed}
""",
            closed=(
                "(np.mean(middle) - np.mean(low)) / gap",
                {
                    "the share of goals": "np.mean(middle) / np.mean(high)",
                    "what is left of the gap": (
                        "(np.mean(high) - np.mean(middle)) / gap"
                    ),
                    "a gain instead of a share": "np.mean(middle) / np.mean(low) - 1",
                    "never above 1, never below 0": (
                        "np.clip((np.mean(middle) - np.mean(low)) / gap, 0, 1)"
                    ),
                    "run by run": "np.mean((middle - low) / (high - low))",
                },
            ),
        ),
        same=(share_closed_by_sums,),
        hints=(
            "Take the mean of each first; then there are three numbers on a line.",
            "How far is it from low to middle, and how far from low to high? For the "
            "last question, ask `at.experiments.arrival` whether the tenth lets the "
            "robot out.",
            "`low, middle, high = np.mean(low), np.mean(middle), np.mean(high)`; then "
            "`(middle - low) / (high - low)`.",
        ),
        wrong=[
            Wrong(
                "the share of goals",
                lambda low, middle, high: np.mean(middle) / np.mean(high),
                "This would be near 1 for any robot. Measure from Prob, not from 0.",
            ),
            Wrong(
                "what is left of the gap",
                lambda low, middle, high: 1 - share_closed(low, middle, high),
                "That is what the change does *not* close.",
            ),
            Wrong(
                "a gain instead of a share",
                lambda low, middle, high: np.mean(middle) / np.mean(low) - 1,
                "That says how much better Prob became; compare it with the gap.",
            ),
            Wrong(
                "never above 1, never below 0",
                lambda low, middle, high: np.clip(
                    share_closed(low, middle, high), 0, 1
                ),
                "A change can make it worse, or better than ND: do not hide that.",
            ),
            Wrong(
                "run by run",
                lambda low, middle, high: np.mean(
                    (np.array(middle) - low) / (np.array(high) - low)
                ),
                "A ratio of two noisy differences can be wild. Take the means first.",
            ),
        ],
    ),
]

OPEN = [
    Open(
        "ex-10-1",
        hints=(
            "What would *coverage* say, what would you say if you believe in good "
            "driving?",
            "A prediction has a direction, and a size that would make you change your "
            "mind.",
            '`gain("grad-available-0.5-hard", "grad-hard")`.',
        ),
        good="a direction, and a size that would refute it, written before; found is "
        "+18.3 % hard and +8.4 % soft",
    ),
    Open(
        "ex-10-4",
        hints=(
            '`by_tau = at.experiments.read_results("study-tau-target")`, then '
            '`by_tau.totals("beta-0-hard", tau)` for tau of 1, 2, 3.5, 6 and 9 '
            "million.",
            "Compare best with best, not only at the same tau.",
            "Choosing the best of five from the same runs flatters both; does it "
            "matter here?",
        ),
        good="the sweep of tau: ND leads at each, and both are best at 3.5 million",
    ),
    Open(
        "ex-10-5",
        hints=(
            'Give `target=at.read_map("target_c")` to `at.experiments.Problem`, and '
            "that to `at.experiments.target_tasks`.",
            "`study-goal-target_c` has seven, hard.",
            "Compare with *tried*.",
        ),
        good="a limit named before; both measures reach +0.90, so the test cannot "
        "separate them",
    ),
]
