"""Waves between low_rank nodes against waves between all: the same answers, to the accuracy of the basis."""

from functools import cache

import numpy as np
import pytest
from other_equations import with_equations

from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.band import one_frequency
from hakobune.bem.panels.band.equations import band_equations
from hakobune.bem.panels.band.one_frequency import BandRun
from hakobune.bem.panels.one_frequency import PanelRun
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy

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
        "rotated box": (lambda: box(60, 30, 8, panels=100).whole().rotated(0.4).moved(3, 2, 0), {"depth": 25.0}),
    }
    make, options = shapes[name]
    mesh = make()
    return prepare(PanelProblem(mesh, lid(mesh), band=band, **options))


def both(prepared, omega, want=WANT, dofs=DOFS):
    if prepared.problem.wall is not None:
        want = want - {"drift_force_fixed"}
    runs = BandRun, PanelRun
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
        "rotated box",
    ],
)
def test_low_rank_waves_give_what_full_matrices_give(name, omega):
    prepared = body(name)
    low_rank, full = both(prepared, omega)
    stages = {"incident", "reduction", "table", "assemble", "solve"}
    if prepared.problem.wall is None:
        stages |= {"potentials", "far field"}
    assert low_rank["wall_time"].keys() == stages
    # potentials are as good as the basis; forces of short waves are differences of larger ones.  The accuracy is a
    # twentieth of the error that the panels leave, or less: ten times that is still within it
    limit = 10 * prepared.band_equations[0].accuracy
    assert largest_difference(low_rank, full) < limit
    if prepared.problem.wall is None:
        assert drift_difference(low_rank, full, prepared.radius) < limit


def test_the_difference_falls_with_the_accuracy_of_the_basis():
    prepared, errors = body("box in 20 m"), []
    for accuracy in (2e-3, 2e-5):
        equations = band_equations(prepared.geometry, BAND, 9.80665, accuracy)
        errors.append(largest_difference(*both(with_equations(prepared, equations), 0.8)))
    assert errors[1] < 0.1 * errors[0]


def test_one_degree_of_freedom_and_one_product_alone_are_those_of_all():
    prepared = body("box in 20 m")
    whole, _ = both(prepared, 0.5)
    for name in sorted(WANT):
        low_rank, _ = both(prepared, 0.5, {name}, ("Surge", "Pitch"))
        wanted = [0, 4]
        picked = np.ix_(wanted, wanted) if name in ("added_mass", "radiation_damping") else (..., wanted)
        if name == "drift_force_fixed":
            picked = ...
        # what symmetry makes zero is rounding of terms as large as the others
        rounding = 1e-12 * np.abs(whole[name]).max()
        np.testing.assert_allclose(low_rank[name][picked], whole[name][picked], rtol=1e-9, atol=rounding)


@pytest.mark.parametrize("name", ["rotated box", "box in 20 m"])
@pytest.mark.parametrize("heading", [45.0, 135.0, 225.0, 315.0])
def test_waves_from_every_quadrant_are_in_the_low_rank_basis(name, heading, monkeypatch):
    prepared, rejected = body(name), []
    monkeypatch.setattr(BandRun, "rejected", lambda self, error: rejected.append(error))
    for omega in (0.5, 0.8, 1.1):
        _ = BandRun(prepared, omega, np.radians([heading]), {"excitation_force"}, None, DOFS).potentials
    assert not rejected


def test_frequencies_outside_the_band_use_full_matrices():
    prepared = body("box in 20 m")
    assert type(prepared.run(0.6, HEADINGS, WANT, None, DOFS)) is BandRun
    assert type(prepared.run(1.3, HEADINGS, WANT, None, DOFS)) is PanelRun


def test_a_basis_too_small_is_rejected_and_full_or_compressed_matrices_are_used(monkeypatch):
    rough = band_equations(body("box in 20 m").geometry, (0.2, 0.21), 9.80665, 1e-2)  # long waves only
    prepared = with_equations(body("box in 20 m"), tuple(part._replace(accuracy=1e-5) for part in rough))
    low_rank, full = both(prepared, 0.8)
    assert largest_difference(low_rank, full) == 0.0
    monkeypatch.setattr(one_frequency, "LARGEST_FULL_SYSTEM", 10)
    compressed, full = both(prepared, 0.8)
    assert 0 < largest_difference(compressed, full) < 1e-4


def test_the_same_band_gives_the_same_bits():
    first, _ = both(body.__wrapped__("buoy"), 0.7)
    second, _ = both(body.__wrapped__("buoy"), 0.7)
    for name in WANT:
        np.testing.assert_array_equal(first[name], second[name])
