"""Learning runs as pictures with alt texts: curves, boxes, and what tau does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .style import COLOR, SMALL, WIDTH, arm_style, label_gap, new_axes, spread

MILLION = 1_000_000
WINDOW = 500_000  # steps
ROOM = 290  # characters of an alt text


def plot_curves(
    goals: Mapping[str, np.ndarray],
    ax=None,
    *,
    bands: Mapping[str, tuple] | None = None,
    window: int = WINDOW,
):
    """
    Draw how many goals each arm reaches per window, on average over its runs.

    Parameters
    ----------
    goals : dict from arm to ndarray, shape (N, B)
        N runs, B windows; the same B for all arms.
    ax : matplotlib Axes, optional
    bands : dict from arm to (low, high), optional
        Ends of an interval of the mean, each of shape (B,).
    window : int, default 500,000
        Steps per window.

    Returns
    -------
    ax : matplotlib Axes
    """
    means = {arm: x.mean(axis=0) for arm, x in arm_arrays(goals, 2).items()}
    ax = new_axes(ax, (WIDTH, 4.2))
    n_windows = len(next(iter(means.values())))
    unit, unit_name = (MILLION, "million") if window * n_windows >= MILLION else (1, "")
    steps = (np.arange(n_windows) + 0.5) * window / unit
    every = max(1, n_windows // 6)
    for i, (arm, mean) in enumerate(means.items()):
        first = i * every // len(means)
        _line(ax, arm, steps, mean, markevery=(first, every))
        _band(ax, arm, steps, (bands or {}).get(arm))
    ends = {arm: mean[-1] for arm, mean in means.items()}
    ax.set_ylim(bottom=0)
    _label_ends(ax, steps[-1], n_windows * window / unit, ends)
    ax.set_xlabel(f"steps, {unit_name}".removesuffix(", "), loc="left")
    ax.set_ylabel(f"goals per {window:,} steps")
    return ax


def plot_boxes(totals: Mapping[str, np.ndarray], ax=None):
    """
    Draw the goals of each arm's runs: extremes, quartiles, median; print the mean.

    Boxes and marks of soft arms are hollow.

    Parameters
    ----------
    totals : dict from arm to ndarray, shape (N,)
        Goals of each run.
    ax : matplotlib Axes, optional
    """
    totals = arm_arrays(totals, 1)
    ax = new_axes(ax, (WIDTH, 0.9 + 0.36 * len(totals)))
    for y, (arm, x) in enumerate(totals.items()):
        style = arm_style(arm)
        low, q1, median, q3, high = np.percentile(x, (0, 25, 50, 75, 100))
        ax.plot([low, high], [y, y], color=style.color, linewidth=1.2, zorder=1)
        box = {"height": 0.56, "linewidth": 1.2, "edgecolor": style.color, "zorder": 2}
        ax.barh(y, q3 - q1, left=q1, color=style.face, **box)
        ax.plot([median] * 2, [y - 0.42, y + 0.42], color=style.color, linewidth=1.6)
        name = {"textcoords": "offset points", "va": "center", "fontsize": SMALL}
        ax.annotate(thousands(x.mean()), (high, y), (6, 0), **name)
    low, high = ax.get_xlim()
    ax.set_xlim(low - 0.08 * (high - low), high + 0.14 * (high - low))
    for y, arm in enumerate(totals):
        style = arm_style(arm)
        mark = {"marker": style.marker, "color": style.color, "markersize": 8}
        ax.plot(
            0.02,
            y,
            markerfacecolor=style.face,
            transform=ax.get_yaxis_transform(),
            **mark,
        )
    ax.set_yticks(range(len(totals)), [arm_style(arm).name for arm in totals])
    ax.tick_params(axis="y", length=0)
    ax.set_ylim(len(totals) - 0.4, -0.6)
    ax.locator_params(axis="x", nbins=5)
    ax.xaxis.set_major_formatter(lambda x, _: thousands(x))
    ax.set_xlabel("goals of a run (number: the mean)", loc="left")
    return ax


def plot_tau(
    totals: Mapping[str, tuple],
    ax=None,
    *,
    bands: Mapping[str, tuple] | None = None,
    paper: Mapping[str, float] | None = None,
):
    """
    Draw the goals of each arm by tau, the steps during which advice is taken.

    Parameters
    ----------
    totals : dict from arm to (taus, goals)
        taus (n,) in steps, goals (n, N) of each run.
    ax : matplotlib Axes, optional
    bands : dict from arm to (low, high), optional
        Ends of an interval of the mean, each of shape (n,).
    paper : dict from arm to float, optional
        The paper's tau of an arm, drawn as a ring.
    """
    totals = tau_arrays(totals)
    ax = new_axes(ax, (WIDTH, 4.2))
    ends, last = {}, max(taus.max() for taus, _ in totals.values()) / MILLION
    for arm, (taus, goals) in totals.items():
        taus, mean = taus / MILLION, goals.mean(axis=1)
        _line(ax, arm, taus, mean)
        _band(ax, arm, taus, (bands or {}).get(arm))
        ends[arm] = mean[-1]
        best = mean.argmax()
        ax.plot(taus[best], mean[best], marker="|", color=COLOR["ink"], markersize=16)
        if arm in (paper or {}):
            at = np.interp(paper[arm] / MILLION, taus, mean)
            ring = {"markersize": 13, "markerfacecolor": "none"}
            color = arm_style(arm).color
            ax.plot(paper[arm] / MILLION, at, marker="o", color=color, **ring)
    _label_ends(ax, last, last, ends)
    rings = "; ring: the paper's" if paper else ""
    ax.set_xlabel(f"tau, million steps; bar: the best{rings}", loc="left")
    ax.set_ylabel("goals of a run")
    return ax


def describe_curves(goals: Mapping[str, np.ndarray]) -> str:
    """
    Return the alt text of :func:`plot_curves`: who leads at the end, and at the start.

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
    Return the alt text of :func:`plot_boxes`: the arms by their mean, best first.

    >>> describe_boxes({"none": np.array([250_000, 270_000]), "rand-hard":
    ...                 np.array([430_000, 440_000])})
    'Goals of a run, mean of 2 runs, best first: wanderer hard 435k, Q-learning 260k.
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
    Return the alt text of :func:`plot_tau`: the best tau of each arm.

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

    >>> fit(["ND 5", "Prob 4", "Grad 3", "wanderer 2", "Q-learning 1"], 38)
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


def _line(ax, arm, x, y, **options):
    style = arm_style(arm)
    look = {"color": style.color, "linestyle": style.dash, "linewidth": 1.6}
    mark = {"marker": style.marker, "markersize": 6, "markerfacecolor": style.face}
    ax.plot(x, y, **look, **mark, **options)


def _band(ax, arm, x, band):
    if band is None:
        return
    low, high = (np.asarray(end, dtype=float) for end in band)
    if low.shape != x.shape or high.shape != x.shape:
        raise ValueError(
            f"bands[{arm!r}] must be two arrays of shape {x.shape}, "
            f"got {low.shape} and {high.shape}"
        )
    ax.fill_between(x, low, high, color=arm_style(arm).color, alpha=0.18, linewidth=0)


def _label_ends(ax, x, x_max, ends: Mapping[str, float]):
    """Print each arm's name to the right of its line; widen the axes for them."""
    ax.yaxis.set_major_formatter(lambda y, _: thousands(y))
    low, right = ax.get_xlim()[0], x_max * 1.5
    ax.set_xlim(low, right)
    ax.set_xticks([tick for tick in ax.get_xticks() if low <= tick <= x_max])
    ax.spines["bottom"].set_bounds(low, x_max)
    places = spread(list(ends.values()), label_gap(ax))
    for (arm, y), at in zip(ends.items(), places, strict=True):
        style = arm_style(arm)
        line = {"arrowstyle": "-", "color": style.color, "linewidth": 0.6, "shrinkA": 0}
        line["relpos"] = (0, 0.5)  # to the left end of the name, not through it
        look = {"color": style.color, "fontsize": SMALL, "va": "center"}
        ax.annotate(style.name, (x, y), (x_max * 1.1, at), arrowprops=line, **look)


def _ranking(means: Mapping[str, float]) -> list[str]:
    order = sorted(means, key=means.get, reverse=True)
    return [f"{arm_style(arm).name} {thousands(means[arm])}" for arm in order]


def _runs(arrays) -> str:
    sizes = sorted({len(x) for x in arrays})
    if len(sizes) > 1:
        return f"{sizes[0]} to {sizes[-1]} runs"
    return f"{sizes[0]} run{'s' * (sizes[0] != 1)}"
