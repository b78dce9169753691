"""Waves between few nodes against waves between all: the same answers, to the accuracy of the space."""

from functools import cache

import numpy as np
import pytest

from bem.methods.panel_setup import Setup, prepare
from bem.panels.band import one_frequency as reduced_run
from bem.panels.band.equations import reduced
from bem.panels.band.one_frequency import ReducedRun
from bem.panels.one_frequency import PanelRun
from meshing.lid import lid
from meshing.shapes import box, buoy

DOFS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
WANT = {"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed"}
HEADINGS = np.radians([0.0, 35.0])
BAND = (0.2, 1.1)


@cache
def body(name, band=BAND):
    """A few hundred nodes, every kind of symmetry and depth"""
    shapes = {
        "box in 20 m": (lambda: box(100, 50, 10, panels=104), {"depth": 20.0}),
        "box over a small gap": (lambda: box(100, 50, 10, panels=104), {"depth": 10.5}),
        "box in deep water": (lambda: box(100, 50, 10, panels=104), {"depth": np.inf}),
        "buoy": (lambda: buoy(10, 10, panels=96), {"depth": 30.0}),
        "box beside a wall": (lambda: box(100, 50, 10, panels=104), {"depth": 20.0, "wall": -40.0}),
        "turned box": (lambda: box(60, 30, 8, panels=100).whole().rotated(0.4).moved(3, 2, 0), {"depth": 25.0}),
    }
    make, options = shapes[name]
    mesh = make()
    return prepare(Setup(mesh, lid(mesh), band=band, **options))


def both(prepared, omega, want=WANT, dofs=DOFS):
    if prepared.setup.wall is not None:
        want = want - {"drift_force_fixed"}
    runs = ReducedRun, PanelRun
    return [run(prepared, omega, HEADINGS, want, None, dofs).result() for run in runs]


def largest_difference(one, other):
    """Of A + iB/ω and forces, relative to the largest of each kind (translations and rotations apart)"""
    worst = 0.0
    for half in (slice(0, 3), slice(3, 6)):
        for a, b in zip(parts(one, half), parts(other, half), strict=True):
            worst = max(worst, np.abs(a - b).max() / np.abs(b).max())
    return worst


def parts(result, half):
    """A + iB (s⁻¹ a unit of 1 rad/s) and excitation of translations or rotations, where they are wanted"""
    if "added_mass" in result:
        yield (result["added_mass"] + 1j * result["radiation_damping"])[half, half]
    yield result["excitation_force"][:, half]


def drift_difference(one, other, width):
    """Relative to total reflection over `width` (m): drift of long waves is a small difference of large terms"""
    a, b = (r["drift_force_fixed"][:, :2] for r in (one, other))
    return np.abs(a - b).max() / (0.5 * 1025 * 9.80665 * width)


@pytest.mark.parametrize("omega", [0.2, 0.63, 1.1])
@pytest.mark.parametrize(
    "name",
    [
        "box in 20 m",
        "box over a small gap",
        "box in deep water",
        "buoy",
        "box beside a wall",
        "turned box",
    ],
)
def test_few_nodes_give_what_all_nodes_give(name, omega):
    prepared = body(name)
    few, all_nodes = both(prepared, omega)
    # potentials are as good as the space; forces of short waves are differences of larger ones.  The accuracy is a
    # twentieth of the error that the panels leave, or less: ten times that is still within it
    limit = 10 * prepared.reduced[0].accuracy
    assert largest_difference(few, all_nodes) < limit
    if prepared.setup.wall is None:
        assert drift_difference(few, all_nodes, prepared.radius) < limit


def test_the_difference_falls_with_the_accuracy_of_the_space():
    prepared, errors = body("box in 20 m"), []
    kept = prepared.reduced
    for accuracy in (2e-3, 2e-5):
        prepared.__dict__["reduced"] = reduced(prepared.geometry, BAND, 9.80665, accuracy)
        errors.append(largest_difference(*both(prepared, 0.8)))
    prepared.__dict__["reduced"] = kept
    assert errors[1] < 0.1 * errors[0]


def test_one_degree_of_freedom_and_one_product_alone_are_those_of_all():
    prepared = body("box in 20 m")
    whole, _ = both(prepared, 0.5)
    for name in sorted(WANT):
        few, _ = both(prepared, 0.5, {name}, ("Surge", "Pitch"))
        mine = [0, 4]
        picked = np.ix_(mine, mine) if name in ("added_mass", "radiation_damping") else (..., mine)
        if name == "drift_force_fixed":
            picked = ...
        # what symmetry makes zero is rounding of terms as large as the others
        rounding = 1e-12 * np.abs(whole[name]).max()
        np.testing.assert_allclose(few[name][picked], whole[name][picked], rtol=1e-9, atol=rounding)


@pytest.mark.parametrize("name", ["turned box", "box in 20 m"])
@pytest.mark.parametrize("heading", [45.0, 135.0, 225.0, 315.0])
def test_waves_from_every_quarter_are_carried_by_few_nodes(name, heading, monkeypatch):
    prepared, lost = body(name), []
    monkeypatch.setattr(ReducedRun, "in_full", lambda self, part: lost.append(part))
    for omega in (0.5, 0.8, 1.1):
        _ = ReducedRun(prepared, omega, np.radians([heading]), {"excitation_force"}, None, DOFS).potentials
    assert not lost


def test_frequencies_outside_the_band_take_all_nodes():
    prepared = body("box in 20 m")
    assert type(prepared.run(0.6, HEADINGS, WANT, None, DOFS)) is ReducedRun
    assert type(prepared.run(1.3, HEADINGS, WANT, None, DOFS)) is PanelRun


def test_a_space_too_small_is_noticed_and_all_nodes_are_taken(monkeypatch):
    prepared = body("box in 20 m")
    kept = prepared.reduced
    rough = reduced(prepared.geometry, (0.2, 0.21), 9.80665, 1e-2)  # long waves only
    prepared.__dict__["reduced"] = tuple(part._replace(accuracy=1e-5) for part in rough)
    few, all_nodes = both(prepared, 0.8)
    assert largest_difference(few, all_nodes) == 0.0
    monkeypatch.setattr(reduced_run, "MOST_IN_FULL", 10)
    with pytest.raises(FloatingPointError, match="lost between few nodes"):
        both(prepared, 0.8)
    prepared.__dict__["reduced"] = kept


def test_the_same_band_gives_the_same_bits():
    first, _ = both(body.__wrapped__("buoy"), 0.7)
    second, _ = both(body.__wrapped__("buoy"), 0.7)
    for name in WANT:
        np.testing.assert_array_equal(first[name], second[name])
