"""Transfer functions between stored waves, response spectra and their moments."""

import numpy as np
import pytest
from made_up_body import HEADINGS, INERTIA, OMEGA, STIFFNESS, coefficients, exact_motion, made_up_body

from mooring.environment.between_waves import RangeError
from mooring.environment.sea import Sea
from mooring.environment.spectra import issc
from mooring.environment.spreading import CosinePower
from mooring.response.body import read_body
from mooring.response.headings import at_headings, mirrored
from mooring.response.linear import frequencies, moments, motions, response_spectrum
from mooring.response.seas import directions


@pytest.mark.parametrize("omega", [0.3, 0.36, 0.6, 0.97, 1.0])
def test_coefficients_straight_in_frequency_give_exact_motions(omega):
    found = motions(made_up_body(), [omega], [np.radians(30)])[0, 0]
    assert np.allclose(found, exact_motion(omega, np.radians(30)), rtol=1e-10)


def test_stored_motions_come_back_from_a_real_database(box_database, box_body):
    stored = box_database["rao"]
    found = motions(box_body, box_body.omega, box_body.heading)
    assert np.allclose(found, stored, rtol=1e-9, atol=1e-9 * np.abs(stored).max())


def test_mirrored_waves_give_mirrored_motions():
    """Stored from 0 to 90° only; the exact force is known all round."""
    for degrees in (120, 150, 180, 240, 330):
        beta = np.radians(degrees)
        found = motions(made_up_body(), [0.6], [beta])[0, 0]
        assert np.allclose(found, exact_motion(0.6, beta), rtol=1e-9, atol=1e-15)


def test_a_spline_over_the_circle_converges_at_fourth_order():
    errors = []
    for count in (12, 24, 48):
        ring = np.arange(count) * (2 * np.pi / count)
        wanted = np.linspace(0, 2 * np.pi, 97)
        values = np.exp(2j * np.cos(ring))[None, :, None]
        errors.append(np.abs(at_headings(ring, values, wanted)[0, :, 0] - np.exp(2j * np.cos(wanted))).max())
    assert errors[0] < 0.02  # kR = 2, gaps of 30°
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 3.5), errors


def test_a_body_without_symmetry_gets_no_mirror_images():
    headings, values = mirrored(HEADINGS, np.ones((1, 4, 6)), "", "force")
    assert np.array_equal(headings, HEADINGS) and values.shape == (1, 4, 6)
    with pytest.raises(RangeError, match="wave direction 180° is not between stored headings"):
        motions(made_up_body(symmetry=""), [0.6], [np.pi])


def test_one_stored_heading_serves_itself_alone():
    alone = made_up_body(heading=HEADINGS[:1], excitation=made_up_body().excitation[:, :1], symmetry="")
    assert np.allclose(motions(alone, [0.6], [0.0])[0, 0], exact_motion(0.6, 0.0), rtol=1e-10)
    with pytest.raises(RangeError, match="wave direction 5°"):
        motions(alone, [0.6], [np.radians(5)])


@pytest.mark.parametrize("omega", [0.29, 1.01, np.nan])
def test_frequencies_outside_the_database_are_named(omega):
    with pytest.raises(RangeError, match=f"frequency {omega:.4g} rad/s is outside the database, 0.3 to 1 rad/s"):
        motions(made_up_body(), [omega], [0.0])


def test_variance_of_a_resonant_mode_in_white_noise_is_the_closed_form():
    """∫₀^∞ |F|²S dω / |C − ω²M − iωB|² = π S F² / 2BC for constant coefficients; 1.3 % of it lies beyond the band."""
    M, B, C, F = 5e7, 1e6, 5e7 * 0.6**2, 1e6
    shape = np.zeros((7, 6, 6))
    body = made_up_body(
        added_mass=shape,
        radiation_damping=shape + np.diag([1, 1, 1, 1, 1, 1]) * B,
        inertia=np.eye(6) * M,
        stiffness=np.eye(6) * C,
        excitation=np.full((7, 4, 6), F, complex),
        symmetry="",
    )
    omega = frequencies(body)
    x = motions(body, omega, [0.0])
    found = moments(omega, response_spectrum(x, np.ones(len(omega)))).m0[2]
    fine = np.linspace(0.3, 1.0, 400_001)
    beyond = np.pi * F**2 / (2 * B * C) - np.trapezoid(F**2 / ((C - fine**2 * M) ** 2 + (fine * B) ** 2), fine)
    assert np.isclose(found + beyond, np.pi * F**2 / (2 * B * C), rtol=2e-3)
    assert beyond > 0


def test_frequencies_resolve_the_narrowest_resonance_or_say_that_they_cannot():
    def lightly(factor):
        return made_up_body(radiation_damping=made_up_body().radiation_damping * factor)

    assert len(frequencies(lightly(0.2))) > len(frequencies(lightly(5.0)))
    with pytest.raises(ValueError, match=r"the resonance of .* is narrower than"):
        frequencies(lightly(1e-6))


def test_a_resonance_that_no_wave_reaches_needs_no_resolution():
    """A mooring makes slow surge resonant at 0.35 rad/s with hardly any damping; waves of 5 s have no energy there."""
    moored = made_up_body(radiation_damping=made_up_body().radiation_damping * [0, 1, 1, 1, 1, 1])
    moored = moored.restrained(stiffness=np.diag([0.35**2 * 1.57 * 5e7, 0, 0, 0, 0, 0]), damping=np.eye(6))
    with pytest.raises(ValueError, match=r"the resonance of surge is narrower"):
        frequencies(moored)
    assert len(frequencies(moored, issc(1.0, mean_period=5.0).density)) < 1000


def test_added_damping_lowers_resonance_to_force_over_damping():
    """At ω² = C/(M + A) the amplitude is |F|/ω(B + B′)."""
    w = 0.65
    for _ in range(60):
        w = np.sqrt(STIFFNESS[3, 3] / (INERTIA[3, 3] * (1.5 + 0.2 * w)))
    extra = np.diag([0, 0, 0, 3e8, 0, 0])
    found = motions(made_up_body().restrained(damping=extra), [w], [np.pi / 2])[0, 0, 3]
    assert np.isclose(abs(found), abs((1 + w) * 2e7) / (w * (coefficients(w)[1][3, 3] + 3e8)), rtol=1e-9)


def test_critical_damping_is_that_of_the_mode_alone():
    w = np.sqrt(STIFFNESS[3, 3] / (INERTIA[3, 3] * 1.6))
    for _ in range(60):
        w = np.sqrt(STIFFNESS[3, 3] / (INERTIA[3, 3] * (1.5 + 0.2 * w)))
    expected = 2 * np.sqrt(STIFFNESS[3, 3] * INERTIA[3, 3] * (1.5 + 0.2 * w))
    assert np.isclose(made_up_body().critical_damping(3), expected, rtol=1e-9)
    with pytest.raises(ValueError, match="surge has no restoring"):
        made_up_body().critical_damping(0)


def test_short_crested_response_is_the_mean_over_directions():
    """cos⁴ spreading of |F|² ∝ cos²β about β = 0: ∫ a cos⁶ = 5/6; of sin²: 1/6.  10° steps err by (10°)²/12 of it."""
    omega = frequencies(made_up_body())
    sea = Sea(issc(3.0, mean_period=9.0), 0.0, CosinePower(4.0))
    heading, weights = directions(sea, omega)
    density = sea.spectrum.density(omega)
    m0 = moments(omega, response_spectrum(motions(made_up_body(), omega, heading), density, weights)).m0
    ahead = moments(omega, response_spectrum(motions(made_up_body(), omega, [0.0]), density)).m0
    beam = moments(omega, response_spectrum(motions(made_up_body(), omega, [np.pi / 2]), density)).m0
    assert np.isclose(m0[0] / ahead[0], 5 / 6, rtol=0.02)
    assert np.isclose(m0[3] / beam[3], 1 / 6, rtol=0.03)


def test_databases_that_lack_something_are_refused(box_database):
    class Lacking:
        inertia_matrix = None
        hydrostatic_stiffness = None

    with pytest.raises(ValueError, match="no inertia of the body; give --gyration"):
        read_body(Lacking())
    with pytest.raises(ValueError, match=r"damping matrix has shape \(3, 3\)"):
        read_body(box_database).restrained(damping=np.eye(3))


def test_thinned_bodies_keep_both_ends():
    assert np.array_equal(made_up_body().thinned().omega, OMEGA[[0, 2, 4, 6]])
    even = made_up_body(
        omega=OMEGA[:6],
        added_mass=made_up_body().added_mass[:6],
        radiation_damping=made_up_body().radiation_damping[:6],
        excitation=made_up_body().excitation[:6],
    )
    assert np.array_equal(even.thinned().omega, OMEGA[[0, 2, 4, 5]])
