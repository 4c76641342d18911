"""Exercises of page 6: deducing, or climbing."""

import numpy as np

from ._model import Open, Wrong, function, stub, value


def numerical_gradient(f, x):
    """Return the derivative of f by each entry of x (n,), by central differences."""
    h = 1e-5
    slopes = [(f(x + h * e) - f(x - h * e)) / (2 * h) for e in np.eye(len(x))]
    return np.array(slopes)


def numerical_gradient_by_loop(f, x):
    gradient, x = [], np.array(x, float)
    for i in range(len(x)):
        old, x[i] = x[i], x[i] + 1e-6
        above = f(x)
        x[i] = old
        gradient.append((above - f(x)) / 1e-6)
    return gradient


def _not_divided(f, x):
    return 2e-5 * numerical_gradient(f, x)


def _divided_by_h(f, x):
    return 2 * numerical_gradient(f, x)


def _all_at_once(f, x):
    slope = (f(x + 1e-5) - f(x - 1e-5)) / 2e-5
    return np.full(len(x), slope)


def _direction_only(f, x):
    slopes = numerical_gradient(f, x)
    return slopes / np.linalg.norm(slopes)


def _too_large(f, x):
    return np.array([f(x + e) - f(x) for e in np.eye(len(x))])


def sum_of_squares(x):
    return float(np.sum(np.square(x)))


def product_of_sines(x):
    return float(np.prod(np.sin(x)))


def mixed(x):
    return float(x[0] ** 3 - 2 * x[0] * x[-1] + np.exp(0.3 * x[-1]))


def _hills(rng):
    for f in (sum_of_squares, product_of_sines, mixed):
        for n in (2, 4):
            yield f, rng.uniform(0.3, 1.2, n).round(2)


def assemble(d, q, rho, terminal, n_abstract, gamma):
    """Return G (Z, A): gamma times the sum of d(s) q(s, a) over an abstract state."""
    gradient = np.zeros((n_abstract, q.shape[1]))
    for s in range(len(rho)):
        if not terminal[s]:
            gradient[rho[s]] += gamma * d[s] * q[s]
    return gradient


def assemble_by_matrix(d, q, rho, terminal, n_abstract, gamma):
    member = np.eye(n_abstract)[rho] * np.where(terminal, 0, d)[:, None]
    return gamma * member.T @ q


def _averaged(d, q, rho, terminal, n_abstract, gamma):
    n = np.bincount(rho[~terminal], minlength=n_abstract)[:, None]
    return assemble(d, q, rho, terminal, n_abstract, gamma) / np.maximum(n, 1)


def _weighted_mean(d, q, rho, terminal, n_abstract, gamma):
    steps = np.bincount(rho, np.where(terminal, 0, d), minlength=n_abstract)[:, None]
    steps = np.where(steps > 0, steps, 1)
    return assemble(d, q, rho, terminal, n_abstract, gamma) / steps


def _overwritten(d, q, rho, terminal, n_abstract, gamma):
    gradient = np.zeros((n_abstract, q.shape[1]))
    gradient[rho[~terminal]] += gamma * (d[:, None] * q)[~terminal]
    return gradient


def _unions(rng):
    sizes = (3, 3, 3, 6, 6, 12), (3, 4, 4, 4, 5, 6), (0.99, 0.9, 0.9, 0.99, 0.9, 0.95)
    for n_states, n_abstract, gamma in zip(*sizes, strict=True):
        rho = rng.integers(0, 3, n_states)
        rho[:2] = rng.integers(3)  # two states that look alike
        terminal = np.arange(n_states) == rng.choice([0, n_states - 1])
        d, q = rng.uniform(0.2, 3, n_states), rng.uniform(-9, -1, (n_states, 2))
        yield d.round(1), q.round(1), rho, terminal, n_abstract, gamma


EXERCISES = [
    function(
        "ex-6-1",
        "Write `numerical_gradient`: how fast the number `f(x)` grows with each entry "
        "of the array `x`, by small differences.",
        numerical_gradient,
        cases=_hills,
        stub=stub(
            """\
def numerical_gradient(f, x):
    h = 1e-5
    return np.array([{slope} for e in np.eye(len(x))])
""",
            slope=(
                "(f(x + h * e) - f(x - h * e)) / (2 * h)",
                {
                    "differences instead of slopes": "f(x + h * e) - f(x - h * e)",
                    "half the distance": "(f(x + h * e) - f(x - h * e)) / h",
                    "all entries at once": "(f(x + h) - f(x - h)) / (2 * h)",
                    "a giant step": "f(x + e) - f(x)",
                    "the sign": "(f(x - h * e) - f(x + h * e)) / (2 * h)",
                },
            ),
        ),
        same=(numerical_gradient_by_loop,),
        tolerance=1e-3,
        hints=(
            "Change one entry of `x` a little, the others not at all.",
            "Take `h = 1e-5`; compare `f` a step h above with `f` a step h below, and "
            "divide by how far apart they are.",
            "`[(f(x + h * e) - f(x - h * e)) / (2 * h) for e in np.eye(len(x))]`.",
        ),
        wrong=[
            Wrong(
                "differences instead of slopes",
                _not_divided,
                "All nearly 0. Divide the difference of the values by the distance of "
                "the "
                "points; and if you do, is the step so small that x + h is x to the "
                "computer? Doubles have 16 digits; take about 1e-5.",
            ),
            Wrong(
                "half the distance",
                _divided_by_h,
                "From x - h to x + h the distance is 2 h.",
            ),
            Wrong(
                "all entries at once",
                _all_at_once,
                "That is the slope along a diagonal. Change one entry at a time.",
            ),
            Wrong(
                "the direction only",
                _direction_only,
                "You divide by the length at the end. How steep it is belongs to it.",
            ),
            Wrong(
                "a giant step",
                _too_large,
                "Your step has length 1. A slope is what is left as the step gets "
                "small.",
            ),
            Wrong(
                "the sign",
                lambda f, x: -numerical_gradient(f, x),
                "Value above less value below, not the other way round.",
            ),
        ],
    ),
    function(
        "ex-6-2",
        "Write `assemble`, the gradient G (Z, A) from the visits d (S,), the action "
        "values q (S, A) and the abstract state rho (S,) of each state. Terminal "
        "states "
        "have no part in it.",
        assemble,
        cases=_unions,
        stub=stub(
            """\
def assemble(d, q, rho, terminal, n_abstract, gamma):
    gradient = np.zeros((n_abstract, q.shape[1]))
    for s in range(len(rho)):
        if {counts}:
            {adds}
    return gradient
""",
            counts=("not terminal[s]", {"the goal counts": "d[s] > 0"}),
            adds=(
                "gradient[rho[s]] += gamma * d[s] * q[s]",
                {
                    "no discount": "gradient[rho[s]] += d[s] * q[s]",
                    "no visits": "gradient[rho[s]] += gamma * q[s]",
                    "one of those that look alike": (
                        "gradient[rho[s]] = gamma * d[s] * q[s]"
                    ),
                },
            ),
        ),
        same=(assemble_by_matrix,),
        hints=(
            "Each state gives something to the row of its abstract state.",
            "State s gives `gamma * d[s] * q[s]`. Which states give nothing? Several "
            "states may give to the same row: add, do not overwrite.",
            "`G = np.zeros((n_abstract, q.shape[1]))`, `d = np.where(terminal, 0, d)`, "
            "`np.add.at(G, rho, gamma * d[:, None] * q)`.",
        ),
        wrong=[
            Wrong(
                "no discount",
                lambda d, q, rho, terminal, n, gamma: assemble(
                    d, q, rho, terminal, n, 1
                ),
                "The action is taken now, what it leads to comes one step later: "
                "gamma.",
            ),
            Wrong(
                "no visits",
                lambda d, q, rho, terminal, n, gamma: assemble(
                    np.ones(len(d)), q, rho, terminal, n, gamma
                ),
                "A state that the robot is in more often counts more: weigh by d.",
            ),
            Wrong(
                "a mean instead of a sum",
                _averaged,
                "The states of an abstract state add up: one knob moves all of them.",
            ),
            Wrong(
                "divided by the visits",
                _weighted_mean,
                "That is the mean of q, and the *natural* gradient is made of it. The "
                "gradient itself is the sum.",
            ),
            Wrong(
                "the goal counts",
                lambda d, q, rho, terminal, n, gamma: assemble(
                    d, q, rho, np.zeros(len(d), bool), n, gamma
                ),
                "The episode ends in a terminal state: no action is taken there.",
            ),
            Wrong(
                "one of those that look alike",
                _overwritten,
                "Where two states look alike, this keeps one of them only, as "
                "`G[rho] += ...` does. `np.add.at` keeps both.",
            ),
        ],
    ),
    value(
        "ex-6-3",
        "An abstract state allows 3 of the 8 actions. The target of a step gives 0.95 "
        "to "
        "the best action and spreads 0.05 over all 8; what falls on impossible "
        "actions is "
        "given back in proportion. How likely is the best action in the target?",
        (0.95 + 0.05 / 8) / (0.95 + 3 * 0.05 / 8),
        also=((0.5 + (0.95 + 0.05 / 8) / (0.95 + 3 * 0.05 / 8)) / 2,),
        share=True,
        tolerance=1e-3,
        hints=(
            "First forget that five are impossible: what has the best action, what "
            "have the two others?",
            "The best action has 0.95 + 0.05/8, the two others 0.05/8 each.",
            "Divide the first of these by the sum of the three: `(0.95 + 0.05 / 8) / "
            "(0.95 + 3 * 0.05 / 8)`.",
        ),
        wrong=[
            Wrong(
                "not normalised",
                0.95 + 0.05 / 8,
                "Five actions are impossible. What is left must sum to 1: divide.",
            ),
            Wrong(
                "the best gets no share of the 0.05",
                0.95,
                "The 0.05 is spread over all 8 actions, the best one included.",
            ),
            Wrong(
                "shared out equally",
                0.95 + 0.05 / 3,
                "You give each of the three an equal part of the 0.05. It is spread "
                "over all 8; what the impossible have is given back *in proportion*.",
            ),
            Wrong("no softness", 1, "A little is kept for the other actions."),
        ],
    ),
    value(
        "ex-6-3b",
        "The row was (0.5, 0.3, 0.2), and its first action is the best. The first step "
        "goes half of the way to the target. How likely is the best action after it?",
        (0.5 + (0.95 + 0.05 / 8) / (0.95 + 3 * 0.05 / 8)) / 2,
        share=True,
        tolerance=1e-3,
        hints=(
            "Half of the way from a to b is the middle of the two.",
            "It was 0.5. What the target gives to it is the first question.",
            "`(0.5 + (0.95 + 0.05 / 8) / (0.95 + 3 * 0.05 / 8)) / 2`.",
        ),
        wrong=[
            Wrong(
                "all of the way",
                (0.95 + 0.05 / 8) / (0.95 + 3 * 0.05 / 8),
                "That is the target. The step goes half of the way.",
            ),
            Wrong(
                "half of the target",
                (0.95 + 0.05 / 8) / (0.95 + 3 * 0.05 / 8) / 2,
                "Half of the way begins at 0.5, not at 0.",
            ),
            Wrong(
                "not normalised",
                (0.5 + 0.95 + 0.05 / 8) / 2,
                "Five actions are impossible. What the target gives must sum to 1.",
            ),
            Wrong("no step", 0.5, "There it was before."),
        ],
    ),
]

OPEN = [
    Open(
        "ex-6-4",
        hints=(
            "Three states for each task; no arrow joins the tasks.",
            "At a wall the robot stays.",
            "What does a robot pay that never arrives? In how many of the six states "
            "does it start?",
        ),
        good="six states, no arrow from task to task; best at one half with -3.20, and "
        "-33.83 at both ends",
    ),
]
