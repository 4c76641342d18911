"""The loops: their random words, their tables, and that all of them are one."""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import mdps

from abstransfer import MDP, navigation_tasks, read_map
from abstransfer.learning import Learner, q_learning_runs
from abstransfer.learning._fast import advance_three
from abstransfer.learning._rng import fill, next_word, seed_state
from abstransfer.learning._simd import count_below, put
from abstransfer.learning._tables import (
    _packed,
    distinct,
    integer_bounds,
    make_world,
    pack,
    pack_world,
)
from abstransfer.learning.loop import learn

ROOT = Path(__file__).parents[2]
TESTS = [str(ROOT / "tests"), str(ROOT / "tests" / "learning")]
PHASES = {
    "alone": {},
    "hard": {"strategy": "hard", "tau": 1200},
    "soft": {"strategy": "soft", "tau": 1200},
}


def random_mdp(seed, n_states=12, n_actions=8, n_outcomes=4, masked=0.3):
    """A random MDP: some outcomes of no chance, some masked actions, two goals."""
    rng = np.random.default_rng(seed)
    shape = n_states, n_actions, n_outcomes
    prob = rng.dirichlet(np.ones(n_outcomes), shape[:2])
    prob[rng.random(shape) < 0.2] = 0
    prob[..., 0] += prob.sum(axis=2) == 0
    allowed = rng.random(shape[:2]) >= masked
    allowed[:, rng.integers(n_actions)] = True
    return MDP(
        rng.integers(0, n_states, shape),
        prob / prob.sum(axis=2, keepdims=True),
        rng.normal(size=n_states).round(1),
        np.arange(n_states) >= n_states - 2,
        0.9,
        allowed,
    )


def random_guide(mdp, seed=0):
    weights = np.random.default_rng(seed).random(mdp.allowed.shape) * mdp.allowed
    return weights / weights.sum(axis=1, keepdims=True)


def options(mdp, phase):
    guide = {"guide": random_guide(mdp)} if PHASES[phase] else {}
    return {"max_episode": 40, "window": 700, **guide, **PHASES[phase]}


def assert_same(one, other, n_actions=None):
    np.testing.assert_array_equal(one.q, other.q[:, :n_actions])
    np.testing.assert_array_equal(one.goals, other.goals)
    np.testing.assert_array_equal(one.cuts, other.cuts)


# Random words


def test_the_generator_gives_its_published_words():
    """The first ten and the 102,401st word that other implementations test with."""
    state, words = np.array([1, 2, 3, 4], np.uint32), np.zeros(102_400, np.int64)
    fill(state, words)

    assert words[:10].tolist() == [
        641,
        1573767,
        3222811527,
        3517856514,
        836907274,
        4247214768,
        3867114732,
        1355841295,
        495546011,
        621204420,
    ]
    assert next_word(state) == 0x2C873CFA


def test_a_block_of_words_is_the_words_one_by_one():
    one, other, block = seed_state(5)[0], seed_state(5)[0], np.zeros(9, np.int64)
    fill(one, block)

    assert block.tolist() == [next_word(other) for _ in range(9)]
    assert one.tolist() == other.tolist()


def test_a_seed_can_be_an_int_a_seed_sequence_or_a_generator():
    sequence, generator = np.random.SeedSequence(3), np.random.default_rng(3)

    assert seed_state(3).tolist() == seed_state(sequence).tolist()
    assert seed_state(sequence).tolist() == seed_state(sequence).tolist()
    assert seed_state(generator).tolist() != seed_state(generator).tolist()
    assert len(np.unique([seed_state(i) for i in range(100)])) == 800


@given(st.integers(0, 2**200))
def test_seeds_are_exact_whatever_their_size(seed):
    assert seed_state(seed).tolist() != seed_state(seed + 1).tolist()
    if seed < 2**64:
        assert seed_state(np.uint64(seed)).tolist() == seed_state(seed).tolist()


@pytest.mark.parametrize("wrong", [-1, 1.5, 7.0, np.float64(7), "7", None, True])
def test_a_wrong_seed_is_refused(wrong):
    with pytest.raises(ValueError, match=r"rng must be an int >= 0, .* got"):
        seed_state(wrong)


# Tables


@pytest.mark.parametrize("bits", [16, 32])
def test_bounds_give_each_outcome_its_share_and_the_impossible_nothing(bits):
    rng = np.random.default_rng(bits)
    prob = rng.dirichlet(np.full(6, 0.3), 500) * (rng.random((500, 6)) < 0.7)
    prob = prob[prob.any(axis=1)]
    prob /= prob.sum(axis=1, keepdims=True)
    share = np.diff(integer_bounds(prob, bits), axis=1, prepend=0)

    assert (share >= 0).all()
    assert (share[prob == 0] == 0).all()
    assert (share.sum(axis=1) == 1 << bits).all()
    np.testing.assert_allclose(share / (1 << bits), prob, rtol=0, atol=2.0**-bits)


@pytest.mark.parametrize("n_outcomes", [1, 3, 8])
def test_packed_tables_say_the_same_as_the_mdp(n_outcomes):
    mdp = random_mdp(n_outcomes, n_outcomes=n_outcomes)
    world = make_world(mdp, np.array([0]))
    tables = pack_world(world)
    row = tables.row.reshape(mdp.n_states, 8)
    last, move = np.moveaxis(tables.outcome.reshape(-1, 2, 8), 1, 0)
    words = np.random.default_rng(0).integers(0, 1 << 32, 50)

    for s, a in np.ndindex(mdp.allowed.shape):
        k = (words[:, None] >= world.bound[s, a]).sum(axis=1)
        packed = (words[:, None] - (1 << 31) > last[row[s, a]]).sum(axis=1)
        expected = mdp.next_state[s, a, k]
        np.testing.assert_array_equal(s + move[row[s, a]][packed], expected)


def test_a_building_needs_a_few_rows_for_all_its_tasks():
    """Subsets of the four directions: 15 of the 16 occur in the target map."""
    mdp = navigation_tasks(read_map("target")).mdp
    tables = pack_world(make_world(mdp, np.array([0])))

    assert mdp.n_states == 18_900
    assert tables.outcome.size == 15 * 16
    assert tables.row.dtype == np.uint8


def test_an_mdp_is_packed_once_and_forgotten_with_it():
    mdp = random_mdp(0)
    before = len(_packed)
    one, other = pack(mdp, np.array([0])), pack(mdp, np.array([1]))

    assert one[0].bound is other[0].bound
    assert one[1].start.tolist() == [0]
    assert other[1].start.tolist() == [1]
    del mdp
    assert len(_packed) == before


def test_different_rows_are_numbered_as_they_come():
    rows = np.random.default_rng(0).integers(0, 2, (200, 3))
    found, number = distinct(rows)

    np.testing.assert_array_equal(found[number], rows)
    assert len(np.unique(found, axis=0)) == len(found) == 8


# Eight values at once


def test_eight_at_once_equal_one_by_one():
    from numba import njit

    at_once = njit(lambda q, i, a, x: put(q, i, a, x))
    below = njit(lambda last, i, number: count_below(last, i, number))
    rng = np.random.default_rng(1)
    for _ in range(200):
        q = rng.choice([-np.inf, -0.5, 0.0, 1e-300, 2.0], 24)
        copy, last = q.copy(), np.sort(rng.integers(-(2**31), 2**31, 16)).astype("i4")
        i, a, x = rng.integers(16), rng.integers(8), rng.choice([0.0, 2.0, 3.0])
        number = rng.integers(-(2**31), 2**31)

        assert at_once(q, i, a, x) == put(copy, i, a, x)
        np.testing.assert_array_equal(q, copy)
        assert below(last, i % 9, number) == count_below(last, i % 9, number)


# All loops are one


@pytest.mark.parametrize("phase", PHASES)
@pytest.mark.parametrize("n_outcomes", [1, 5, 8])
@pytest.mark.parametrize("n_actions", [1, 2, 8])
def test_the_fast_loop_equals_the_plain_one(phase, n_actions, n_outcomes):
    """The plain loop runs as long as steps are recorded."""
    mdp = random_mdp(n_actions, 30, n_actions, n_outcomes)
    fast = q_learning_runs(mdp, 3000, rngs=range(3), **options(mdp, phase))
    plain = q_learning_runs(mdp, 3000, rngs=range(3), trace=3000, **options(mdp, phase))

    assert fast[0].goals.sum() + fast[0].cuts.sum() > 50
    for one, other in zip(fast, plain, strict=True):
        assert_same(one, other)


def test_a_zero_has_no_sign_in_rewards_and_first_values():
    """Which of two zeros is the larger, the two loops need not see alike."""
    mdp = random_mdp(8, 30, 8, 5)
    mdp = replace(mdp, reward=-np.zeros(mdp.n_states))
    fast, plain = (
        q_learning_runs(mdp, 3000, rngs=range(3), trace=trace, q0=-0.0)
        for trace in (0, 3000)
    )

    for one, other in zip(fast, plain, strict=True):
        assert one.q.tobytes() == other.q.tobytes()
        assert not np.signbit(one.q[np.isfinite(one.q)]).any()


@pytest.mark.parametrize("phase", PHASES)
def test_both_loops_agree_on_the_target_map(phase):
    tasks = navigation_tasks(read_map("target"), reward="goal")
    guide = np.where(tasks.available, 1.0, 0.0)
    guide[tasks.mdp.terminal] = 1
    guide /= guide.sum(axis=1, keepdims=True)
    options = {"guide": guide, **PHASES[phase], "tau": 40_000} if PHASES[phase] else {}
    fast, plain = (
        q_learning_runs(tasks.mdp, 100_000, rngs=range(3), trace=trace, **options)
        for trace in (0, 100_000)
    )

    assert fast[0].goals.sum() > 0
    for one, other in zip(fast, plain, strict=True):
        assert_same(one, other)


@pytest.mark.parametrize("phase", PHASES)
def test_a_run_does_not_depend_on_its_company(phase):
    mdp = random_mdp(4)
    together = q_learning_runs(mdp, 3000, rngs=range(5), **options(mdp, phase))
    alone = [
        q_learning_runs(mdp, 3000, rngs=[seed], **options(mdp, phase))[0]
        for seed in range(5)
    ]

    assert len({result.q.tobytes() for result in alone}) == 5
    for one, other in zip(together, alone, strict=True):
        assert_same(one, other)


@pytest.mark.parametrize("phase", PHASES)
def test_a_run_does_not_depend_on_how_its_steps_are_divided(phase):
    mdp = random_mdp(5)
    at_once = q_learning_runs(mdp, 3000, rngs=range(3), **options(mdp, phase))
    learner = Learner(mdp, rngs=range(3), trace=100, **options(mdp, phase))
    for n_steps in (1, 50, 0, 649, 600, 1, 699, 1000):
        learner.advance(n_steps)

    for one, other in zip(at_once, learner.results(), strict=True):
        assert_same(one, other)


@pytest.mark.parametrize("phase", PHASES)
def test_a_masked_ninth_action_changes_nothing_but_the_loop(phase):
    """Nine actions do not fit the fast loop; the plain one takes over."""
    small = random_mdp(6)
    wide = MDP(
        np.pad(small.next_state, ((0, 0), (0, 1), (0, 0))),
        np.concatenate([small.prob, small.prob[:, :1]], axis=1),
        small.reward,
        small.terminal,
        small.gamma,
        np.pad(small.allowed, ((0, 0), (0, 1))),
    )
    setting = options(small, phase)
    guide = setting.pop("guide", None)
    fast = q_learning_runs(small, 3000, rngs=[1], guide=guide, **setting)[0]
    if guide is not None:
        guide = np.pad(guide, ((0, 0), (0, 1)))
    plain = q_learning_runs(wide, 3000, rngs=[1], guide=guide, **setting)[0]

    assert pack_world(make_world(wide, np.array([0]))) is None
    assert_same(fast, plain, 8)


def test_many_rows_need_a_larger_type_and_give_the_same():
    """500 states of random outcomes have more than 256 different rows."""
    mdp = random_mdp(7, n_states=500)
    tables = pack_world(make_world(mdp, np.array([0])))
    fast, plain = (
        q_learning_runs(mdp, 3000, rngs=range(3), trace=trace) for trace in (0, 3000)
    )

    assert tables.row.dtype == np.int32
    for one, other in zip(fast, plain, strict=True):
        assert_same(one, other)


LAYOUTS = {
    "as columns": np.asfortranarray,
    "backwards": lambda x: x[::-1].copy()[::-1],
    "every other": lambda x: np.repeat(x, 2, axis=-1)[..., ::2],
    "read-only": lambda x: np.frombuffer(x.tobytes(), x.dtype).reshape(x.shape),
    "other bytes": lambda x: x.astype(x.dtype.newbyteorder()),
    "unaligned": lambda x: np.frombuffer(b"-" + x.tobytes(), x.dtype, offset=1).reshape(
        x.shape
    ),
    "a list": lambda x: x.tolist(),
}


@given(mdps(max_states=9, max_actions=8, masks=True), st.data())
@settings(deadline=None, max_examples=60)
def test_arrays_of_any_layout_give_the_same_run(mdp, data):
    """And none of them is compiled for: what the loops read is always the same."""

    def laid_out(array):
        return LAYOUTS[data.draw(st.sampled_from(sorted(LAYOUTS)))](np.array(array))

    guide, start = random_guide(mdp), np.flatnonzero(~mdp.terminal)
    guide[mdp.terminal] = 1 / mdp.n_actions
    q0 = np.random.default_rng(0).normal(size=mdp.allowed.shape)
    options = {"rngs": [0, 1, 2], "strategy": "soft", "tau": 150, "trace": 50}
    if mdp.terminal.all():
        return
    expected = q_learning_runs(mdp, 200, guide=guide, q0=q0, start=start, **options)
    compiled = [len(f.signatures) for f in (learn, advance_three)]
    names = "next_state", "prob", "reward", "terminal", "allowed"
    other = replace(mdp, **{name: laid_out(getattr(mdp, name)) for name in names})
    guide, q0, start = laid_out(guide), laid_out(q0), laid_out(start)
    found = q_learning_runs(other, 200, guide=guide, q0=q0, start=start, **options)

    assert compiled == [len(f.signatures) for f in (learn, advance_three)]
    for one, same in zip(found, expected, strict=True):
        assert_same(one, same)


DIGEST = """
import hashlib, sys
sys.path[:0] = {tests}
from test_loops import options, q_learning_runs, random_mdp
for phase in {phases}:
    for trace in {traces}:
        setting = options(random_mdp(8), phase)
        runs = q_learning_runs(
            random_mdp(8), 1500, rngs=range({n_runs}), trace=trace, **setting
        )
        for run in runs:
            parts = run.q, run.goals, run.cuts, *run.trace
            print(hashlib.sha256(b"".join(p.tobytes() for p in parts)).hexdigest())
"""


def digest(variables, phases=tuple(PHASES), traces=(0, 1500), n_runs=4):
    """Return what a fresh Python learns, as a line of hex digits for each run."""
    code = DIGEST.format(tests=TESTS, phases=phases, traces=traces, n_runs=n_runs)
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        env={**os.environ, **variables},
        cwd=ROOT,
        capture_output=True,
        encoding="utf-8",
        check=True,
    ).stdout.split()


@pytest.fixture(scope="module")
def compiled():
    """Three runs in turn and one alone, on both loops, in all phases."""
    return digest({})


@pytest.mark.slow
def test_compiled_and_plain_python_agree_to_the_bit(compiled):
    assert len(set(compiled)) == len(compiled) == 24
    assert digest({"NUMBA_DISABLE_JIT": "1"}) == compiled


POISONED = """
import itertools, sys
import numpy as np
sys.path[:0] = {tests}
from test_loops import options, random_mdp
from abstransfer.learning._fast import refresh
from abstransfer.learning._runs import Together, set_up
from abstransfer.learning.settings import Settings
np.seterr(all="ignore")
mdp = random_mdp(3)
setup = set_up(Settings(mdp, **options(mdp, "soft")))
odd = np.nan, np.inf, -np.inf, np.finfo(float).max, np.finfo(float).min
for plainly, values in itertools.product((True, False), itertools.combinations(odd, 2)):
    together = Together(setup, [(rng, setup.settings.q0) for rng in range(3)])
    for run in together.runs:
        run.q[:] = np.random.default_rng(0).choice(values, run.q.shape)
        refresh(mdp.terminal, setup.tables, setup.rule, run.fast)
    (together._plainly if plainly else together._fast)(1, 300)
print("whole")
"""


def test_no_value_makes_a_loop_leave_its_row():
    """Not a number, infinite: plain Python refuses an index that arrays have not."""
    code = POISONED.format(tests=TESTS)
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"},
        cwd=ROOT,
        capture_output=True,
        encoding="utf-8",
    )

    assert (done.stdout, done.stderr) == ("whole\n", "")


@pytest.mark.slow
def test_a_processor_without_wide_registers_gives_the_same_to_the_bit(
    tmp_path, compiled
):
    """And no index leaves its array: all are checked, since it is compiled anew."""
    old = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    old["NUMBA_BOUNDSCHECK"] = "1"
    old["NUMBA_CACHE_DIR"] = str(tmp_path)
    found = digest(old, phases=("soft",), traces=(0,), n_runs=3)

    first = 8 * list(PHASES).index("soft")  # two traces of four runs each
    assert found == compiled[first : first + 3]
