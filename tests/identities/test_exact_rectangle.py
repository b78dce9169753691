"""The two-dimensional rectangle by matched eigenfunctions: laws, limits and the tables of the report."""

import csv
from pathlib import Path

import numpy as np
import pytest
from exact.rectangle import MODES, Rectangle
from exact.water_waves import group_factor

G = 9.80665
TABLES = Path(__file__).parent.parent / "published" / "sections_2d.csv"
SHAPES = [(5, 1.2, 0.1), (5, 10, 3.0), (20, 1.4, 1.0), (10, 1.02, 0.5), (0.5, 3, 0.4)]  # B/d, H/d, xi_B


def rectangle(beam, depth, xi, **accuracy):
    return Rectangle(beam, 1.0, depth, np.sqrt(xi * 2 * G / beam), gravity=G, **accuracy)


def published():
    lines = (line for line in TABLES.read_text(encoding="utf-8").splitlines() if not line.startswith("#"))
    return [{name: float(row[name]) for name in row if name != "table"} for row in csv.DictReader(lines)]


@pytest.mark.parametrize("row", published(), ids=lambda r: f"{r['B_over_d']:g}-{r['H_over_d']:g}-{r['xi_B']:g}")
def test_tables_of_the_report_follow_within_their_truncation(row):
    """Plain cosines see the corner singularity of the velocity, so 20 of them leave 20^(−4/3) = 1.8 %."""
    truncation = 20 ** (-4 / 3)
    ours = rectangle(row["B_over_d"], row["H_over_d"], row["xi_B"]).table()
    for name, value in ours.items():
        if name.startswith("eps"):
            turn = (value - row[name] + 180) % 360 - 180
            assert abs(turn) < np.degrees(truncation), name
        else:
            # the cross term is a difference of a side and a bottom part of the size of sqrt(M_S M_R)
            size = np.sqrt(ours["M_S"] * ours["M_R"]) if name == "M_SR" else abs(value)
            assert abs(value - row[name]) < truncation * size + 0.0005, name


@pytest.mark.parametrize("shape", SHAPES)
def test_reflected_and_transmitted_waves_carry_the_energy_of_the_incident_one(shape):
    reflected, transmitted = rectangle(*shape).reflection_transmission
    assert abs(reflected) ** 2 + abs(transmitted) ** 2 == pytest.approx(1, abs=1e-9)


@pytest.mark.parametrize("shape", SHAPES)
def test_exciting_force_is_the_radiated_wave_by_haskind(shape):
    body = rectangle(*shape)
    group = group_factor(body.k, body.depth)
    for mode, sign in zip(MODES, (-1, 1, 1), strict=True):  # antisymmetric modes send the opposite to y → −∞
        haskind = sign * 2 * body.density * G * group * body.omega / body.k * body.radiated_wave(mode)
        assert body.excitation(mode) == pytest.approx(haskind, rel=1e-8)


@pytest.mark.parametrize("shape", SHAPES)
def test_damping_is_the_energy_of_the_radiated_waves(shape):
    body = rectangle(*shape)
    for mode in MODES:
        power = body.density * G * group_factor(body.k, body.depth) * body.omega / body.k
        radiated = 2 * power * abs(body.radiated_wave(mode)) ** 2
        assert body.impedance(mode, mode).imag * body.omega == pytest.approx(radiated, rel=1e-8)


@pytest.mark.parametrize("shape", SHAPES)
def test_reflection_follows_from_the_phases_of_the_forces(shape):
    body = rectangle(*shape)
    reflected, transmitted = body.reflection_transmission
    heave, sway = (np.exp(2j * np.angle(body.excitation(mode))) for mode in ("H", "S"))
    assert reflected == pytest.approx((heave + sway) / 2, abs=1e-8)
    assert transmitted == pytest.approx((heave - sway) / 2, abs=1e-8)


@pytest.mark.parametrize("shape", SHAPES)
def test_coupling_is_reciprocal(shape):
    body = rectangle(*shape)
    size = abs(body.impedance("S", "S") * body.impedance("R", "R")) ** 0.5
    assert abs(body.impedance("S", "R") - body.impedance("R", "S")) < 1e-8 * size


@pytest.mark.parametrize("shape", SHAPES)
def test_more_functions_change_nothing_that_matters(shape):
    coarse, fine = (rectangle(*shape, terms=p, modes=m) for p, m in ((20, 100), (28, 200)))
    for mode in MODES:
        assert coarse.impedance(mode, mode) == pytest.approx(fine.impedance(mode, mode), rel=1e-6)
        assert coarse.excitation(mode) == pytest.approx(fine.excitation(mode), rel=1e-6)


def test_long_waves_lift_like_water_standing_higher():
    body = rectangle(5.0, 3.0, 1e-8)
    assert body.excitation("H") == pytest.approx(body.density * G * body.beam, rel=1e-3)


def test_a_film_under_the_keel_flows_as_lubrication_says():
    """Incompressible film s thin under half-beam b: φ = (b² − y²)/2s."""
    beam, gaps = 4.0, np.array([0.02, 0.01])
    film = [rectangle(beam, 1 + s, 1.0).impedance("H", "H").real / 1025.0 * s for s in gaps]
    limit = 2 * (beam / 2) ** 3 / 3  # ρ ∫ (b² − y²)/2 dy
    errors = np.abs(np.array(film) - limit)
    assert errors[1] < errors[0] < 0.2 * limit
    assert errors[1] / errors[0] < 0.6  # of first order in the gap, apart from its logarithm
