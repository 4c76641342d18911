"""Exercises of page 10: why the worst driver teaches best."""

from ._model import Wrong, value

EXERCISES = [
    value(
        "ex-10-1",
        "Prob gives an action the probability 0.8 where four actions are available. "
        "The "
        "page is mixed half and half with the uniform page over available actions. How "
        "likely is the action now?",
        0.525,
        tolerance=1e-3,
        hints=(
            "A mixture follows one page or the other, by the toss of a coin.",
            "The uniform page gives the action 1/4.",
            "Half of 0.8 plus half of 0.25.",
        ),
        wrong=[
            Wrong("over all 8 actions", 0.4625, "Only 4 are available: 1/4, not 1/8."),
            Wrong("half of it", 0.4, "The other page gives the action something too."),
            Wrong("the product", 0.2, "A mixture adds; it does not multiply."),
            Wrong("not halved", 1.05, "That is above 1: each page has half a say."),
        ],
    ),
    value(
        "ex-10-2",
        "Two cells send the robot back and forth: in each the advice is 0.99 for the "
        "move "
        "to the other and 0.01 for the way out. After how many steps, on average, is "
        "it "
        "out? No move fails.",
        100,
        tolerance=1e-3,
        hints=(
            "Both cells are alike: each step is one try.",
            "Each step leaves with probability 0.01.",
            "On average a try of probability p takes 1/p steps.",
        ),
        wrong=[
            Wrong(
                "two cells, twice as long", 200, "Each step is a try, in either cell."
            ),
            Wrong("the steps inside", 99, "The step that leaves is a step too."),
            Wrong("both must fail", 10_000, "One way out is enough."),
            Wrong(
                "until half of them are out", 69, "That is the median, not the mean."
            ),
        ],
    ),
    value(
        "ex-10-3",
        "A page gives the three actions of an abstract state the probabilities 0.9, "
        "0.1 "
        "and 0. One beta keeps the same set of actions, but forgets how often. Which?",
        0,
        hints=(
            "Which of the pages ND, Prob and Grad forgets how often?",
            "The dial gives p to the power beta, where p is above 0.",
            "Which exponent turns 0.9 and 0.1 into the same number?",
        ),
        wrong=[
            Wrong("nothing changes", 1, "Beta = 1 gives the page itself."),
            Wrong(
                "confidence", float("inf"), "That leaves the most frequent action only."
            ),
            Wrong("an even sharper page", 2, "Squares make the difference larger."),
            Wrong("the square root", 0.5, "That comes closer: 3 to 1. Not yet equal."),
        ],
    ),
]
