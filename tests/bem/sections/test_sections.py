"""Sections: the report's tables, laws of waves and forces, accuracy that the tolerance promises."""

import csv
from pathlib import Path

import numpy as np
import pytest
from exact.rectangle import MODES, Rectangle

from hakobune.bem.froude_krylov import incident_force
from hakobune.bem.sections.coefficients import (
    HEAVE,
    ROLL,
    SWAY,
    frequency_of,
    report_row,
    section,
    section_flow,
)
from hakobune.bem.sections.coefficients import diffraction as diffraction_by_haskind
from hakobune.bem.sections.frequency_limits import added_mass_limit
from hakobune.bem.waves import group_factor

G, RHO = 9.80665, 1025.0
TABLES = Path(__file__).parents[2] / "published" / "sections_2d.csv"
SHAPES = [(5, 1.2, 0.1), (5, 10, 3.0), (20, 1.4, 1.0), (10, 1.02, 0.5), (0.5, 3, 0.4), (2, 60, 0.7), (100, 2, 2.0)]
DEEP = [(5, np.inf, 0.5), (20, np.inf, 0.1), (1, np.inf, 0.4), (5, np.inf, 2.82)]
# SR179 report (1982), tables against a converged solution: the larger of the relative and the absolute error
PRINTED = {"M_H": (0.01, 0), "M_R": (0.01, 0), "M_S": (0, 0.0015), "M_SR": (0, 0.004), "N_R": (0.02, 0.002)}


def of(shape, **accuracy):
    beam, depth, xi = shape
    return section(beam, 1.0, depth, float(frequency_of(xi, beam)), density=RHO, gravity=G, **accuracy)


def published():
    lines = (line for line in TABLES.read_text(encoding="utf-8").splitlines() if not line.startswith("#"))
    return [{name: float(row[name]) for name in row if name != "table"} for row in csv.DictReader(lines)]


def test_every_cell_of_the_tables_lies_within_the_error_of_the_printed_series():
    rows, missed = published(), []
    for row in rows:
        ours = report_row(of((row["B_over_d"], row["H_over_d"], row["xi_B"])))
        for name in sorted(set(row) - {"H_over_d", "B_over_d", "xi_B"}):
            difference = ours[name] - row[name]
            if name.startswith("eps"):
                error, allowed = abs((difference + 180) % 360 - 180), 0.15
            else:
                relative, absolute = PRINTED.get(name, (0.01, 0.002))
                error, allowed = abs(difference), max(relative * abs(row[name]), absolute)
            if error > allowed:
                missed.append((row["B_over_d"], row["H_over_d"], row["xi_B"], name, error))
    assert len(rows) * 14 == 840
    assert not missed


@pytest.mark.parametrize("shape", SHAPES)
def test_another_solution_of_the_same_equations_agrees(shape):
    beam, depth, _ = shape
    ours = of(shape)
    # functions that resolve gaps up to 60 times the draft, and the modes for them
    other = Rectangle(beam, 1.0, depth, ours.omega, RHO, G)
    for i, one in zip((HEAVE, SWAY, ROLL), MODES, strict=True):
        assert ours.added_mass[i, i] == pytest.approx(other.impedance(one, one).real, rel=1e-5)
        assert ours.damping[i, i] == pytest.approx(other.impedance(one, one).imag * ours.omega, rel=1e-5)
        assert ours.excitation[i] == pytest.approx(other.excitation(one), rel=1e-5)


@pytest.mark.parametrize("shape", SHAPES[:6])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 1e-5])
def test_the_tolerance_is_kept(shape, tolerance):
    rough, fine = of(shape, tolerance=tolerance), of(shape, tolerance=1e-7)
    sizes = np.sqrt(np.outer(fine.added_mass.diagonal(), fine.added_mass.diagonal()))
    assert np.all(np.abs(rough.added_mass - fine.added_mass) < tolerance * np.abs(sizes))
    assert np.all(np.abs(rough.damping.diagonal() - fine.damping.diagonal()) < 2 * tolerance * fine.damping.diagonal())
    assert np.all(np.abs(rough.excitation - fine.excitation) < tolerance * np.abs(fine.excitation))


@pytest.mark.parametrize("shape", SHAPES + DEEP)
def test_damping_is_the_energy_of_the_radiated_waves(shape):
    """B = 2ρg (n/kω) |η|², to the rounding of ωA + iB, of which it is the small part.

    The integral equation of deep water keeps the law to its tolerance only.
    """
    s = of(shape, tolerance=1e-7)
    power = 2 * RHO * G * float(group_factor(s.k, s.depth)) / (s.k * s.omega)
    limit = 1e-12 if np.isfinite(s.depth) else 1e-7
    whole = np.hypot(s.omega * s.added_mass.diagonal(), s.damping.diagonal())
    assert np.all(np.abs(s.damping.diagonal() - power * np.abs(s.radiated) ** 2) <= limit * whole)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_waves_of_the_fixed_body_carry_the_energy_of_the_incident_one(shape):
    s = of(shape)
    assert abs(s.reflection) ** 2 + abs(s.transmission) ** 2 == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("shape", SHAPES)
def test_exciting_forces_are_the_radiated_waves_by_haskind(shape):
    s = of(shape)
    assert s.haskind == pytest.approx(s.excitation, rel=1e-8)
    flow = section_flow(s.beam, s.draft, s.depth, s.omega, gravity=G)
    incident = RHO * G * incident_force(s.beam / 2, s.draft, s.depth, s.k, np.array([s.k]))
    by_contour = incident[0] + diffraction_by_haskind(flow, RHO, [1.0])[0]
    assert by_contour == pytest.approx(s.excitation, rel=1e-7)


@pytest.mark.parametrize("shape", SHAPES + DEEP)
def test_reflection_follows_from_the_phases_of_the_forces(shape):
    s = of(shape)
    sway, heave = (np.exp(2j * np.angle(s.excitation[i])) for i in (SWAY, HEAVE))
    assert s.reflection == pytest.approx((heave + sway) / 2, abs=1e-8)
    assert s.transmission == pytest.approx((heave - sway) / 2, abs=1e-8)
    n = float(group_factor(s.k, s.depth))
    assert s.drift == pytest.approx(RHO * G * n * np.cos(np.angle(sway / heave) / 2) ** 2, rel=1e-7, abs=1e-9)


@pytest.mark.parametrize("shape", SHAPES + DEEP)
def test_sway_and_roll_radiate_one_antisymmetric_wave(shape):
    """N_SR² = N_S N_R, ε_R = ε_S or ε_S ± 180°, and the coupling is reciprocal."""
    s = of(shape)
    limit = 1e-9 if np.isfinite(s.depth) else 1e-6
    N = s.damping
    assert N[SWAY, ROLL] ** 2 == pytest.approx(N[SWAY, SWAY] * N[ROLL, ROLL], rel=limit)
    turn = np.angle(s.excitation[ROLL] / s.excitation[SWAY]) / np.pi
    assert turn == pytest.approx(np.round(turn), abs=limit)
    assert s.added_mass[SWAY, ROLL] == pytest.approx(s.added_mass[ROLL, SWAY], rel=limit)


def test_long_waves_lift_like_water_standing_higher():
    s = of((5.0, 3.0, 1e-8))
    assert s.excitation[HEAVE] == pytest.approx(RHO * G * s.beam, rel=1e-3)


def test_deep_water_is_the_limit_of_finite_depth_at_second_order():
    deep = of((2.0, np.inf, 1.5), tolerance=1e-7)
    depths = np.array([15.0, 30.0, 60.0])
    errors = [
        abs(of((2.0, h, 1.5), tolerance=1e-7).added_mass[HEAVE, HEAVE] / deep.added_mass[1, 1] - 1) for h in depths
    ]
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 1.9), errors


def test_deep_water_has_no_irregular_frequencies():
    """Inside, B/d = 5, a wave of half a length stands at K = κ coth κd, κ = π/B, ξ_B = 2.82."""
    beam = 5.0
    kappa = np.pi / beam
    standing = kappa / np.tanh(kappa) * beam / 2
    xi = standing * (1 + np.linspace(-0.02, 0.02, 9))
    heave = [of((beam, np.inf, x), tolerance=1e-3).added_mass[HEAVE, HEAVE] for x in xi]
    bend = np.abs(np.diff(heave, 3))
    assert np.all(bend < 1e-5 * np.abs(heave[4])), bend


@pytest.mark.parametrize("shape", [(5.0, 1.4), (5.0, 3.0), (1.0, 3.0)])
def test_limits_of_the_frequency_are_reached_at_second_order(shape):
    beam, depth = shape
    for which, omegas in (("zero", (0.02, 0.01)), ("infinity", (20.0, 40.0))):
        limit = added_mass_limit(beam, 1.0, depth, which, density=RHO, tolerance=1e-7)
        near = [section(beam, 1.0, depth, w, density=RHO, tolerance=1e-7).added_mass for w in omegas]
        errors = [np.abs(one - limit)[[0, 1, 2, 0], [0, 1, 2, 2]] for one in near]
        assert np.all(np.abs(errors[0] / errors[1] - 4) < 0.4), which


def test_a_film_under_the_keel_flows_as_lubrication_says():
    """Incompressible film s thin under half beam b: φ = (b² − y²)/2s."""
    gaps = np.array([0.02, 0.01])
    film = [of((4.0, 1 + s, 1.0)).added_mass[HEAVE, HEAVE] / RHO * s for s in gaps]
    errors = np.abs(np.array(film) - 2 * 2.0**3 / 3)  # ∫ (b² − y²)/2 dy
    assert errors[1] / errors[0] < 0.6  # of first order in the gap, apart from its logarithm
    assert errors[1] < 0.1 * film[1]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((0.0, 1.0, 3.0, 1.0), "beam is 0 m"),
        ((5.0, 1.0, 1.0, 1.0), "depth is 1 m at draft 1 m"),
        ((5.0, 1.0, 1.00001, 1.0), r"\(depth − draft\) is 1e-05 m; allowed: 3e-05 m or more"),
        ((5.0, 1.0, 3.0, 0.0), "omega is 0 rad/s"),
        ((5.0, np.nan, 3.0, 1.0), "draft is nan m"),
        ((5.0, 1.0, 900.0, 1.0), "depth − draft is 899 times"),
    ],
)
def test_what_cannot_be_solved_is_refused_by_name(arguments, said):
    with pytest.raises(ValueError, match=said):
        section(*arguments)
