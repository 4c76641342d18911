"""
Every numbered equation of the book, tested against the code on random inputs.

The label of an equation names its test here: eq-q-learning is proved by the function
that is registered as such; an equation without a test fails.  Each test writes the
formula out in plain Python, as it is printed.
"""

import json
import re

import numpy as np
import pytest
from support import ROOT

import abstransfer as at
from abstransfer.abstraction import FEATURES
from abstransfer.builders.deduced import absprob_pi, abstract_gradient, natural_ascent
from abstransfer.learning import q_learning
from abstransfer.policies import beta_policy
from abstransfer.solvers import value_iteration

LABEL = re.compile(r":label: (eq-[\w-]+)")
TESTS = {}
SEEDS = range(5)


def proves(*labels):
    """Register a function of a seed as the test of these equations."""

    def register(function):
        TESTS.update(dict.fromkeys(labels, function))
        return function

    return register


def printed():
    """Return the labels of all equations in the book."""
    found = {}
    for path in (ROOT / "book").iterdir():
        if path.suffix == ".ipynb":
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
            text = "\n".join("".join(cell["source"]) for cell in cells)
        elif path.suffix == ".md":
            text = path.read_text(encoding="utf-8")
        else:
            continue
        found |= dict.fromkeys(LABEL.findall(text), path.stem)
    return found


def test_every_equation_of_the_book_has_a_test():
    assert len(printed()) >= 3
    assert not set(printed()) - set(TESTS), "register a test below"


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("label", TESTS)
def test_the_code_does_what_the_equation_says(label, seed):
    TESTS[label](np.random.default_rng(seed))


def random_mdp(rng, n_states=6, n_actions=3, gamma=0.9):
    """Return an MDP with random rewards, whose last state is terminal."""
    next_state = rng.integers(0, n_states, (n_states, n_actions, 2))
    prob = rng.random((n_states, n_actions, 2))
    return at.MDP(
        next_state,
        prob / prob.sum(axis=2, keepdims=True),
        rng.normal(size=n_states),
        np.arange(n_states) == n_states - 1,
        gamma,
    )


def random_policy(rng, *shape):
    weight = rng.random(shape) + 0.05
    return weight / weight.sum(axis=-1, keepdims=True)


def T(mdp):
    """Return T(s, a, s') as an array; what ends an episode leads nowhere."""
    dense = np.zeros((mdp.n_states, mdp.n_actions, mdp.n_states))
    for s in np.flatnonzero(~mdp.terminal):
        for a in range(mdp.n_actions):
            for outcome, p in zip(mdp.next_state[s, a], mdp.prob[s, a], strict=True):
                dense[s, a, outcome] += p
    return dense


def moves(mdp, policy):
    return np.einsum("sa,sat->st", policy, T(mdp))


@proves("eq-return", "eq-value")
def discounted_sums(rng):
    """The mean discounted return of sampled walks is the value of their start."""
    mdp = random_mdp(rng, gamma=0.5)
    policy = random_policy(rng, 6, 3)
    bound = moves(mdp, policy).cumsum(axis=1)
    returns = np.zeros(2000)
    for walk in range(len(returns)):
        s = 0
        for t in range(30):
            returns[walk] += 0.5**t * mdp.reward[s]
            if mdp.terminal[s]:
                break
            s = min(np.searchsorted(bound[s], rng.random(), side="right"), 5)

    error = np.std(returns) / np.sqrt(len(returns))
    value = at.evaluate_policy(mdp, policy)[0]
    assert abs(np.mean(returns) - value) < 5 * error + 1e-6
    assert error < 0.1


@proves("eq-value-recursion")
def value_recursion(rng):
    mdp, policy = random_mdp(rng), random_policy(rng, 6, 3)
    v, dense = at.evaluate_policy(mdp, policy), T(mdp)

    for s in range(6):
        following = sum(
            dense[s, a, t] * policy[s, a] * v[t] for t in range(6) for a in range(3)
        )
        assert v[s] == pytest.approx(mdp.reward[s] + mdp.gamma * following)


@proves("eq-value-system")
def value_system(rng):
    mdp, policy = random_mdp(rng), random_policy(rng, 6, 3)
    system = np.eye(6) - mdp.gamma * moves(mdp, policy)

    np.testing.assert_allclose(
        system @ at.evaluate_policy(mdp, policy), mdp.reward, atol=1e-12
    )


@proves("eq-backup")
def backup(rng):
    mdp = random_mdp(rng)
    sweeps = value_iteration(mdp)
    before, after, dense = next(sweeps), next(sweeps), T(mdp)

    for s in range(6):
        best = max(sum(dense[s, a, t] * before[t] for t in range(6)) for a in range(3))
        assert after[s] == pytest.approx(mdp.reward[s] + mdp.gamma * best)


@proves("eq-q-learning")
def q_learning_step(rng):
    """Replay a trace: each step changes one entry, as printed, to the last digit."""
    mdp = random_mdp(rng)
    q0 = rng.normal(size=(6, 3))
    q0[-1] = 0
    run = q_learning(mdp, 200, rng=0, trace=200, q0=q0, alpha=0.3, gamma=0.8)
    q, trace = q0.copy(), run.trace
    for t in range(200):
        s, a, s_next = trace.state[t], trace.action[t], trace.next_state[t]
        q[s, a] = (1 - 0.3) * q[s, a] + 0.3 * (trace.reward[t] + 0.8 * max(q[s_next]))

    np.testing.assert_allclose(q, run.q, atol=1e-12)
    assert (run.cuts.sum(), len(trace.state)) == (0, 200)


def views(rng):
    """Return tasks of the source building with some of the features, and these."""
    keep = sorted(rng.choice(len(FEATURES), rng.integers(4, 12), replace=False))
    names = [FEATURES[f] for f in keep]
    return at.navigation_tasks(at.read_map("source"), features=names), names


@proves("eq-rho")
def rho_is_a_sum_of_powers(rng):
    tasks = at.navigation_tasks(at.read_map("source"))
    for s in rng.choice(tasks.mdp.n_states, 40):
        seen = {tasks.actions[i] for i in tasks.labels[s] if i >= 0}
        x = [name in seen for name in FEATURES[:8]]
        x += [tasks.rho[s] >> f & 1 for f in (8, 9, 10)]  # distances and rooms
        assert tasks.rho[s] == sum(2**f * x[f] for f in range(11))


@proves("eq-sigma")
def same_features_same_abstract_state(rng):
    tasks, names = views(rng)
    full = at.navigation_tasks(at.read_map("source"))
    bits = [FEATURES.index(name) for name in names]
    mu = [tuple(z >> bit & 1 for bit in bits) for z in full.rho]
    for a, b in rng.choice(len(mu), (200, 2)):
        assert (mu[a] == mu[b]) == (tasks.rho[a] == tasks.rho[b])


def votes_of(rng):
    """Return deterministic optimal policies of three tasks, and what is seen."""
    rho = rng.integers(0, 4, 40)
    task, best = rng.integers(0, 3, 40), rng.integers(0, 3, 40)
    return rho, task, best


@proves("eq-prob")
def prob_counts(rng):
    rho, task, best = votes_of(rng)
    ours = at.induce_probabilistic(np.eye(3)[best], rho, np.ones((4, 3), bool))
    for z in np.unique(rho):
        for a in range(3):
            wants = sum(sum((task == i) & (rho == z) & (best == a)) for i in range(3))
            alike = sum(sum((task == i) & (rho == z)) for i in range(3))
            assert ours[z, a] == pytest.approx(wants / alike)


@proves("eq-nd")
def nd_is_a_set(rng):
    rho, task, best = votes_of(rng)
    ours = at.induce_nondeterministic(np.eye(3)[best], rho, np.ones((4, 3), bool))
    for z in np.unique(rho):
        members = {
            a
            for a in range(3)
            if any(best[s] == a for i in range(3) for s in np.flatnonzero(task == i)
                   if rho[s] == z)
        }  # fmt: skip
        assert set(np.flatnonzero(ours[z])) == members
        np.testing.assert_allclose(ours[z][list(members)], 1 / len(members))


@proves("eq-beta", "eq-dial")
def dial(rng):
    p, beta = random_policy(rng, 5, 4), rng.uniform(0, 4)
    p[:, 0] = 0
    p /= p.sum(axis=1, keepdims=True)
    ours = beta_policy(p, beta)
    weight = np.array([[x**beta if x > 0 else 0 for x in row] for row in p])

    np.testing.assert_allclose(ours, weight / weight.sum(axis=1, keepdims=True))


def abstract(rng):
    mdp = random_mdp(rng)
    return mdp, random_policy(rng, 3, 3), rng.permutation([0, 0, 1, 1, 2, 2])


def start(rng):
    return random_policy(rng, 6)


@proves("eq-objective")
def objective(rng):
    (mdp, policy, rho), beta = abstract(rng), start(rng)
    value, _, _ = abstract_gradient(mdp, policy, rho, beta)

    v = at.evaluate_policy(mdp, policy[rho])
    assert value == pytest.approx(sum(beta[s] * v[s] for s in range(6)))


@proves("eq-visits")
def visits(rng):
    (mdp, policy, rho), beta = abstract(rng), start(rng)
    P, d, term = moves(mdp, policy[rho]), np.zeros(6), beta.copy()
    for _ in range(400):
        d += term
        term = mdp.gamma * term @ P
    _, _, ours = abstract_gradient(mdp, policy, rho, beta)

    np.testing.assert_allclose(
        ours, [sum(d[(rho == z) & ~mdp.terminal]) for z in range(3)]
    )


@proves("eq-gradient")
def gradient(rng):
    (mdp, policy, rho), beta = abstract(rng), start(rng)
    _, G, _ = abstract_gradient(mdp, policy, rho, beta)

    def value(p):
        """The objective where p is no probability any more: the formula of V."""
        P = np.einsum("sa,sat->st", p[rho], T(mdp))
        return beta @ np.linalg.solve(np.eye(6) - mdp.gamma * P, mdp.reward)

    for z in range(3):
        for a in range(3):
            h = np.zeros((3, 3))
            h[z, a] = 1e-6
            slope = (value(policy + h) - value(policy - h)) / 2e-6
            assert G[z, a] == pytest.approx(slope, rel=1e-5, abs=1e-6)


@proves("eq-climb")
def climbing(rng):
    mdp, policy, rho = abstract(rng)
    possible = np.ones((3, 3), bool)
    for i in (1, 2, 3):
        before = absprob_pi(
            mdp, rho, possible, initial=policy, iterations=i - 1, softness=0
        ).policy
        after = absprob_pi(
            mdp, rho, possible, initial=policy, iterations=i, softness=0
        ).policy
        _, G, seen = abstract_gradient(mdp, before, rho)
        for z in np.flatnonzero(seen > 0):
            ties = G[z] >= G[z].max() - 1e-9 * abs(G[z].max())
            best = np.eye(3)[ties.argmax()]  # the first of equally good ones
            expected = before[z] + 1 / (1 + i) * (best - before[z])
            np.testing.assert_allclose(after[z], expected)


@proves("eq-natural")
def natural_step(rng):
    """One step multiplies by exp(eta mean Q) in every row, with one eta for all."""
    mdp, policy, rho = abstract(rng)
    possible = np.ones((3, 3), bool)
    climb = natural_ascent(mdp, rho, possible, initial=policy, iterations=1, floor=0)
    P = moves(mdp, policy[rho])
    d = np.linalg.solve(np.eye(6) - mdp.gamma * P.T, np.full(6, 1 / 6)) * ~mdp.terminal
    q = at.action_values(mdp, at.evaluate_policy(mdp, policy[rho]))
    mean_q = np.array([d[rho == z] @ q[rho == z] / d[rho == z].sum() for z in range(3)])

    grown, worth = np.log(climb.policy / policy)[0], mean_q[0]
    eta = np.ptp(grown) / np.ptp(worth)
    weight = policy * np.exp(eta * mean_q)

    assert climb.history[1] > climb.history[0]
    np.testing.assert_allclose(climb.policy, weight / weight.sum(axis=1, keepdims=True))
