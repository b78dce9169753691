"""Resonances between stored frequencies: where they are, how high, and that nothing told of motions misses them."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.database.resonances import about, resonances
from hakobune.bem.viscous import Quadratic, Viscous
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.sea_state import sea_state
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.gaps import gaps_of
from hakobune.pipelines.view.plots import Curves

BUOY = "buoy --radius 8 --draft 6 --depth 40 --gyration 4.5,4.5,4.5 --center-of-gravity 0,0,-1.5"
PITCH = 4


def made(folder, omega):
    path = folder / f"{omega.replace(':', '_')}.h5"
    assert main([*BUOY.split(), "--omega", omega, "--output", str(path)]) == 0
    return open_database(path)


@pytest.fixture(scope="module")
def band(tmp_path_factory):
    return made(tmp_path_factory.mktemp("band"), "auto:0.2:2.5")


@pytest.fixture(scope="module")
def fixed(tmp_path_factory):
    return made(tmp_path_factory.mktemp("fixed"), "0.2:2.5:40")


def pitch_of(body):
    return next(one for one in resonances(body) if one.mode == PITCH)


def test_a_peak_between_frequencies_is_that_of_frequencies_solved_around_it(band, fixed, tmp_path):
    """A damping ratio of 2·10⁻⁴: the peak is a hundred times narrower than the step between 40 frequencies"""
    found = pitch_of(band.reader)
    width = found.damping * found.omega
    solved = made(tmp_path, f"{found.omega - width!r}:{found.omega + width!r}:9")
    assert found.damping < 1e-3
    for one in (found, pitch_of(fixed.reader)):
        assert one.peak == pytest.approx(np.abs(solved["rao"][:, 0, PITCH]).max(), rel=0.02)
        assert one.omega == pytest.approx(found.omega, rel=1e-5)


def test_a_band_stores_its_resonances_and_asks_for_nothing_more(band):
    found = pitch_of(band.reader)
    assert np.abs(band["rao"][:, 0, PITCH]).max() > 0.9 * found.peak
    assert found.error < 0.02 * found.peak
    before = band.path.read_bytes()
    assert main([*BUOY.split(), "--omega", "auto:0.2:2.5", "--output", str(band.path)]) == 0
    assert band.path.read_bytes() == before


def test_a_dozen_chosen_frequencies_and_forty_fixed_ones_give_the_same_motions_in_a_sea(band, fixed):
    sea = Sea(issc(2.0, mean_period=8.0), 0.0)
    sigma = [sea_state(db.reader.floating(), sea, 10800.0).sigma for db in (band, fixed)]
    assert np.allclose(*sigma, rtol=0.01, atol=1e-9)


def test_curves_reach_the_peak_that_stored_frequencies_miss(fixed):
    curves, found = Curves(fixed, gaps_of(fixed)), pitch_of(fixed.reader)
    assert np.abs(curves["rao"][:, 0, PITCH]).max() > 0.97 * found.peak
    assert np.abs(fixed["rao"][:, 0, PITCH]).max() < 0.1 * found.peak
    assert np.array_equal(curves["rao"][curves.stored], fixed["rao"])


def test_solve_and_check_name_a_resonance_with_its_period_peak_and_damping(fixed, capsys):
    capsys.readouterr()
    assert main(["check", str(fixed.path)]) == 0
    (line,) = [line for line in capsys.readouterr().out.splitlines() if "resonance of pitch" in line]
    found = pitch_of(fixed.reader)
    assert f"{found.period:.4g} s" in line and f"peak {np.degrees(found.peak):.0f} °/m" in line
    assert "damping ratio 0.00024 of waves alone, without viscous damping, which lowers it" in line
    assert "stored frequencies near it show 1.8 % of the peak" in line


def test_the_height_of_a_peak_is_force_over_damping(fixed):
    """X = F / ωB of a motion alone at its own frequency, however much damping is added"""
    body, mode = fixed.reader, 2
    free = next(one for one in resonances(body) if one.mode == mode)
    critical = body.critical_damping(mode)
    for share in (0.0, 0.02, 0.05):
        added = np.zeros((6, 6))
        added[mode, mode] = share * critical
        one = next(one for one in resonances(body.restrained(damping=added)) if one.mode == mode)
        assert one.damping == pytest.approx(free.damping + share, rel=0.02)
        F, B = np.abs(body.forces([one.omega])[0, 0, mode]), body.coefficients([one.omega])[1][0, mode, mode]
        # the highest place is off its own frequency by some ζ² of it, where motion is some (ζ)² lower
        assert one.peak == pytest.approx(F / (one.omega * (B + added[mode, mode])), rel=5 * one.damping**2)


def test_viscous_damping_lowers_a_peak_and_is_in_its_damping_ratio(fixed):
    laws = Viscous({"Pitch": Quadratic(2e8)}, 1.0)
    free, damped = (pitch_of(body) for body in (fixed.reader, replace(fixed.reader, viscous=laws, own=False)))
    assert damped.viscous and not free.viscous
    assert damped.peak * damped.damping == pytest.approx(free.peak * free.damping, rel=0.05)
    assert damped.peak < 0.1 * free.peak


def test_what_is_known_beside_a_stored_frequency_is_known_as_well_as_at_it(fixed):
    """Else the damping that decides a resonance would be uncertain by the rounding of a fit to all frequencies"""
    for name in ("radiation_damping", "added_mass", "excitation_force"):
        _, error = fixed.at(fixed.omega[8] * (1 + 1e-9), name)
        assert np.all(error <= 1e-6 * np.abs(fixed[name]).max())


def test_too_few_frequencies_and_bodies_without_inertia_have_no_resonances(fixed):
    body = fixed.reader
    assert resonances(replace(body, inertia=None)) == []
    few = replace(body.between, omega=body.omega[:3], quantities={n: v[:3] for n, v in body.between.quantities.items()})
    assert resonances(replace(body, between=few)) == []
    assert about(body, []).size == 0
