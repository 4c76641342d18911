"""The built reference of the package says what every field of a record is."""

import pytest


def test_no_field_is_only_an_alias(html):
    pages = {path.name: path.read_text("utf-8") for path in html.glob("api*.html")}
    silent = [name for name, text in pages.items() if "Alias for field number" in text]

    assert len(pages) == 11
    assert silent == []


@pytest.mark.parametrize("name", ["api_core", "api_builders", "api_learning"])
def test_the_core_is_in_the_reference(html, name):
    assert "Parameters" in (html / f"{name}.html").read_text("utf-8")
