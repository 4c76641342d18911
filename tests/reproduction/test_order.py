"""Hypotheses before results: the project's history says so, and the files agree."""

import shutil
import subprocess

import pytest
from support import ROOT

from abstransfer.experiments.results import stored_results
from abstransfer.reproduction import bench_rules, blind_rules
from abstransfer.reproduction.bench import NEIGHBOURS
from abstransfer.reproduction.catalogue import EXPERIMENTS, STUDIES
from abstransfer.reproduction.hypotheses import RULES, judge_hypotheses, predictions

SECOND = [
    one.folder
    for one in EXPERIMENTS
    if one.folder.startswith(
        ("controls", "compass", "masked", "traps", "operations", "drawn", "study-own")
    )
]
BENCH = [one.folder for one in NEIGHBOURS if one.folder in stored_results()]
BLIND = [
    one.folder
    for experiments in STUDIES.values()
    for one in experiments
    if one.folder in stored_results() and one not in NEIGHBOURS
]


def git(*arguments):
    """What git prints, by line."""
    said = subprocess.run(
        ["git", *arguments], cwd=ROOT, capture_output=True, encoding="utf-8", check=True
    )
    return said.stdout.split()


@pytest.fixture(scope="module")
def history():
    """Commits of the text; skipped in a copy that has no history, or not all."""
    if not (ROOT / ".git").exists() or not shutil.which("git"):
        pytest.skip("no history here")
    if git("rev-parse", "--is-shallow-repository") == ["true"]:
        pytest.skip("a copy without its whole history")
    return lambda path: git("log", "--format=%H", "--reverse", "--", f"data/{path}")


@pytest.mark.parametrize(
    ("folder", "text"),
    [
        *((folder, "hypotheses.md") for folder in SECOND),
        *((folder, "hypotheses-bench.md") for folder in BENCH),
        *((folder, "hypotheses-blind.md") for folder in BLIND),
    ],
)
def test_the_hypotheses_were_last_changed_before_the_results_came(
    history, folder, text
):
    came = history(f"results/{folder}")[0]

    for commit in history(text):
        subprocess.run(
            ["git", "merge-base", "--is-ancestor", commit, came], cwd=ROOT, check=True
        )
        assert commit != came


def test_every_hypothesis_has_its_row_and_is_judged():
    said, judged = predictions(), judge_hypotheses()

    assert judged.keys() == RULES.keys()
    assert said.keys() == {*RULES, *bench_rules.RULES, *blind_rules.RULES}
    assert all(found.parts for found in judged.values())
