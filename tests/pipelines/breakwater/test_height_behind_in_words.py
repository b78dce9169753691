"""The height behind a breakwater in one line, by hand."""

from types import SimpleNamespace

from hakobune.pipelines.breakwater.quantities import behind_in_words


def test_the_height_behind_is_told_in_metres_and_of_the_height_before():
    """0.42 m of 1.2 m are 35 %"""
    sea = SimpleNamespace(cells=SimpleNamespace(height=1.2), heights={"fixed": 0.42, "taut": 0.6})
    assert list(behind_in_words(sea)) == ["of a sea of 1.2 m passes: fixed 0.42 m (35 %); taut 0.6 m (50 %)"]
    for asked, told in ((1.2001, ""), (1.2013, " (4√m₀ of 1.2013 m by the constants of its spectrum)")):
        assert next(behind_in_words(sea, asked)).startswith(f"of a sea of 1.2 m{told} passes: fixed")
    assert not list(behind_in_words(None))
    assert not list(behind_in_words(SimpleNamespace(cells=sea.cells, heights={})))
