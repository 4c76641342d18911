"""Controls and readings as the pages show them."""

import numpy as np
import pytest

from abstransfer.experiments.results import read_results
from abstransfer.reproduction.controls import TOLD, controls_table
from abstransfer.reproduction.evidence import READINGS, evidence_table
from abstransfer.reproduction.readings import judge_reading


def test_every_building_has_its_controls_with_intervals():
    rows = controls_table()
    none = read_results("goal-target_b").totals("none")[:10]
    hint = read_results("controls-target_b").totals("hint")

    assert [row["building"][-1] for row in rows] == ["t", "b", "c", "d"]
    for row in rows:
        for name in TOLD:
            assert "nan" not in row[name]
    mean, gain = rows[1]["hint"].split(": ")
    assert mean == f"{hint.mean() / 1000:.0f}"
    assert float(gain.split()[0]) == pytest.approx(
        100 * (hint.mean() / none.mean() - 1), abs=0.51
    )


def test_a_reading_whose_results_are_not_stored_was_not_run():
    def read(folder):
        if folder.startswith("masked") or folder.endswith("b-tuned"):
            raise FileNotFoundError(folder)
        return read_results(folder)

    rows = {row["the learner"]: row for row in evidence_table(read)}
    masked, compass = rows["labels, masked"], rows["compass"]

    assert masked["the paper's tau is among the best"] == "not run"
    assert masked["claims that hold, own tau"] == "not run"
    assert compass["claims that hold, own tau"].endswith("in all four: not run")
    assert len(rows) == len(READINGS)


def test_the_evidence_names_the_claims_that_hold():
    rows = {row["the learner"]: row for row in evidence_table()}
    told = rows["labels, waits"]["claims that hold, paper's tau"]

    for where, text in (("target", told.split(";")[0]), ("target_b", told)):
        entries = judge_reading(read_results(f"goal-{where}"))
        held = [e.claim.key for e in entries if e.verdict == "holds"]
        assert text.split(": ")[-1] == ", ".join(held)
    assert np.isclose(rows["labels, waits"]["of 10 numbers of Table 1, within 2 %"], 9)
