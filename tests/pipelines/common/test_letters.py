"""Japanese names in pictures: from an installed font that has their letters, or a warning that none has."""

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from hakobune.pipelines.common import picture


@pytest.fixture
def figure():
    made = Figure()
    FigureCanvasAgg(made)
    axes = made.add_subplot()
    axes.set(xlabel="offset, m", title="浮体 A, ½ ρg")
    return made


@pytest.mark.filterwarnings("ignore:Glyph")
def test_a_name_that_no_font_can_write_is_told_of(figure, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(picture, "font_with", lambda letters: None)
    picture.save(figure, tmp_path / "picture.png", 50)
    assert "no installed font has the letters of '浮体 A, ½ ρg'" in capsys.readouterr().err


@pytest.mark.filterwarnings("ignore:Glyph")
def test_a_font_with_the_letters_stands_behind_that_of_the_text(figure, tmp_path, monkeypatch, capsys):
    asked = []
    serif = picture.font_with("½")
    monkeypatch.setattr(picture, "font_with", lambda letters: asked.append(letters) or serif)
    picture.save(figure, tmp_path / "picture.png", 50)
    (axes,) = figure.axes
    assert asked == [set("浮体")] and axes.title.get_fontfamily()[-1] == serif.name
    assert axes.xaxis.label.get_fontfamily() != axes.title.get_fontfamily() and not capsys.readouterr().err


def test_a_letter_of_no_font_is_found_in_none():
    assert picture.font_with({"\U000e0ffe"}) is None
