"""The still of the filling boxes: box plots after 5, 10 and all runs."""

from __future__ import annotations

from ...experiments.results import read_results
from ...experiments.stats import t_interval
from ...reproduction.optional_stopping import FIRST_LOOK, SAME
from ..base import Still
from ..parts.charts import Axis, Row, row_chart
from ..parts.svg import look_of, short
from .widget import Filling

FRAMES = (5, 10)  # runs of the first two pictures; the last shows all


def draw(scene: Filling) -> Still:
    """Return the boxes three times, and the means of all."""
    results, order = read_results(scene.results), scene.data["lives"][scene.order]
    taken = [order[:n] for n in (*FRAMES, len(order))]
    goals = {arm.name: results.totals(arm.name) for arm in results.arms}
    ends = [float(f(map(f, goals.values()))) for f in (min, max)]
    means = [{arm: t_interval(x[some]) for arm, x in goals.items()} for some in taken]
    frames = []
    for some, mean in zip(taken, means, strict=True):
        boxes = [
            Row(look_of(arm).name, short(of[0]), arm, box=goals[arm][some], mean=of)
            for arm, of in mean.items()
        ]
        best = max(mean, key=lambda arm: mean[arm].estimate)
        alt = (
            f"Box plots of the goals of {len(some)} runs, nine arms, with the mean "
            f"and its interval. Best: {look_of(best).name}, {short(mean[best][0])}."
        )
        ticks = {end: short(end) for end in ends}
        axis = Axis(*ends, ticks, f"goals of a run, {len(some)} runs")
        frames.append(row_chart(boxes, axis, alt))
    found, trap = scene.reading("1"), scene.reading(SAME)
    signed = sum(map(bool, trap.stops))
    caption = (
        f"When would you sign? Claim 1 comes out as \u201c{found.verdict}\u201d "
        f"from {found.settled} runs on, in each of {len(found.stops)} orders of "
        f"{len(order)} runs. But of {len(trap.stops)} comparisons of one half of an "
        f"arm's runs with the other half, a reader who looks after each run from run "
        f"{FIRST_LOOK} on, "
        f"and signs as soon as the interval leaves 0, signs {signed}: "
        f"{signed / len(trap.stops):.0%}."
    )
    rows = [
        (
            look_of(arm).name,
            *("{:,.0f} [{:,.0f}, {:,.0f}]".format(*mean[arm]) for mean in means),
        )
        for arm in goals
    ]
    head = ("arm", *(f"mean of {len(some)} runs, interval" for some in taken))
    return Still(frames, caption, head, rows)
