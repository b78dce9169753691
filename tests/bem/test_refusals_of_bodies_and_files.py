"""What bodies, limits of the frequency and rows of files may be, from both sides of each limit."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.bodies.one_of_several import OneOfSeveral, body_named
from hakobune.bem.formats.values import FormatError, gridded, table_of
from hakobune.bem.modes import Body
from hakobune.bem.panels.frequency_limits import given_at_limit
from hakobune.bem.sections.outline import OutlineError, _one_chain
from hakobune.bem.viscous import yamashita_roll
from hakobune.meshing.panels import assembled
from hakobune.meshing.shapes import box


@pytest.mark.parametrize("ratio, taken", [(4.99, False), (5.0, True), (10.0, True), (10.01, False)])
def test_roll_of_a_box_is_damped_by_yamashita_between_the_proportions_of_his_tests(ratio, taken):
    """B/d of 5 to 10, both included"""
    if taken:
        assert yamashita_roll(100.0, 10.0 * ratio, 10.0, 1025.0).drag > 0
    else:
        with pytest.raises(ValueError) as refused:
            yamashita_roll(100.0, 10.0 * ratio, 10.0, 1025.0)
        assert f"B/d = {ratio:.4g} is outside the range of Yamashita's roll damping (5 to 10); give b_R" in str(
            refused.value
        )


def test_limits_of_the_frequency_are_zero_and_infinity():
    with pytest.raises(ValueError, match="limit is 'nought'; allowed: 'zero', 'infinity'"):
        given_at_limit(SimpleNamespace(), "nought")


def test_a_body_that_is_not_there_is_told_with_those_that_are():
    one = SimpleNamespace(path="a.h5", bodies=[], modes=[])
    with pytest.raises(ValueError, match=r"a\.h5 has no body 'float'; allowed: one body without a name"):
        body_named(one, "float")


def part(*z):
    return SimpleNamespace(at=lambda u, z=z: 1j * (z[0] * (1 - u) + z[1] * u))


@pytest.mark.parametrize("heights, pieces", [([(1, 1)] * 3, 0), ([(-1, -1), (1, 1), (-2, -2), (2, 2)], 2)])
def test_the_water_leaves_one_piece_of_a_section(heights, pieces):
    """Edges whose middle is below z = 0 follow each other once round"""
    with pytest.raises(OutlineError, match=f"at draft 2 m the water cuts the section into {pieces} pieces; allowed: 1"):
        _one_chain([part(*one) for one in heights], 2.0)


def test_rows_of_a_file_are_numbers_below_a_heading(tmp_path):
    """Two or three a row; what a row lacks is not known"""
    path = tmp_path / "a.1"

    def read(text):
        path.write_text(text)
        return table_of(path, (2, 3))

    assert np.array_equal(read("a heading\n1 2 3\n4 5\n"), [[1, 2, 3], [4, 5, np.nan]], equal_nan=True)
    for text, says in (
        ("a heading\n", "has no numbers"), ("1 2 3\nthe end\n", "line 2: 'the end' contains something that is not a "
            "number"),
        ("1 2 3\n1 2 3 4\n", "line 2 has 4 numbers; allowed: 2 or 3"), ("1\n", "line 1 has 1 numbers; allowed: 2 or 3"),
    ):  # fmt: skip
        with pytest.raises(FormatError) as refused:
            read(text)
        assert says in str(refused.value)


def test_modes_of_a_file_are_those_of_one_rigid_body_and_what_is_left_out_is_nothing():
    """Two frequencies, modes 1 and 3 of six"""
    omega, mode, values = [0.5, 0.5, 0.8, 0.8], [1, 3, 1, 3], np.arange(1.0, 5.0)
    (w, i), grid = gridded("a.1", [omega, mode], values, [range(1, 7)])
    assert w.tolist() == [0.5, 0.8] and list(i) == [1, 2, 3, 4, 5, 6]
    assert grid.tolist() == [[1.0, 0.0, 2.0, 0.0, 0.0, 0.0], [3.0, 0.0, 4.0, 0.0, 0.0, 0.0]]
    with pytest.raises(FormatError, match=r"a\.1 has mode 7; allowed for one rigid body: 1, 2, 3, 4, 5, 6"):
        gridded("a.1", [omega, [1, 3, 1, 7]], values, [range(1, 7)])
    with pytest.raises(FormatError):
        gridded("a.1", [omega, [1, 1, 1, 3]], values, [range(1, 7)])  # a place twice


def test_the_one_body_of_a_database_that_bends_has_the_whole_mesh_no_name_and_is_not_fixed():
    """Of several each has its own part of it, under its own name"""
    hull = box(10.0, 4.0, 2.0, panels=20)
    one = OneOfSeveral(SimpleNamespace(bodies=(), mesh=hull, modes=("first",), path=Path("x/one.h5")), 0)
    assert one.mesh is hull and (one.name, one.fixed, one.reader) == ("", False, None)
    whole = assembled([box(10.0, 4.0, 2.0, panels=20).whole(), box(8.0, 4.0, 1.0, panels=20).whole().moved(dx=30.0)])
    bodies = (Body("a", (0.0, 0.0, 0.0)), Body("b", (30.0, 0.0, 0.0), fixed=True))
    two = [OneOfSeveral(SimpleNamespace(bodies=bodies, mesh=whole, path=Path("x/two.h5")), i) for i in range(2)]
    assert [(each.name, each.fixed, each.mesh.name) for each in two] == [
        ("a", False, "a of two"), ("b", True, "b of two"),
    ]  # fmt: skip
    assert [np.ptp(each.mesh.points[:, 0]) for each in two] == pytest.approx([10.0, 8.0])
