"""Alt texts of learning runs: who reaches most goals, and where tau is best."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .style import arm_style

ROOM = 290  # characters of an alt text


def describe_curves(goals: Mapping[str, np.ndarray]) -> str:
    """
    Return the alt text of ``plot_curves``: who leads at the end, and at the start.

    >>> describe_curves({"none": np.array([[10, 20]]), "nd-soft": np.array([[5, 40]])})
    'Goals per window, mean of 1 run. Last of 2 windows: ND soft 40, Q-learning 20.
    First window: Q-learning 10, ND soft 5.'
    """
    goals = arm_arrays(goals, 2)
    means = {arm: x.mean(axis=0) for arm, x in goals.items()}
    n_windows = len(next(iter(means.values())))
    first = _ranking({arm: mean[0] for arm, mean in means.items()})
    last = _ranking({arm: mean[-1] for arm, mean in means.items()})
    runs = _runs(goals.values())
    start = f"Goals per window, mean of {runs}. Last of {n_windows} windows: "
    middle = ". First window: "
    half = (ROOM - len(start) - len(middle)) // 2
    return start + fit(last, half) + middle + fit(first, half) + "."


def describe_boxes(totals: Mapping[str, np.ndarray]) -> str:
    """
    Return the alt text of ``plot_boxes``: the arms by their mean, best first.

    >>> describe_boxes({"none": np.array([250_000, 270_000]), "rand-hard":
    ...                 np.array([430_000, 440_000])})
    'Goals of a run, mean of 2 runs, best first: random hard 435k, Q-learning 260k.
    The best reaches 1.67 times the last.'
    """
    totals = arm_arrays(totals, 1)
    means = {arm: x.mean() for arm, x in totals.items()}
    start = f"Goals of a run, mean of {_runs(totals.values())}, best first: "
    ratio = max(means.values()) / max(min(means.values()), 1e-9)
    end = f". The best reaches {ratio:.3g} times the last." if len(means) > 1 else "."
    return start + fit(_ranking(means), ROOM - len(start) - len(end)) + end


def describe_tau(
    totals: Mapping[str, tuple], *, paper: Mapping[str, float] | None = None
) -> str:
    """
    Return the alt text of ``plot_tau``: the best tau of each arm.

    >>> describe_tau({"nd-hard": (np.array([1e6, 3.5e6]), np.array([[5], [7]]))})
    'The tau with most goals, in million steps, mean of 1 run, and those goals:
    ND hard 3.5 (7).'
    """
    totals = tau_arrays(totals)
    best = {arm: goals.mean(axis=1).argmax() for arm, (_, goals) in totals.items()}
    items = [
        f"{arm_style(arm).name} {taus[best[arm]] / 1e6:g} "
        f"({thousands(goals[best[arm]].mean())})"
        for arm, (taus, goals) in totals.items()
    ]
    runs = _runs([goals.T for _, goals in totals.values()])
    start = (
        f"The tau with most goals, in million steps, mean of {runs}, and those goals: "
    )
    end = "."
    if paper:
        known = [arm for arm in totals if arm in paper]
        same = sum(np.isclose(totals[arm][0][best[arm]], paper[arm]) for arm in known)
        end = f". The paper's tau is the best for {same} of {len(known)}."
    return start + fit(items, ROOM - len(start) - len(end)) + end


def thousands(x: float) -> str:
    """
    Return a number of goals with three digits or so.

    >>> thousands(567_123), thousands(9_400), thousands(12), thousands(0)
    ('567k', '9.4k', '12', '0')
    """
    if abs(x) >= 99_950:
        return f"{x / 1000:.0f}k"
    if abs(x) >= 1000:
        return f"{x / 1000:.1f}".removesuffix(".0") + "k"
    return f"{x:.3g}"


def fit(items: Sequence[str], room: int) -> str:
    """
    Return the items as a list; where room is short, the middle is left out.

    >>> fit(["ND 5", "Prob 4", "Grad 3", "random 2", "Q-learning 1"], 38)
    'ND 5, Prob 4, 2 more, Q-learning 1'
    """
    text = ", ".join(items)
    kept = len(items) - 1
    while len(text) > room and kept > 1:
        kept -= 1
        left_out = f"{len(items) - kept - 1} more"
        text = ", ".join([*items[:kept], left_out, items[-1]])
    return text


def arm_arrays(data: Mapping[str, np.ndarray], ndim: int) -> dict[str, np.ndarray]:
    """Return the data of each arm as floats, (N,) or (N, B), or refuse them."""
    if not data:
        raise ValueError("data must hold at least one arm, got none")
    arrays = {arm: np.asarray(x, dtype=float) for arm, x in data.items()}
    for arm, x in arrays.items():
        arm_style(arm)
        if x.ndim != ndim or not x.size or not np.isfinite(x).all():
            shape = "(N,)" if ndim == 1 else "(N, B)"
            raise ValueError(
                f"data of {arm!r} must be finite and of shape {shape}, got {x.shape}"
            )
    if len({x.shape[1:] for x in arrays.values()}) > 1:
        raise ValueError("all arms must have the same number of windows")
    return arrays


def tau_arrays(data: Mapping[str, tuple]) -> dict[str, tuple]:
    """Return (taus, goals) of each arm, taus ascending, or refuse them."""
    if not data:
        raise ValueError("data must hold at least one arm, got none")
    pairs = {}
    for arm, (taus, goals) in data.items():
        taus, goals = np.asarray(taus, dtype=float), arm_arrays({arm: goals}, 2)[arm]
        if taus.shape != goals.shape[:1]:
            raise ValueError(
                f"data of {arm!r} must be taus (n,) and goals (n, N), "
                f"got {taus.shape} and {goals.shape}"
            )
        order = np.argsort(taus, kind="stable")
        pairs[arm] = taus[order], goals[order]
    return pairs


def _ranking(means: Mapping[str, float]) -> list[str]:
    order = sorted(means, key=means.get, reverse=True)
    return [f"{arm_style(arm).name} {thousands(means[arm])}" for arm in order]


def _runs(arrays) -> str:
    sizes = sorted({len(x) for x in arrays})
    if len(sizes) > 1:
        return f"{sizes[0]} to {sizes[-1]} runs"
    return f"{sizes[0]} run{'s' * (sizes[0] != 1)}"
