"""What small pictures of commands show: the numbers of their curves in the units of their axes, and who is who."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.colors import to_hex

import hakobune
from hakobune.pipelines.berth import command as berth
from hakobune.pipelines.common.fender_tables import FenderTable
from hakobune.pipelines.damping import command as damping
from hakobune.pipelines.fender import command as fender
from hakobune.pipelines.lines import line_command
from hakobune.pipelines.lines.line_result import line
from hakobune.pipelines.members import command as members
from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.results.result import Result, labels
from hakobune.pipelines.single_point import maps


def drawn(axes):
    """{label: (n, 2) points} of the lines of a panel"""
    return {line.get_label(): line.get_xydata() for line in axes.lines}


def told(axes):
    return axes.get_xlabel(), axes.get_ylabel(), axes.get_title()


def listed(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_a_berthing_is_drawn_fender_by_fender_with_its_energies(pictures, tmp_path):
    """Newtons as kN and joules as kJ; the energy of the kinetic-energy method is a level"""
    time = np.array([0.0, 1.0, 2.0])
    course = SimpleNamespace(
        time=time, reaction=np.array([[0, 0], [2e3, 5e3], [3e3, 1e3]]), virtual_mass=1.6251,
        deflection=np.array([[0, 0], [0.1, 0.3], [0.2, 0.15]]), taken=np.array([0, 4e3, 6e3]),
        lost=np.array([0, 1e2, 3e2]),
    )  # fmt: skip
    meetings = [(SimpleNamespace(name="cone"), 12.5, 0.0), (SimpleNamespace(name="v"), -20.0, 0.1)]
    made = SimpleNamespace(detail=(SimpleNamespace(meetings=meetings, energy=7e3), course))
    berth._draw(made, tmp_path / "b.png")
    (figure,) = pictures
    force, deep, energy = figure.axes
    names = ["cone, x = 12.5 m", "v, x = -20 m"]
    for axes, values in ((force, [[0, 2, 3], [0, 5, 1]]), (deep, [[0, 0.1, 0.2], [0, 0.3, 0.15]])):
        shown = drawn(axes)
        assert list(shown) == names
        for name, y in zip(names, values, strict=True):
            assert shown[name] == pytest.approx(np.column_stack([time, y]), rel=1e-12)
    shown = drawn(energy)
    assert shown["stored and dissipated in fenders"] == pytest.approx(np.column_stack([time, [0, 4, 6]]), rel=1e-12)
    assert shown["in waves"] == pytest.approx(np.column_stack([time, [0, 0.1, 0.3]]), rel=1e-12)
    assert shown["kinetic-energy method"][:, 1] == pytest.approx([7, 7], rel=1e-12) and len(shown) == 3
    assert told(force) == ("", "reaction, kN", "C_M 1.625") and told(deep)[1] == "deflection, m"
    assert told(energy) == ("time from contact, s", "energy, kJ", "")
    assert listed(force) == names and listed(energy) == list(shown)
    force.set_xlim(0.5, 1.0)
    assert energy.get_xlim() == deep.get_xlim() == (0.5, 1.0)  # one axis of time
    assert tuple(figure.get_size_inches()) == (8, 8)


@pytest.mark.parametrize("tilted", [False, True])
def test_a_fender_is_drawn_between_softest_and_stiffest_with_its_energy_on_the_right(pictures, tmp_path, tilted):
    """The energy is the area under the reaction; a marker stands where the energy that was asked for is taken"""
    more = {"angle_deg": 6.0, "width": 2.4} if tilted else {}
    result = hakobune.fender(FenderTable(family="cell", height=2.0, **more), energy=4e5)
    fender._draw(result, tmp_path / "f.png")
    (figure,) = pictures
    left, right = figure.axes
    curves, energies = drawn(left), drawn(right)
    x, load = curves["loading"].T
    assert x[0] == 0 and len(x) == 400 and x[-1] == pytest.approx(result.detail.pair.limit)
    at, own = result.labels["deflection"].values, result["curve.reaction"] / 1e3
    assert np.interp(at, x, load) == pytest.approx(own, abs=1e-3 * own.max())
    area = np.concatenate([[0], np.cumsum(0.5 * (load[1:] + load[:-1]) * np.diff(x))])
    assert energies["energy"][:, 1] == pytest.approx(area, abs=1e-3 * area[-1])
    assert np.all(curves["unloading"][1:-1, 1] <= load[1:-1] + 1e-9) and curves["unloading"][200, 1] < load[200]
    (band,) = left.collections
    inside = band.get_paths()[0].vertices
    low, high = (by for by in result["factor"][1:])
    assert inside[:, 1].max() == pytest.approx(high * load.max(), rel=1e-6) and low < 1 < high
    middle = inside[np.isclose(inside[:, 0], x[150]), 1]
    assert sorted(set(middle.round(6))) == pytest.approx([low * load[150], high * load[150]], rel=1e-3)
    place = float(np.interp(400.0, energies["energy"][:, 1], x))
    (spot,) = [line for line in left.lines if line.get_marker() == "o"]
    (same,) = [line for line in right.lines if line.get_marker() == "o"]
    assert spot.get_xydata()[0] == pytest.approx([place, np.interp(place, x, load)], rel=1e-3)
    assert same.get_xydata()[0] == pytest.approx([place, 400.0], rel=1e-3)
    (rated,) = [line for line in left.lines if line.get_color() == "grey"]
    assert rated.get_xdata() == pytest.approx([result.detail.pair.rated * 2.0] * 2)
    (word,) = left.texts
    assert word.get_text() == "rated" and word.xy == pytest.approx((rated.get_xdata()[0], 0))
    assert ("loading, not inclined" in curves) == tilted == ("energy, not inclined" in energies)
    names = ["softest to stiffest", "loading", "unloading", *["loading, not inclined"] * tilted]
    assert listed(left) == [*names, "energy", *["energy, not inclined"] * tilted]
    if tilted:
        upright = hakobune.fender(FenderTable(family="cell", height=2.0))
        straight, taken = curves["loading, not inclined"][:, 1], energies["energy, not inclined"][:, 1]
        assert straight.max() == pytest.approx(upright["curve.reaction"].max() / 1e3, rel=1e-2)
        area = np.concatenate([[0], np.cumsum(0.5 * (straight[1:] + straight[:-1]) * np.diff(x))])
        assert taken == pytest.approx(area, abs=1e-3 * area[-1])
    assert told(left) == ("deflection, m", "reaction, kN", result.detail.pair.name)
    assert right.get_ylabel() == "energy, kJ"
    assert left.get_xlim()[0] == left.get_ylim()[0] == right.get_ylim()[0] == 0
    assert tuple(figure.get_size_inches()) == (8, 5)


@pytest.mark.parametrize(("what", "unit", "size", "axis"), [("force", "N", 1e3, "kN"), ("motion", "m", 1.0, "m")])
def test_a_record_of_damping_is_drawn_with_the_curve_fitted_to_it(pictures, tmp_path, what, unit, size, axis):
    time, record, fitted = np.array([0.0, 0.5, 1.0]), np.array([0.0, 2e3, -1e3]), np.array([10.0, 1.9e3, -0.9e3])
    made = {
        f"record.{what}": Quantity(record, ("time",), unit, "force on the body" if what == "force" else "sway"),
        f"fitted.{what}": Quantity(fitted, ("time",), unit),
    }
    damping._draw(Result("damping", made, labels("time", time, "s")), tmp_path / "d.png")
    (axes,) = pictures[0].axes
    shown = drawn(axes)
    assert shown["record"] == pytest.approx(np.column_stack([time, record / size]), rel=1e-12)
    assert shown["fitted"] == pytest.approx(np.column_stack([time, fitted / size]), rel=1e-12)
    assert told(axes)[:2] == ("time, s", f"{'force on the body' if what == 'force' else 'sway'}, {axis}")
    assert listed(axes) == ["record", "fitted"] and axes.lines[0].get_linestyle() == "None"
    assert tuple(pictures[0].get_size_inches()) == (9, 4.5)


def test_members_are_drawn_over_the_phase_without_those_in_the_wind(pictures, tmp_path):
    """The length of each force (3-4-5 and 5-12-13); piles of the same force are told apart by dashes"""
    from hakobune.pipelines.members.result import ALL, IN_WATER

    names = ["pile 1", "pile 2", "mast, wind", IN_WATER, ALL]
    force = np.zeros((2, 5, 3))
    force[0, :, :2] = [3e3, 4e3]
    force[1, 0], force[1, 1], force[1, 3], force[1, 4] = [5e3, 0, 12e3], [0, 8e3, 6e3], [0, 0, 7e3], [2e3, 3e3, 6e3]
    axes = labels("phase", np.radians([0.0, 90.0]), "rad") | labels("member", names)
    made = Result("members", {"course.force": Quantity(force, ("phase", "member", "axis"), "N")},
                  axes | labels("axis", ["x", "y", "z"]))  # fmt: skip
    members._draw(made, tmp_path / "m.png")
    (axes,) = pictures[0].axes
    shown = drawn(axes)
    of = {"pile 1": [5, 13], "pile 2": [5, 10], IN_WATER: [5, 7], ALL: [5, 7]}
    assert list(shown) == list(of) == listed(axes)
    for name, size in of.items():
        assert shown[name] == pytest.approx(np.column_stack([[0, 90], size]), rel=1e-12)
    first, second, water, whole = axes.lines
    assert first.get_linestyle() == "-" and second.is_dashed()
    assert (to_hex(water.get_color()), to_hex(whole.get_color())) == ("#808080", "#000000")
    assert water.get_linewidth() == whole.get_linewidth() == 2
    assert told(axes)[:2] == ("phase, °; 0: crest at the origin", "force, kN")
    assert axes.get_xlim() == (0, 360) and axes.get_ylim()[0] == 0 and list(axes.get_xticks()) == [*range(0, 361, 45)]
    assert tuple(pictures[0].get_size_inches()) == (8, 5)


@pytest.mark.parametrize("height", [20.0, 60.0])
def test_a_line_is_drawn_from_its_anchor_to_its_fairlead_with_its_tension_over_the_span(pictures, tmp_path, height):
    result = line(length=300.0, depth=height, weight=800.0, stiffness=1e8, span=285.0)
    line_command.draw(result, tmp_path / "l.png")
    one, span, found = result.detail
    left, right = pictures[0].axes
    shape, bed = left.lines[:2]
    places = shape.get_xydata()
    assert len(places) == 400 and places[0] == pytest.approx([0, 0], abs=1e-9)
    assert places[-1] == pytest.approx([span, height], rel=1e-6)
    assert bed.get_xydata() == pytest.approx(np.array([[0, 0], [1.02 * span, 0]]), abs=1e-9)
    anchor, fairlead = left.lines[-2:]
    assert list(anchor.get_xydata()[0]) == [0, 0] and anchor.get_marker() == "^"
    assert list(fairlead.get_xydata()[0]) == [span, height] and fairlead.get_marker() == "o"
    assert left.get_aspect() == ("auto" if height < 0.1 * span else 1.0)
    shown = drawn(right)
    level, along = shown["horizontal at the fairlead"], shown["tension at the fairlead"]
    assert np.interp(span, *along.T) == pytest.approx(found.tension_fairlead / 1e3, rel=0.02)
    assert np.interp(span, *level.T) == pytest.approx(found.horizontal_fairlead / 1e3, rel=0.02)
    assert np.all(along[:, 1] >= level[:, 1] - 1e-9) and listed(right) == list(shown)[:2]
    assert right.lines[2].get_xydata()[0] == pytest.approx([span, found.tension_fairlead / 1e3])
    assert told(left) == ("x from the anchor, m", "height, m", f"{one.type.name}: {one.state(found)}")
    assert told(right) == ("span, m", "kN", "tension and offset") and right.get_ylim()[0] == 0
    assert tuple(pictures[0].get_size_inches()) == (12, 4.6)


def test_growth_over_one_number_is_a_curve_an_hour(monkeypatch, tmp_path):
    made = []
    monkeypatch.setattr(maps, "save", lambda figure, path, dpi: made.append((figure, path, dpi)))
    growth = np.array([[-1e-3, 0.0, 5e-4]])
    found = maps.Map(
        ("hawser.length",), np.array([10.0, 20.0, 40.0]), np.array([np.nan]), growth, growth, growth, 0, ""
    )
    maps.draw(found, tmp_path / "g.png")
    ((figure, path, dpi),) = made
    (axes,) = figure.axes
    assert axes.lines[0].get_xydata() == pytest.approx(np.array([[10, -3.6], [20, 0], [40, 1.8]]), abs=1e-12)
    assert list(axes.lines[1].get_ydata()) == [0, 0]
    assert axes.get_ylabel() == "growth of the slowest motion, 1/h (slewing above 0)"
    assert axes.get_title() == "slewing" and (path, dpi) == (tmp_path / "g.png", 150)


@pytest.mark.parametrize(
    ("values", "bounded"),
    [([[-1e-3, 5e-4], [2e-4, 1e-4]], True), ([[1e-3, 5e-4], [2e-4, 0.0]], False), ([[np.nan, 5e-4], [-1e-3, 0]], False),
     ([[-1e-3, -5e-4], [-2e-4, 0.0]], False)],
)  # fmt: skip
def test_growth_over_two_numbers_is_coloured_alike_on_both_sides_of_none(monkeypatch, tmp_path, values, bounded):
    """White is no growth; the boundary of slewing is drawn where growth has both signs, and everywhere a value"""
    made = []
    monkeypatch.setattr(maps, "save", lambda figure, path, dpi: made.append(figure))
    growth = np.array(values)
    keys = ("hawser.length", "hull.length_over_beam")
    found = maps.Map(keys, np.array([10.0, 20.0]), np.array([2.0, 3.0]), growth, growth, growth, 0, "")
    maps.draw(found, tmp_path / "g.png")
    axes, bar = made[0].axes
    mesh = axes.collections[0]
    assert np.ma.filled(mesh.get_array(), np.nan).ravel() == pytest.approx(3600 * growth.ravel(), nan_ok=True)
    most = 3600 * np.nanmax(np.abs(growth))
    assert mesh.get_clim() == pytest.approx((-most, most)) and mesh.get_cmap().name == "RdBu_r"
    assert (len(axes.collections) == 2) == bounded
    assert bar.get_ylabel() == "growth of the slowest motion, 1/h (red: slewing)"
    assert axes.get_ylabel() == maps._named(keys[1]) and axes.get_xlabel() == maps._named(keys[0])
