"""Exercises of page 9: Figures 3 and 4."""

from ._model import Open, Wrong, value

EXERCISES = [
    value(
        "ex-9-1",
        "The interval of a mean is to become a tenth as wide. How many times as many "
        "runs does that take?",
        100,
        hints=(
            "The mean of n runs varies by their standard deviation divided by the root "
            "of n. 95 % of a bell curve lie within 1.96 standard deviations.",
            "A tenth of the width: what happens to the root of n?",
            "The root must grow tenfold: `10**2`.",
        ),
        wrong=[
            Wrong(
                "no root", 10, "Ten times the runs narrow it by the root of 10 only."
            ),
            Wrong("the root of ten", 10**0.5, "The root must be 10, not the number."),
            Wrong("the third power", 1000, "The root of 1,000 is about 32: too much."),
            Wrong("runs, not times", 5000, "So many runs in all; how many times 50?"),
        ],
    ),
    value(
        "ex-9-2",
        "The runs of two arms are spread alike, and the correlation of partners is "
        "0.75. "
        "How wide is the interval in pairs, as a share of that with wrong partners?",
        0.5,
        share=True,
        hints=(
            "What partners share drops out of their difference. `np.roll` by 1 gives "
            "run i the partner i - 1; the first window is column 0 of the curves.",
            "`at.experiments.stats.t_interval(x - y)` makes the interval. The variance "
            "of a difference is 2 (1 - r) times that of one run.",
            "Without pairs r is 0. Take the root of 1 - r: `np.sqrt(1 - 0.75)`.",
        ),
        wrong=[
            Wrong(
                "no root", 0.25, "That is the ratio of the variances; take the root."
            ),
            Wrong("the correlation itself", 0.75, "What is shared drops out: 1 - r."),
            Wrong("the root of r", 0.75**0.5, "What is shared drops out: 1 - r."),
            Wrong("pairs add nothing", 1, "That would be so for a correlation of 0."),
        ],
        tolerance=1e-2,
    ),
    value(
        "ex-9-3",
        "Somebody looks after every run from the fifth to the fiftieth. How many "
        "looks "
        "are that?",
        46,
        hints=(
            "Count the first look and the last. `np.cumsum` gives the sums after each "
            "run at once.",
            "From 5 to 6 there are two looks. One look would be wrong in 5 % of all "
            "cases, and you take many.",
            "`50 - 5 + 1`.",
        ),
        wrong=[
            Wrong(
                "off by one", 45, "Both ends count: from 5 to 6 there are two looks."
            ),
            Wrong("all runs", 50, "There is no look after the first four."),
            Wrong(
                "one look", 1, "That would be fair, and wrong in 5 percent of cases."
            ),
            Wrong("off by one, the other way", 44, "Both ends count."),
        ],
    ),
    value(
        "ex-9-1b",
        "The goals of a run vary by 2 percent from run to run (one standard "
        "deviation). "
        "By how many percent does the mean of 50 runs vary?",
        2 / 50**0.5,
        tolerance=1e-2,
        hints=(
            "A mean of many runs varies less than one run. By which factor?",
            "Variances add up; the standard deviation of a mean of n runs falls with "
            "the square root of n.",
            "2 divided by the square root of 50: `2 / np.sqrt(50)`.",
        ),
        wrong=[
            Wrong("no gain from repeats", 2, "That is the spread of one run."),
            Wrong("divided by n", 2 / 50, "Divide by the square root of the number."),
            Wrong(
                "a sum, not a mean", 2 * 50**0.5, "The sum varies more, a mean less."
            ),
            Wrong(
                "an interval, not a deviation",
                4 / 50**0.5,
                "That is half of a 95 percent interval; asked is one standard "
                "deviation.",
            ),
        ],
    ),
    value(
        "ex-9-2b",
        "Arm X reached 3, 5 and 7 goals in three runs, arm Y 4, 4 and 6. How likely "
        "is a "
        "run of X to reach more goals than a run of Y, a tie counting half?",
        5 / 9,
        share=True,
        tolerance=1e-2,
        hints=(
            "Any run of X can meet any run of Y.",
            "There are nine pairs. In how many is X ahead?",
            "3 beats none, 5 beats both 4s, 7 beats all three.",
        ),
        wrong=[
            Wrong(
                "runs in the order they are written",
                2 / 3,
                "The runs are independent: the first of X is no partner of the first "
                "of Y.",
            ),
            Wrong(
                "the better mean is always ahead", 1, "A better mean can still lose."
            ),
            Wrong("a tie", 1 / 2, "Count the pairs; they are not balanced."),
            Wrong("the other arm", 4 / 9, "That is how likely Y is ahead of X."),
        ],
    ),
    value(
        "ex-9-3b",
        "How many points does each curve of Figure 4 have?",
        60,
        hints=(
            "Each point is a mean over 500,000 steps.",
            "The experiment has 30 million steps.",
            "30 million divided by half a million: `30_000_000 / 500_000`.",
        ),
        wrong=[
            Wrong("a point per run", 50, "The 50 runs are averaged into one curve."),
            Wrong(
                "a point per million", 30, "A point stands for half a million steps."
            ),
            Wrong("all runs", 3000, "The 50 runs are averaged into one curve."),
            Wrong("both ends", 61, "Windows are counted, not the marks between them."),
        ],
    ),
]

OPEN = [
    Open(
        "ex-9-4",
        hints=(
            "Does the interval hold 0?",
            "The rules stand above the first table.",
            "`at.reproduction.combine` takes a list of findings.",
        ),
        good="does not hold, undecided, holds, holds: it fails in part; without ND "
        "undecided",
    ),
    Open(
        "ex-9-5",
        hints=(
            "`at.reproduction.judge(finding.effect, margin, above=False)`.",
            "When did you see the effects?",
        ),
        good="only at 15 % do all four findings hold; and the margin was chosen with "
        "the effects in view",
    ),
]
