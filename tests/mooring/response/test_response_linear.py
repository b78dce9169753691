"""Transfer functions between stored waves, response spectra and their moments."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from made_up_body import HEADINGS, INERTIA, OMEGA, STIFFNESS, coefficients, exact_motion, made_up_body

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.response.linear import frequencies, moments, response_spectrum
from hakobune.mooring.response.seas import directions


@pytest.mark.parametrize("omega", [0.3, 0.36, 0.6, 0.97, 1.0])
def test_coefficients_straight_in_frequency_give_exact_motions(omega):
    """To a millionth, the nugget's share of coefficients: a resonance has ten times that"""
    found = made_up_body().motions([omega], [np.radians(30)])
    exact = exact_motion(omega, np.radians(30))
    assert np.allclose(found[0, 0], exact, rtol=1e-5)


def test_stored_motions_come_back_from_a_real_database(box_database, box_body):
    stored = box_database["rao"]
    found = box_body.motions(box_body.omega)
    assert np.allclose(found, stored, rtol=1e-9, atol=1e-9 * np.abs(stored).max())


def test_mirrored_waves_give_mirrored_motions():
    """Stored from 0 to 90° only; the exact force is known all round."""
    for degrees in (120, 150, 180, 240, 330):
        beta = np.radians(degrees)
        found = made_up_body().motions([0.6], [beta])[0, 0]
        assert np.allclose(found, exact_motion(0.6, beta), rtol=1e-6, atol=1e-13)


def test_a_body_without_symmetry_gets_no_mirror_images():
    with pytest.raises(BetweenError, match="wave direction 180° does not lie between stored headings at most 45°"):
        made_up_body(symmetry="").motions([0.6], [np.pi])


def test_one_stored_heading_serves_itself_alone():
    alone = made_up_body(headings=HEADINGS[:1], symmetry="")
    assert np.allclose(alone.motions([0.6], [0.0])[0, 0], exact_motion(0.6, 0.0), rtol=1e-6, atol=1e-13)
    with pytest.raises(BetweenError, match="wave direction 5°"):
        alone.motions([0.6], [np.radians(5)])


@pytest.mark.parametrize("omega", [0.29, 1.01, np.nan])
def test_frequencies_outside_the_database_are_named(omega):
    with pytest.raises(BetweenError, match=f"omega is {omega:.6g} rad/s .* outside the stored 0.3 to 1 rad/s"):
        made_up_body().motions([omega], [0.0])


def test_variance_of_a_resonant_mode_in_white_noise_is_the_closed_form():
    """∫₀^∞ |F|²S dω / |C − ω²M − iωB|² = π S F² / 2BC for constant coefficients; 1.3 % of it lies beyond the band."""
    M, B, C, F = 5e7, 1e6, 5e7 * 0.6**2, 1e6
    shape = np.zeros((len(OMEGA), 6, 6))
    body = made_up_body(
        added_mass=shape,
        radiation_damping=shape + np.diag([1, 1, 1, 1, 1, 1]) * B,
        inertia=np.eye(6) * M,
        stiffness=np.eye(6) * C,
        excitation_force=np.full((len(OMEGA), 4, 6), F, complex),
        symmetry="",
    )
    omega = frequencies(body)
    x = body.motions(omega, [0.0])
    found = moments(omega, response_spectrum(x, np.ones(len(omega)))).m0[2]
    fine = np.linspace(0.3, 1.0, 400_001)
    beyond = np.pi * F**2 / (2 * B * C) - np.trapezoid(F**2 / ((C - fine**2 * M) ** 2 + (fine * B) ** 2), fine)
    assert np.isclose(found + beyond, np.pi * F**2 / (2 * B * C), rtol=2e-3)
    assert beyond > 0


def test_frequencies_resolve_the_narrowest_resonance_or_say_that_they_cannot():
    def lightly(factor):
        return made_up_body(radiation_damping=made_up_body().between.quantities["radiation_damping"] * factor)

    assert len(frequencies(lightly(1e-5))) > len(frequencies(lightly(0.2))) > len(frequencies(lightly(5.0)))
    with pytest.raises(ValueError, match=r"the resonance of .* has no damping; give linear_damping"):
        frequencies(lightly(0.0))


def test_a_resonance_that_no_wave_reaches_needs_no_resolution():
    """A mooring makes slow surge resonant at 0.35 rad/s with hardly any damping; waves of 5 s have no energy there."""
    moored = made_up_body(radiation_damping=made_up_body().between.quantities["radiation_damping"] * [0, 1, 1, 1, 1, 1])
    moored = moored.restrained(stiffness=np.diag([0.35**2 * 1.57 * 5e7, 0, 0, 0, 0, 0]), damping=1e-4 * np.eye(6))
    with pytest.raises(ValueError, match=r"the resonance of surge has no damping"):
        frequencies(moored)
    assert len(frequencies(moored, issc(1.0, mean_period=5.0).density)) < 1000


def test_added_damping_lowers_resonance_to_force_over_damping():
    """At ω² = C/(M + A) the amplitude is |F|/ω(B + B′)."""
    w = 0.65
    for _ in range(60):
        w = np.sqrt(STIFFNESS[3, 3] / (INERTIA[3, 3] * (1.5 + 0.2 * w)))
    extra = np.diag([0, 0, 0, 3e8, 0, 0])
    found = made_up_body().restrained(damping=extra).motions([w], [np.pi / 2])[0, 0, 3]
    assert np.isclose(abs(found), abs((1 + w) * 2e7) / (w * (coefficients(w)[1][3, 3] + 3e8)), rtol=1e-5)


def test_critical_damping_is_that_of_the_mode_alone():
    w = np.sqrt(STIFFNESS[3, 3] / (INERTIA[3, 3] * 1.6))
    for _ in range(60):
        w = np.sqrt(STIFFNESS[3, 3] / (INERTIA[3, 3] * (1.5 + 0.2 * w)))
    expected = 2 * np.sqrt(STIFFNESS[3, 3] * INERTIA[3, 3] * (1.5 + 0.2 * w))
    assert np.isclose(made_up_body().critical_damping(3), expected, rtol=1e-6)
    with pytest.raises(ValueError, match="surge has no restoring"):
        made_up_body().critical_damping(0)


def test_short_crested_response_is_the_mean_over_directions():
    """cos⁴ spreading of |F|² ∝ cos²β about β = 0: ∫ a cos⁶ = 5/6; of sin²: 1/6.  10° steps err by (10°)²/12 of it."""
    omega = frequencies(made_up_body())
    sea = Sea(issc(3.0, mean_period=9.0), 0.0, CosinePower(4.0))
    heading, weights = directions(sea, omega)
    density = sea.spectrum.density(omega)
    m0 = moments(omega, response_spectrum(made_up_body().motions(omega, heading), density, weights)).m0
    ahead = moments(omega, response_spectrum(made_up_body().motions(omega, [0.0]), density)).m0
    beam = moments(omega, response_spectrum(made_up_body().motions(omega, [np.pi / 2]), density)).m0
    assert np.isclose(m0[0] / ahead[0], 5 / 6, rtol=0.02)
    assert np.isclose(m0[3] / beam[3], 1 / 6, rtol=0.03)


def test_databases_that_lack_something_are_refused(box_body):
    with pytest.raises(ValueError, match="no inertia of the body; give --gyration"):
        replace(box_body, inertia=None).floating()
    with pytest.raises(ValueError, match=r"damping matrix has shape \(3, 3\)"):
        box_body.restrained(damping=np.eye(3))


def test_rounding_of_a_motion_that_the_waves_do_not_make_asks_for_no_frequencies():
    """Heave 1/(1 + ω²) of waves on the beam, and surge of which rounding is left, another at every frequency"""
    body = SimpleNamespace(
        omega=np.linspace(0.3, 1.0, 15), headings=np.array([0.5 * np.pi]), words=("surge", "heave"), carrier=object(),
        resonant=lambda headings: np.empty(0),
        motions=lambda omega, headings: np.stack([1e-17 * np.sin(1e9 * omega), 1 / (1 + omega**2)], 1)[:, None],
    )  # fmt: skip
    assert len(frequencies(body)) < 1000


def test_headings_in_which_nothing_moves_need_no_finer_steps():
    """The error of each mode is held against the heading of its largest response, not against a mean of all"""

    def body(moves):
        wave = lambda omega: 1 / (0.5**2 - np.asarray(omega) ** 2 - 0.08j * np.asarray(omega))  # noqa: E731
        motions = lambda omega, headings: wave(omega)[:, None, None] * np.array(moves, float)[None, :, None]  # noqa: E731
        still = SimpleNamespace(
            omega=OMEGA[::4], headings=np.arange(len(moves)), motions=motions, carrier=None, words=["surge"]
        )
        return still

    from hakobune.mooring.response import linear

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(linear, "resonances", lambda body: [])
        patch.setattr(linear, "about", lambda body, found, steps: np.zeros(0))
        alone, many = frequencies(body([1.0])), frequencies(body([0.0, 1.0, *[0.0] * 18]))
    assert np.array_equal(alone, many) and len(alone) > 60
