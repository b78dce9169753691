"""Seas of several systems of waves, and spectra from files, in the response of the small box."""

import numpy as np
import pytest
from made_up_body import made_up_body

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower
from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.environment.wave_records import elevation
from hakobune.mooring.response.sea_state import sea_state
from hakobune.mooring.response.seas import directions
from hakobune.mooring.seas.breaking import BreakingError
from hakobune.mooring.seas.spectra_files import read_sea, two_dimensional
from hakobune.mooring.seas.systems import Systems

HOUR = 3600.0
SWAN = """SWAN   1
$ a comment
TIME
     1
LOCATIONS
     2
  100.0  0.0
  200.0  0.0
AFREQ
     3
    0.08
    0.10
    0.12
{kind}
     4
    0.0
   90.0
  180.0
  270.0
QUANT
     1
VaDens
m2/Hz/degr
   -0.9900E+02
20260101.000000
ZERO
FACTOR
  0.001
  0 0 0 0
  4 0 2 0
  0 0 0 0
"""


def sea_of(height, degrees, spreading=None):
    return Sea(jonswap(height, peak_period=9.0), np.radians(degrees), spreading)


@pytest.mark.parametrize("spreading", [None, CosinePower(4.0)], ids=["long", "short"])
def test_two_halves_of_a_sea_are_the_sea(box_body, spreading):
    """Of energies, mean drift, slow drift of all pairs and wave drift damping"""
    whole = sea_state(box_body, sea_of(2.0, 30.0, spreading), HOUR)
    halves = Systems((sea_of(np.sqrt(2.0), 30.0, spreading), sea_of(np.sqrt(2.0), 30.0, spreading)))
    both = sea_state(box_body, halves, HOUR)
    assert np.allclose(both.moments.m0, whole.moments.m0, rtol=1e-9)
    for name in ("drift", "spectrum", "damping"):
        one, other = getattr(both.slow, name), getattr(whole.slow, name)
        assert np.allclose(one, other, rtol=1e-6, atol=1e-6 * np.abs(other).max())


def test_energies_and_mean_forces_of_swell_and_wind_sea_add(box_body):
    swell, wind = sea_of(1.0, 0.0), sea_of(2.0, 90.0, CosinePower(4.0))
    alone, both = [sea_state(box_body, one, HOUR) for one in (swell, wind)], Systems((swell, wind))
    found = sea_state(box_body, both, HOUR)
    assert np.allclose(found.moments.m0, sum(one.moments.m0 for one in alone), rtol=2e-3)
    mean = sum(one.slow.drift for one in alone)
    assert np.allclose(found.slow.drift[:2], mean[:2], rtol=2e-3)
    record = elevation(both.components(800, 3), np.arange(0, HOUR, 0.5))
    assert np.isclose(4 * record.std(), np.sqrt(5.0), rtol=0.03)


def test_a_sea_that_the_water_cannot_hold_has_no_response():
    with pytest.raises(BreakingError, match="single waves break at"):
        sea_state(made_up_body(), Sea(jonswap(25.0, peak_period=12.0)), HOUR)


def test_a_two_dimensional_spectrum_of_a_spread_sea_is_that_sea(box_body):
    """S(ω)D(θ) written as a table every 2°: deviations and drift agree within what straight lines between rows err"""
    sea = sea_of(2.0, 40.0, CosinePower(4.0))
    omega, angle = np.linspace(0.25, 2.5, 226), np.radians(np.arange(0.0, 360.0, 2.0))
    away = np.mod(angle - sea.direction + np.pi, 2 * np.pi) - np.pi
    table = two_dimensional(omega, angle, np.outer(sea.spectrum.density(omega), sea.spreading.density(away)), "made")
    exact, found = (sea_state(box_body, one, HOUR) for one in (sea, table))
    kept = exact.sigma > 0
    assert np.allclose(found.sigma[kept], exact.sigma[kept], rtol=3e-3)
    assert np.allclose(found.slow.drift[:2], exact.slow.drift[:2], rtol=5e-3)


@pytest.mark.parametrize("kind, x_axis, shares", [("CDIR", None, (2, 0, 1, 0)), ("NDIR", 90.0, (0, 2, 0, 1))])
def test_directions_of_a_swan_file_are_turned_to_where_waves_travel(tmp_path, kind, x_axis, shares):
    """Energy 2 to 1 at 0° and 180°: Cartesian, travelled to; nautical with x to the east, from north to −y

    From north (0°) to south is −y with the x axis to the east: 270°, and from south to north 90°.
    """
    path = tmp_path / "one.spc"
    path.write_text(SWAN.format(kind=kind))
    sea = read_sea(path, x_axis, location=2)
    # triangle of 6e-3 m²/Hz/° × 90° over 0.08 to 0.12 Hz
    assert np.isclose(sea.spectrum.moment(0), 0.006 * 90 * 0.02)
    heading, weights = directions(sea, np.array([2 * np.pi * 0.1]), 90.0)
    wanted = np.array(shares if kind == "CDIR" else (0, 1, 0, 2)) / 3
    found = np.zeros(4)
    found[np.round(np.degrees(heading) / 90).astype(int) % 4] = weights[0]
    assert np.allclose(found, wanted, atol=1e-9)


def test_a_row_of_a_buoy_is_its_spectrum(tmp_path):
    path = tmp_path / "46042.txt"
    path.write_text("#YY MM DD hh mm .0500 .1000 .1500\n2026 01 01 00 40 0.0 2.0 0.0\n2026 01 01 01 40 0.0 999.0 1.0\n")
    assert np.isclose(read_sea(path, time="2026 01 01 00 40").spectrum.moment(0), 2.0 * 0.05)
    with pytest.raises(TableError, match="2 rows; choose one"):
        read_sea(path)
    path.write_text(
        "#YY MM DD hh mm .0500 .1000 .1500\n#yr mo dy hr mn m2/Hz m2/Hz m2/Hz\n2026 01 01 00 40 0.0 2.0 0.0\n"
    )
    assert np.isclose(read_sea(path).spectrum.moment(0), 2.0 * 0.05)  # a line of units is no row


def wavewatch(density, place="'one' 50.0 -2.0 20.0 10.0 270.0 0.1 90.0"):
    """A file of two times and two points, the second with `density` (4, 3) by direction north, east, south, west"""
    numbers = "  ".join(f"{value:.5E}" for value in np.ravel(density))
    none = "  ".join(["0.0"] * 12)
    both = f"{place}\n{none}\n{place}\n{numbers}\n"
    head = "'WAVEWATCH III SPECTRA'     3     4     2 'points of a grid'\n 0.800E-01 0.100E+00 0.120E+00\n"
    head += " 0.000E+00 0.157079633E+01 0.314159265E+01\n 0.471238898E+01\n"
    return f"{head}20260101 000000\n{both}20260101 030000\n{both}"


def test_directions_of_a_wavewatch_file_are_where_waves_travel_clockwise_from_north(tmp_path):
    """Energy 2 to 1 towards north and east, the x axis to the east: towards 90° and 0°"""
    path = tmp_path / "points.spec"
    peak = np.array([0.0, 1.0, 0.0])
    path.write_text(wavewatch([2 * peak, peak, 0 * peak, 0 * peak]))
    sea = read_sea(path, 90.0, time="20260101 030000", location=2)
    assert np.isclose(sea.spectrum.moment(0), 3 * (np.pi / 2) * 0.02)  # by four directions and straight lines in f
    heading, weights = directions(sea, np.array([2 * np.pi * 0.1]), 90.0)
    found = np.zeros(4)
    found[np.round(np.degrees(heading) / 90).astype(int) % 4] = weights[0]
    assert np.allclose(found, np.array([1, 2, 0, 0]) / 3, atol=1e-6)
    for words, said in (
        ({}, "choose one with time"),
        ({"time": "1"}, "has no time 1"),
        ({"location": 3}, "has 2 points"),
    ):
        with pytest.raises(TableError, match=said):
            read_sea(path, 90.0, **words)
    path.write_text(wavewatch(np.ones((4, 3)))[:-30])
    with pytest.raises(TableError, match="expected: 42 for each time"):
        read_sea(path, 90.0, time="20260101 000000")


@pytest.mark.parametrize(
    "text, said",
    [
        ("hello\n", "is not a spectrum of SWAN, NDBC or WAVEWATCH III, Datawell"),
        (SWAN.format(kind="NDIR"), "directions are nautical; give the compass heading of the x axis"),
        (SWAN.format(kind="CDIR").replace("4 0 2 0", "4 0 x 0"), "line 30 .* expected: numbers, densities"),
        (SWAN.format(kind="CDIR")[:-20], "more lines, but the file ends"),
        (  # the time of the next block is no density
            SWAN.format(kind="CDIR").rstrip("0123456789 \n") + " x\n20260101.060000\nNODATA\nNODATA\n",
            "expected: numbers, densities",
        ),
    ],
)
def test_a_spoilt_file_is_named_with_its_line(tmp_path, text, said):
    path = tmp_path / "bad.spc"
    path.write_text(text)
    with pytest.raises(TableError, match=said):
        read_sea(path, location=2)
