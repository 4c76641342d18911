"""The cards of a class are one test of a claim, each building once."""

import pytest
from nbformat import write
from nbformat.v4 import new_code_cell, new_notebook, new_output

from abstransfer import parse_map
from abstransfer.classroom import pooling
from abstransfer.classroom.pooling import pool
from abstransfer.cli import main
from abstransfer.experiments.stats import t_interval
from abstransfer.project.card import card_text
from abstransfer.project.setup import Setup, run

SMALL = parse_map("+---+---+\n|. .d*  |\n+---+---+")
OTHER = parse_map("+---+\n|.d*|\n+---+")


@pytest.fixture(autouse=True)
def one_building(monkeypatch):
    monkeypatch.setattr(pooling, "building_of", lambda student: SMALL)


def card(student, map_=SMALL):
    setup = Setup(map_, guides=("eager", "rand"), runs=1, student=student)
    return card_text(setup, run(setup).goals)


def test_cards_in_texts_and_notebooks_are_run_again_and_pooled(tmp_path):
    names = ["Ann", "Bob", "Cy", "Di", "Eve"]
    texts = [card(name) for name in names]
    (tmp_path / "mail.txt").write_text(
        "".join(texts[:3]).replace("\n", "\r\n"), "utf-8"
    )
    (tmp_path / "di.md").write_text(
        "".join(f"> {x}\n" for x in texts[3].splitlines()), encoding="utf-8"
    )
    cell = new_code_cell("print(card)", outputs=[new_output("stream", text=texts[4])])
    write(new_notebook(cells=[cell]), tmp_path / "eve.ipynb")

    found = pool(tmp_path, "rand", "eager")

    assert set(found.gains) == set(names)
    assert found.left_out == {}
    rows = [text.split("| eager | ")[1].split(" | ")[1] for text in texts]
    others = [text.split("| rand | ")[1].split(" | ")[1] for text in texts]
    gains = [int(b) / int(a) - 1 for a, b in zip(rows, others, strict=True)]
    assert sorted(found.gains.values()) == pytest.approx(sorted(gains))
    assert found.interval == pytest.approx(t_interval(list(found.gains.values())))


@pytest.mark.parametrize(
    ("margin", "verdict"), [(-0.99, "holds"), (9.0, "does not hold")]
)
def test_a_verdict_comes_from_the_interval(tmp_path, margin, verdict):
    for name in ("Ann", "Bob", "Cy", "Di", "Eve"):
        (tmp_path / f"{name}.md").write_text(card(name), encoding="utf-8")

    assert pool(tmp_path, "rand", "eager", margin=margin).verdict == verdict


def test_a_card_that_does_not_count_is_left_out_with_a_word(tmp_path):
    good = card("Ann")
    (tmp_path / "a.md").write_text(good, encoding="utf-8")
    (tmp_path / "b.md").write_text(good.replace("Seed: ", "Seed: 1"), encoding="utf-8")
    (tmp_path / "c.md").write_text(card("Cy", OTHER), encoding="utf-8")
    (tmp_path / "d.md").write_text(card(""), encoding="utf-8")
    (tmp_path / "e.md").write_text(card("ANN"), encoding="utf-8")

    found = pool(tmp_path, "rand", "eager")

    assert set(found.gains) == {"Ann"}
    assert found.verdict == "undecided"
    assert found.left_out["b.md"].startswith("line 11: the card says '- Seed: 1")
    assert found.left_out["Cy"] == "the building is not the student's own"
    assert found.left_out["d.md"] == "the card names no student"
    assert found.left_out["ANN"] == "a second card of this student"


def test_a_file_without_a_card_is_told_wherever_it_lies(tmp_path):
    for folder in ("ann", "bob", "cy", ".ipynb_checkpoints"):
        (tmp_path / folder).mkdir()
    (tmp_path / "ann" / "card.md").write_text(card("Ann"), encoding="utf-8")
    (tmp_path / "bob" / "card.md").write_text("My dog ate it.", encoding="utf-8")
    (tmp_path / "cy" / "card.md").write_text(card(""), encoding="utf-8")
    (tmp_path / "cy" / "card.pdf").write_bytes(b"%PDF-1.7")
    (tmp_path / ".ipynb_checkpoints" / "a.ipynb").write_text("{}", encoding="utf-8")

    assert pool(tmp_path, "rand", "eager").left_out == {
        "bob/card.md": "it holds no card",
        "cy/card.md": "the card names no student",
        "cy/card.pdf": "cards are read from .ipynb, .md, .txt, .eml only",
    }


def test_a_robot_that_no_card_has_is_named(tmp_path):
    (tmp_path / "a.md").write_text(card("Ann"), encoding="utf-8")
    told = []

    with pytest.raises(ValueError, match="holds no card that counts"):
        pool(tmp_path, "nd", tell=told.append)
    assert told == ["Ann: left out, the card has no robot 'nd'"]


def test_the_command_says_the_verdict_and_draws_the_buildings(tmp_path, capsys):
    for name in ("Ann", "Bob", "Cy", "Di", "Eve"):
        (tmp_path / f"{name}.md").write_text(card(name), encoding="utf-8")
    (tmp_path / "fay.txt").write_text("I have none.", encoding="utf-8")
    wall = tmp_path / "wall.svg"

    code = main(
        ["class", "pool", str(tmp_path), "--robot", "rand", "--over", "eager"]
        + ["--margin", "-0.99", "--figure", str(wall)]
    )

    said = capsys.readouterr().out
    assert code == 0
    assert "The claim that rand gains more than -99 % over eager: holds." in said
    assert "Goals of rand over eager in 5 buildings: mean " in said
    assert "Left out, as said above: fay.txt.\n" in said
    shown = wall.read_text("utf-8")
    assert shown.startswith("<svg role=")
    for words in ("line: mean ", "band: its 95 % interval, ", "of 5 above 0"):
        assert words in shown
    assert "goals of wanderer over eager, in %" in shown
