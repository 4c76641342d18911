"""Figures: legible, described from their data, and the same bytes every time."""

import subprocess
import sys

import pytest

from abstransfer.maps import read_map
from abstransfer.plotting import figure, plot_map


def test_importing_the_package_leaves_matplotlib_alone():
    code = "import sys, abstransfer; sys.exit('matplotlib' in sys.modules)"

    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_a_picture_is_an_svg_with_its_alt_text_twice():
    picture = figure(plot_map, read_map("source"))
    data, metadata = picture._repr_mimebundle_()

    assert data["text/plain"] == picture.alt == repr(picture)
    assert data["image/svg+xml"].count(picture.alt) == 2
    assert metadata == {"image/svg+xml": {"alt": picture.alt}}


def test_a_figure_without_a_description_is_refused():
    with pytest.raises(ValueError, match="alt must be given"):
        figure(lambda ax: ax.plot([0, 1]))
