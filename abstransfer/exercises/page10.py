"""Exercises of page 10: why the worst driver teaches best."""

import numpy as np

from ._model import Wrong, function


def diluted(page, possible, share):
    """Return a page of advice mixed with a robot that does anything possible."""
    eager = possible / possible.sum(axis=1, keepdims=True)
    return (1 - share) * page + share * eager


def diluted_row_by_row(page, possible, share):
    rows = []
    for p, mask in zip(page, possible, strict=True):
        noise = share / sum(bool(m) for m in mask)
        pairs = zip(p, mask, strict=True)
        rows.append([x * (1 - share) + noise * bool(m) for x, m in pairs])
    return rows


def _over_all(page, possible, share):
    return (1 - share) * page + share / page.shape[1]


def _other_share(page, possible, share):
    return diluted(page, possible, 1 - share)


def _adds(page, possible, share):
    return page + share * possible / possible.sum(axis=1, keepdims=True)


def _counts_the_page(page, possible, share):
    mixed = (1 - share) * page + share * possible
    return mixed / mixed.sum(axis=1, keepdims=True)


def _within_the_list(page, possible, share):
    support = page > 0
    return (1 - share) * page + share * support / support.sum(axis=1, keepdims=True)


def _pages(rng):
    for share in (0, 0.1, 0.25, 0.5, 0.75, 1):
        for shape in ((2, 3), (5, 8)):
            possible = rng.random(shape) < 0.5
            possible[:, 0] = True
            page = rng.random(shape) * possible * (rng.random(shape) < 0.6)
            page[:, 0] += 0.1
            yield page / page.sum(axis=1, keepdims=True), possible, share


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
        "Write `diluted`, which mixes a page of advice (Z, A) with the eager robot's, "
        "who draws uniformly among the possible actions. `possible` (Z, A) is True or "
        "False; `share` is the eager robot's part, 0 to 1.",
        diluted,
        cases=_pages,
        same=(diluted_row_by_row,),
        hints=(
            "Two pages of advice, each with rows that sum to 1, are mixed.",
            "The eager robot's page is `possible`, each row divided by its sum: "
            "`eager = possible / possible.sum(axis=1, keepdims=True)`.",
            "`(1 - share) * page + share * eager`.",
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
                "With `share` = 0 the page should stay as it is.",
            ),
            Wrong(
                "added on top",
                _adds,
                "The rows now sum to more than 1. What the eager robot gets, the page "
                "must give.",
            ),
            Wrong(
                "actions counted, not shared out",
                _counts_the_page,
                "Mixing before dividing gives views with many actions more noise. Make "
                "the eager page first.",
            ),
            Wrong(
                "uniform over the page's own list",
                _within_the_list,
                "That moves toward ND: no action is added that the page does not list.",
            ),
        ],
    ),
    function(
        "ex-10-3",
        "Write `share_closed`: goals of the lives of Prob (`low`), of a changed Prob "
        "(`middle`), and of ND (`high`). Return which part of the gap between the "
        "means of Prob and ND the change closes: 0 none, 1 all of it.",
        share_closed,
        cases=_runs,
        same=(share_closed_by_sums,),
        hints=(
            "Take the mean of each first; then there are three numbers on a line.",
            "How far is it from low to middle, and how far from low to high?",
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
                "life by life",
                lambda low, middle, high: np.mean(
                    (np.array(middle) - low) / (np.array(high) - low)
                ),
                "A ratio of two noisy differences can be wild. Take the means first.",
            ),
        ],
    ),
]
