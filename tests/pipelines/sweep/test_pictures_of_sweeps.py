"""Pictures of sweeps: quantities over the first key, a line for each value of the others, in their print units."""

import numpy as np
import pytest

from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.results.result import Result, labels
from hakobune.pipelines.sweep.picture import draw


def result(first=(3.0, 1.0, 2.0, 1.0), **more):
    """Cases out of order: depth 3, 1, 2, 1 m and chain, chain, chain, wire"""
    own = {
        "keys.water.depth": Quantity(np.array(first), ("case",), "", "depth", "cases"),
        "keys.lines.type": Quantity(np.array(["chain", "chain", "chain", "wire"]), ("case",), "", "type", "cases"),
        "status": Quantity(np.zeros(4), ("case",), "", "status"),
        "tension.largest": Quantity(np.array([3e6, 1e6, 2e6, 5e5]), ("case",), "N", "largest tension", "cases"),
        "used": Quantity(np.array([0.3, 0.1, 0.2, 0.05]), ("case",), "", "used", "cases", share=True),
        "offset": Quantity(np.array([6.0, 4.0, 5.0, 9.0]), ("case",), "m", "offset", "cases"),
        "in_files_alone": Quantity(np.ones(4), ("case",), "m", "unseen"),
        "each": Quantity(np.ones((4, 2)), ("case", "line"), "N", "of each", "cases"),
    }  # fmt: skip
    return Result("sweep", own | more, labels("case", np.arange(4)) | labels("line", ["a", "b"]))


def test_quantities_are_drawn_over_the_first_key_in_its_order_a_line_for_each_other(pictures, tmp_path):
    draw(result(), tmp_path / "p.png")
    tension, used, offset = pictures[0].axes
    assert [one.get_ylabel() for one in pictures[0].axes] == ["largest tension, kN", "used, %", "offset, m"]
    assert {one.get_xlabel() for one in pictures[0].axes} == {"water.depth"}
    for axes, chain, wire in ((tension, [1e3, 2e3, 3e3], 500.0), (used, [10, 20, 30], 5.0), (offset, [4, 5, 6], 9.0)):
        one, other = axes.lines
        assert one.get_xydata() == pytest.approx(np.stack([[1.0, 2.0, 3.0], chain], axis=1))
        assert other.get_xydata() == pytest.approx(np.array([[1.0, wire]]))
    assert [text.get_text() for text in tension.get_legend().get_texts()] == ["lines.type chain", "lines.type wire"]
    assert used.get_legend() is None and pictures[0].get_size_inches() == pytest.approx([11.0, 6.8])


def test_a_sweep_of_one_key_has_one_line_and_no_legend(pictures, tmp_path):
    made = result()
    alone = {name: one for name, one in made.quantities.items() if name not in ("keys.lines.type", "used", "offset")}
    draw(Result("sweep", alone, made.labels), tmp_path / "p.png")
    (axes,) = pictures[0].axes
    assert len(axes.lines) == 1 and axes.get_legend() is None
    assert axes.lines[0].get_xdata().tolist() == [1.0, 1.0, 2.0, 3.0]


def test_twelve_quantities_are_drawn_at_most(pictures, tmp_path):
    more = {f"more{i}": Quantity(np.ones(4), ("case",), "m", f"more {i}", "cases") for i in range(12)}
    draw(result(**more), tmp_path / "p.png")
    axes = pictures[0].axes
    assert len(axes) == 12 and axes[-1].get_ylabel() == "more 8, m"
    assert axes[0].get_subplotspec().get_gridspec().get_geometry() == (6, 2)


def test_a_sweep_that_prints_nothing_has_an_empty_picture(pictures, tmp_path):
    made = result()
    keys = {name: one for name, one in made.quantities.items() if name.startswith("keys.") or name == "status"}
    draw(Result("sweep", keys, made.labels), tmp_path / "p.png")
    assert pictures[0].axes == []


def test_a_first_key_of_words_has_no_axis(tmp_path):
    with pytest.raises(ValueError, match=r"keys\.water\.depth has no numeric values .* put a numeric key first"):
        draw(result(("a", "b", "c", "d")), tmp_path / "p.png")
