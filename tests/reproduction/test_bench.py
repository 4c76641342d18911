"""The bench: what is tuned, what is chosen, the ladder, and how it is judged."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from abstransfer.experiments.arms import Arm, Scale
from abstransfer.experiments.plan import SEED, STREAMS
from abstransfer.experiments.problem import Problem
from abstransfer.experiments.results import Results, load_results, read_results
from abstransfer.learning import q_learning
from abstransfer.maps import read_map
from abstransfer.reproduction.bench import (
    BEST_OF_PAPER,
    CEILING,
    DRAWN,
    NAMES,
    NEIGHBOURS,
    TARGET,
    TUNING,
    Bench,
    Case,
    Tried,
    all_settings,
    chosen,
    do_case,
    ladder,
    ladder_table,
    run_bench,
)
from abstransfer.reproduction.bench_rules import RULES, judge_bench
from abstransfer.reproduction.hypotheses import predictions
from abstransfer.reproduction.neighbours import METHODS, known

SMALL = Problem(target=read_map("source"))
SHORT = Scale(3000, 1000)


def results(**goals):
    """Results of a bench of one window, by method: lists of goals."""
    arms = tuple(Arm(name.replace("_", "-"), None, "hard", 0) for name in goals)
    record = {
        "parameters": {"arms": [{"name": arm.name, "setting": None} for arm in arms]}
    }
    return Results(arms, np.array(list(goals.values()))[:, :, None], record)


def test_every_method_has_the_same_budget():
    """Six settings to choose among; two controls have nothing to choose."""
    budgets = {method.name: len(method.settings) for method in METHODS}

    assert {name for name, n in budgets.items() if n == 1} == {"none", CEILING}
    assert set(budgets.values()) == {1, 6}
    assert len(all_settings()) == sum(budgets.values())
    assert [bench.folder for bench in NEIGHBOURS] == [TUNING, TARGET, DRAWN]


def test_no_method_but_the_ceiling_asks_the_target_for_more_than_its_views():
    """What is first noted depends on the view, or on nothing; views see what exists."""
    here = known(SMALL)
    for method in METHODS:
        made = method.make(here, method.settings[0], 3000)
        tables = [made.q0] if made.guide is None else [made.q0, made.guide]
        for table in tables:
            if np.ndim(table) and method.name != CEILING:
                of_view = np.zeros((2048, 8))
                of_view[here.rho] = table
                np.testing.assert_array_equal(of_view[here.rho], table)


def test_values_by_view_are_the_mean_and_the_largest_of_the_source():
    """In each view that the source has, and 0 for what cannot be done."""
    here = known(SMALL)
    view = here.rho[0]
    alike = (here.rho == view) & ~here.tasks.mdp.terminal
    for which, combine in (("mean", np.mean), ("max", np.max)):
        expected = np.where(
            here.tasks.available[0], combine(here.ceiling[alike], axis=0), 0
        )
        np.testing.assert_allclose(here.values[which][view], expected, atol=1e-6)


def test_a_library_has_a_policy_for_each_goal_of_the_source():
    here = known(SMALL)

    assert here.library.shape == (11, 2048, 8)
    assert len({policy.tobytes() for policy in here.library}) == 11
    np.testing.assert_allclose(here.library.sum(axis=2), 1)


def test_runs_of_a_case_are_those_of_each_method_alone():
    seed = np.random.SeedSequence(1)
    tried = [Tried(m.name, m.settings[-1]) for m in METHODS[:6]] + [
        Tried("nd-hard", 9_000_000),
        Tried("reuse", 0.9),
    ]
    together, seconds = do_case(Case(SMALL, tuple(tried), SHORT, seed))
    alone = [do_case(Case(SMALL, (one,), SHORT, seed))[0][0] for one in tried]

    np.testing.assert_array_equal(together, alone)
    assert seconds > 0
    tasks = known(SMALL).tasks
    none = q_learning(tasks.mdp, 3000, rng=seed, window=1000)
    np.testing.assert_array_equal(together[0], none.goals)


def test_a_bench_runs_is_tuned_and_resumes(tmp_path):
    """The second reads the first; run again, both are read and nothing is run."""
    tuning = Bench("tuning", 1, "source")
    report = Bench("report", 2, "source", "tuning", curves=True)
    with ThreadPoolExecutor(1) as executor:
        for bench in (tuning, report):
            found = bench.run(tmp_path, scale=SHORT, executor=executor)
    again = report.run(tmp_path, scale=SHORT, executor=None)

    assert [arm.name for arm in found.arms] == [method.name for method in METHODS]
    assert found.goals.shape == (len(METHODS), 2, 3)
    np.testing.assert_array_equal(found.goals, again.goals)
    tried = chosen(load_results(tmp_path / "tuning"))
    kept = {a["name"]: a["setting"] for a in found.record["parameters"]["arms"]}
    assert kept["hint"] == tried["hint"].setting
    assert found.record["parameters"]["stream"] == "report"
    seed = np.random.SeedSequence(SEED, spawn_key=(STREAMS["report"], 1))
    case = Case(report.here(), (tried["library"],), SHORT, seed)
    np.testing.assert_array_equal(found.curves("library")[1], do_case(case)[0][0])


def test_an_unknown_method_is_refused_by_its_name():
    with pytest.raises(ValueError, match="methods among .* got 'magic'"):
        run_bench({"magic": Tried("magic", 1)}, SMALL)


def test_of_the_settings_the_one_of_most_goals_is_chosen():
    arms = tuple(Arm(name, None, "hard", 0) for name in all_settings())
    goals = np.zeros((len(arms), 2, 1))
    names = list(all_settings())
    goals[names.index("nd-hard 5000000")] = [[3], [5]]
    goals[names.index("nd-hard 9000000")] = [[7], [0]]
    best = chosen(Results(arms, goals, {}))

    assert best["nd-hard"] == Tried("nd-hard", 5_000_000)
    assert best["nd-soft"] == Tried("nd-soft", 2_000_000)  # of equals, the first
    assert list(best) == list(NAMES)


def test_the_ladder_is_read_with_a_pencil():
    """Of the ceiling's 100 goals ND misses 60 %; the whisper 20 %, and wins 5 of 5."""
    found = ladder(
        read=lambda _: results(
            none=[30, 30, 30, 30, 30],
            nd_hard=[40, 40, 40, 40, 40],
            whisper=[80, 80, 80, 80, 80],
            ceiling=[100, 100, 100, 100, 100],
        )
    )

    assert [rung.name for rung in found] == ["ceiling", "whisper", "nd-hard", "none"]
    assert [rung.wins for rung in found] == [5, 5, 0, 0]
    assert found[1].shortfall == pytest.approx((0.2, 0.2, 0.2))
    assert found[1].over_nd == pytest.approx((1, 1, 1))
    row = ladder_table(found)[2]
    assert row["method"] == BEST_OF_PAPER
    assert row["source"] == "Torrey & Taylor 2013"
    assert row["short of the ceiling, %"] == "60.0 [60.0, 60.0]"


def test_every_hypothesis_of_the_bench_has_its_row():
    assert set(RULES) == {key for key in predictions() if key[0] == "R"}


def test_an_unknown_hypothesis_is_refused():
    with pytest.raises(ValueError, match="keys must be among R1, .* got 'R99'"):
        judge_bench(["R99"])


def test_a_hypothesis_holds_where_the_whole_interval_lies_on_its_side():
    ways = {
        (50, 51, 52, 53, 54): "holds",
        (10, 11, 12, 13, 14): "refuted",
        (10, 60, 10, 60, 60): "undecided",
    }
    for goals, verdict in ways.items():
        found = results(heuristic=goals, nd_hard=(30, 30, 30, 30, 30))
        assert judge_bench(["R5"], lambda _, r=found: r)["R5"].verdict == verdict


def test_no_hypothesis_is_left_without_a_verdict():
    judged = judge_bench(read=read_results)

    assert judged.keys() == RULES.keys()
    assert [len(judged[key].parts) for key in ("R1", "R2", "R8")] == [3, 22, 7]
