"""Files of spectra number by number: densities, directions from and towards, times, places; systems added by hand."""

import math

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import FAMILIES, issc, tabulated
from hakobune.mooring.environment.spreading import WrappedNormal
from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.seas.families import families
from hakobune.mooring.seas.record_faults import faults
from hakobune.mooring.seas.shallow import Shallow, limited, tma
from hakobune.mooring.seas.spectra_files import read_sea, two_dimensional
from hakobune.mooring.seas.systems import Sum, Systems
from hakobune.mooring.seas.two_peaks import OneSystem, ochi_hubble, torsethaugen

HZ = 2 * math.pi
SWAN = """SWAN   1
$ a remark
{head}LOCATIONS
     2
 0.0 0.0
 5.0 5.0
AFREQ
     3
 0.1000
 0.2000 behind it
 0.3000
{quantities}"""
ONE = """QUANT
     3
VaDens
m2/Hz
  -99.0
{kind}
degr
 -999.0
{kind}SPR
degr
   -9.0
LOCATION     1
 9.0 9.0 9.0
 9.0 9.0 9.0
 9.0 9.0 9.0
LOCATION     2
 2.0 10.0 20.0
 6.0 40.0 20.0
-99.0 0.0 0.0
"""
TWO = """{kind}
     4
 {first}
 0.0
 90.0
 180.0
QUANT
     1
{name}
m2/Hz/degr
  -99.0
{times}"""
BLOCK = """{word}
{numbers}
"""


def written(tmp_path, text, name="a.spc"):
    path = tmp_path / name
    path.write_text(text)
    return path


@pytest.mark.parametrize("kind, x_axis, wanted", [("CDIR", None, 1), ("CDIR", 30.0, 1), ("NDIR", 300.0, -1)])
def test_mean_direction_and_spread_of_a_line_of_swan_are_weighed_with_the_energy(tmp_path, kind, x_axis, wanted):
    """2 and 6 m²/Hz towards 10 and 40° of the model; nautical ones come from there: towards ψ − N − 180°

    cos²ˢ(θ/2) of 20° of spread: s = 2/σ² − 1; the exception value is no energy
    """
    text = SWAN.format(head="", quantities=ONE.format(kind=kind))
    sea = read_sea(written(tmp_path, text), x_axis, location=2)
    assert sea.spectrum.omega == pytest.approx(HZ * np.array([0.1, 0.2, 0.3]))
    assert sea.spectrum.values == pytest.approx(np.array([2.0, 6.0, 0.0]) / HZ)
    angles = np.radians([10.0, 40.0]) - math.radians(x_axis or 0.0)
    if kind == "NDIR":
        angles = math.radians(x_axis) - np.radians([10.0, 40.0]) - math.pi
    mean = np.angle(2 * np.exp(1j * angles[0]) + 6 * np.exp(1j * angles[1]))
    assert np.exp(1j * sea.direction) == pytest.approx(np.exp(1j * mean), abs=1e-12)
    assert sea.spreading.s == pytest.approx(2 / math.radians(20.0) ** 2 - 1)
    with pytest.raises(TableError, match="has 2 locations, and location is 3; allowed: 1 to 2"):
        read_sea(tmp_path / "a.spc", x_axis, location=3)
    if kind == "NDIR":
        with pytest.raises(TableError, match="directions are nautical; give the compass heading of the x axis"):
            read_sea(tmp_path / "a.spc", location=2)


def test_a_line_of_swan_may_say_that_it_has_no_directions_before_its_own(tmp_path):
    plain = SWAN.format(head="", quantities=ONE.format(kind="CDIR"))
    said = plain.replace(
        "QUANT", "CDIR    spectral Cartesian directions in degr\n     0    number of directions\nQUANT"
    )
    one, two = (read_sea(written(tmp_path, text), location=2) for text in (plain, said))
    assert (two.direction, two.spreading.s) == (one.direction, one.spreading.s)
    assert two.spectrum.values.tolist() == one.spectrum.values.tolist()


def plane(tmp_path, kind="CDIR", name="VaDens", block=None, head="", times="", first=-90.0, **words):
    """A file of 3 frequencies and 4 directions; only the second location has waves"""
    numbers = "1 0 0 0\n 0 2 6 0\n0 0 0 3"
    block = BLOCK.format(word="FACTOR\n 0.5", numbers=numbers) if block is None else block
    body = TWO.format(kind=kind, first=first, name=name, times=times or "ZERO\n" + block)
    return read_sea(written(tmp_path, SWAN.format(head=head, quantities=body)), location=2, **words)


def test_a_plane_of_swan_is_summed_over_its_directions(tmp_path):
    """0.5 · numbers per Hz and degree, 90° apart: S = 45 Σ/2π m² s; shares of each over a quarter of a turn"""
    sea = plane(tmp_path)
    assert sea.spectrum.values == pytest.approx(np.array([1.0, 8.0, 3.0]) * 45 / HZ)
    at = np.radians([-90.0, 0.0, 90.0, 180.0])
    found = sea.spreading.density(at, HZ * 0.2)
    assert found == pytest.approx(np.array([0.0, 0.25, 0.75, 0.0]) / (0.5 * math.pi), abs=1e-9)
    between = sea.spreading.density(np.radians([45.0]), HZ * 0.15)  # straight in frequency and direction
    assert between == pytest.approx([0.5 * 0.5 / (0.5 * math.pi)], abs=1e-9)


def test_a_plane_of_energy_is_divided_by_the_weight_of_water(tmp_path):
    """1025 · 9.81 J/m³"""
    sea = plane(tmp_path, name="EnDens")
    assert sea.spectrum.values == pytest.approx(np.array([1.0, 8.0, 3.0]) * 45 / HZ / (1025 * 9.81))
    action = plane(tmp_path, name="AcDens")  # energy over ω
    assert action.spectrum.values == pytest.approx(np.array([1.0, 8.0, 3.0]) * 45 / HZ * action.spectrum.omega)


def test_a_plane_from_the_compass_travels_the_other_way_round(tmp_path):
    """From north (0°) with the x axis heading north: towards −x; from east (90°) towards +y, to port of north"""
    sea = plane(tmp_path, kind="NDIR", x_axis=0.0)
    found = sea.spreading.density(np.radians([180.0, 90.0, 0.0]), HZ * 0.2)
    assert found == pytest.approx(np.array([0.25, 0.75, 0.0]) / (0.5 * math.pi), abs=1e-9)
    turned = plane(tmp_path, kind="NDIR", x_axis=90.0)  # x to the east
    assert turned.spreading.density(np.radians([-90.0]), HZ * 0.2) == pytest.approx([0.25 / (0.5 * math.pi)], abs=1e-9)


def test_times_of_a_file_are_found_by_name(tmp_path):
    block = BLOCK.format(word="FACTOR\n 0.5", numbers="1 0 0 0 0 2 6 0 0 0 0 3")
    twice = BLOCK.format(word="FACTOR\n 1.0", numbers="1 0 0 0 0 2 6 0 0 0 0 3")
    times = f"20260101.000000 date\nZERO\n{block}20260101.030000 date\nNODATA\n{twice}"
    head = "TIME\n     1  coding\n"
    later = plane(tmp_path, head=head, times=times, time="20260101.030000")
    assert later.spectrum.values[1] == pytest.approx(8 * 90 / HZ)
    first = plane(tmp_path, head=head, times=times, time="20260101.000000")
    assert first.spectrum.values[1] == pytest.approx(8 * 45 / HZ)
    with pytest.raises(TableError, match=r"has several times, the first is 20260101\.000000; choose one with time"):
        plane(tmp_path, head=head, times=times)
    with pytest.raises(TableError, match=r"has no time now; it has 20260101\.000000, 20260101\.030000"):
        plane(tmp_path, head=head, times=times, time="now")
    only = plane(tmp_path, head=head, times=f"20260101.000000 date\nZERO\n{block}")
    assert only.spectrum.values[1] == pytest.approx(8 * 45 / HZ)


def test_a_direction_at_both_ends_of_a_turn_is_one():
    """−180° and 180° with equal densities, which are then those of the rows without the second; else refused"""
    omega, angle = np.array([0.5, 1.0]), np.radians([-180.0, -90.0, 0.0, 90.0])
    density = np.array([[1.0, 2.0, 3.0, 4.0], [2.0, 0.0, 1.0, 0.5]])
    plain = two_dimensional(omega, angle, density, "sea")
    closed = np.append(angle, np.pi), np.column_stack([density, density[:, 0]])
    found = two_dimensional(omega, *closed, "sea")
    np.testing.assert_allclose(found.spectrum.values, plain.spectrum.values, rtol=1e-12)
    np.testing.assert_allclose(found.spreading.density(angle, 0.5), plain.spreading.density(angle, 0.5), rtol=1e-9)
    closed[1][:, -1] *= 1.5
    with pytest.raises(ValueError, match="5 directions; allowed: at least 3, all different"):
        two_dimensional(omega, *closed, "sea")


@pytest.mark.parametrize(
    "change, says",
    [
        (("FACTOR", "FACTER"), "line 24 is 'FACTER'; expected: FACTOR, ZERO, NODATA or LOCATION"),
        (("1 0 0 0", "1 0 x 0"), "line 26 is '1 0 x 0'; expected: numbers, densities"),
        (("0 0 0 3", "0 0 3"), "expected: more lines, but the file ends"),
        (("VaDens", "HSIGN"), "the first quantity is HSIGN; allowed: VaDens, EnDens"),
        (("AFREQ\n     3\n 0.1000\n 0.2000 behind it\n 0.3000\n", ""), "has no AFREQ or RFREQ"),
        (("CDIR\n     4", "CDIR\n     0"), "line 13 is '0'; expected: the number of directions"),
        (("FACTOR\n 0.5\n1 0 0 0\n 0 2 6 0\n0 0 0 3", "NODATA"), "has no data there (NODATA)"),
        ((" 0.3000", " 0.2000"), "goes from 1.25664 to 1.25664"),
        ((" -90.0", " 180.0"), "4 directions; allowed: at least 3, all different"),
    ],
)
def test_a_fault_of_a_swan_file_has_its_line(tmp_path, change, says):
    body = TWO.format(
        kind="CDIR",
        first=-90.0,
        name="VaDens",
        times="ZERO\n" + BLOCK.format(word="FACTOR\n 0.5", numbers="1 0 0 0\n 0 2 6 0\n0 0 0 3"),
    )
    text = SWAN.format(head="", quantities=body)
    assert change[0] in text
    with pytest.raises(TableError) as refused:
        read_sea(written(tmp_path, text.replace(*change)), location=2)
    assert says in str(refused.value) and "\n" not in str(refused.value)


def test_of_source_terms_beside_densities_the_densities_are_taken(tmp_path):
    """SWAN's test output has iterations for times, and blocks of further quantities after that of the densities"""
    quantities = TWO.replace("     1\n{name}", "     2\n{name}").replace("{times}", "Swind\nm2\n0.0\n{times}")
    block = "FACTOR\n 0.5\n1 0 0 0\n 0 2 6 0\n0 0 0 3\nFACTOR\n 9.0\n1 1 1 1\n1 1 1 1\n1 1 1 1\n"
    times = f"7 iteration\nZERO\nZERO\n{block}8 iteration\nZERO\nZERO\nZERO\nZERO\n"
    body = quantities.format(kind="CDIR", first=-90.0, name="VaDens", times=times)
    path = written(tmp_path, SWAN.format(head="ITER\n 0\n", quantities=body))
    assert read_sea(path, time="7", location=2).spectrum.values == pytest.approx(
        0.5 * 90 * np.array([1.0, 8.0, 3.0]) / HZ
    )


def test_a_sector_of_directions_ends_beside_its_last_ones():
    """Four directions 10° apart: nothing travels beyond them; each inner one stands for 10°, an outer one for half"""
    angle = np.radians([350.0, 0.0, 10.0, 20.0])
    sea = two_dimensional(np.array([0.5, 1.0]), angle, np.array([[0.0, 0, 0, 0], [3.0, 2.0, 2.0, 1.0]]), "s")
    total = math.radians(10) * (0.5 * 3 + 2 + 2 + 0.5 * 1)
    assert sea.spectrum.values == pytest.approx([0.0, total], rel=2e-3)
    found = sea.spreading.density(np.radians([5.0, 20.0, 60.0, 180.0, 340.0]), 1.0)
    assert found == pytest.approx([2.0 / total, 1.0 / total, 0, 0, 0], rel=2e-3, abs=1e-9)
    even = sea.spreading.density(np.array([1.0]), 0.5)  # without energy all directions are alike
    assert even == pytest.approx([1 / (2 * math.pi)])


def test_rows_of_a_buoy_are_found_by_their_time(tmp_path):
    """m²/Hz at Hz of the head; 999 is no value, which at an end is nothing"""
    head = "#YY  MM DD hh mm  .1000  .2000  .3000  .4000\n"
    rows = "2026 01 02 03 00   1.0    4.0    0.5   999.0\n2026 01 02 04 00   2.0    8.0    6.0   1.0\n"
    path = written(tmp_path, head + rows, "a.txt")
    early, late = (read_sea(path, time=f"2026 01 02 {hour} 00") for hour in ("03", "04"))
    assert early.spectrum.omega == pytest.approx(HZ * np.array([0.1, 0.2, 0.3, 0.4]))
    assert early.spectrum.values == pytest.approx(np.array([1.0, 4.0, 0.5, 0.0]) / HZ)
    assert late.spectrum.values == pytest.approx(np.array([2.0, 8.0, 6.0, 1.0]) / HZ) and late.direction == 0.0
    with pytest.raises(TableError, match="has 2 rows; choose one"):
        read_sea(path)
    with pytest.raises(TableError, match="has 0 rows of time 2026 01 02 05 00"):
        read_sea(path, time="2026 01 02 05 00")
    short = written(tmp_path, "YY MM DD hh mm .1 .2 .3\n2026 01 02 03 00 1.0 4.0\n", "b.txt")
    with pytest.raises(TableError, match="3 frequencies and 2 densities; allowed: the same number, at least 3"):
        read_sea(short)
    with pytest.raises(TableError, match="is not a spectrum of SWAN, NDBC or WAVEWATCH III, Datawell"):
        read_sea(written(tmp_path, "hello", "c.txt"))


def wavewatch(times=("20260101 000000",), points=2, factor=(1.0,)):
    """3 frequencies, 4 directions 0, 90, 180, 270° clockwise from north; of the second point rises in direction"""
    axes = "0.1 0.2 0.3 " + " ".join(f"{math.radians(d):.8f}" for d in (0, 90, 180, 270))
    out = [f"'WAVEWATCH III SPECTRA'     3     4     {points} 'a grid'", axes]
    for time, times_of in zip(times, factor, strict=True):
        out.append(time)
        for p in range(points):
            out.append(f"'point {p}'  10.0 20.0 30.0 5.0 270.0 0.1 0.2")
            rows = [p * times_of * np.array(row) for row in ((0, 2.0, 1), (0, 6.0, 0), (1, 0, 0), (0, 0, 0))]
            out.append(" ".join(f"{value:g}" for row in rows for value in row))
    return "\n".join(out) + "\n"


def test_a_transfer_file_of_wavewatch_has_directions_towards_clockwise_from_north(tmp_path):
    """Of the x axis to the east (90°): towards north is +y, towards east +x; m²/Hz/rad over 2π, 90° apart"""
    path = written(tmp_path, wavewatch(), "ww3.txt")
    sea = read_sea(path, 90.0, location=2)
    assert sea.spectrum.omega == pytest.approx(HZ * np.array([0.1, 0.2, 0.3]))
    assert sea.spectrum.values == pytest.approx(np.array([1.0, 8.0, 1.0]) * 0.5 * math.pi / HZ, rel=1e-6)
    found = sea.spreading.density(np.radians([90.0, 0.0, -90.0]), HZ * 0.2)
    assert found == pytest.approx(np.array([0.25, 0.75, 0.0]) / (0.5 * math.pi), abs=1e-6)
    for words, says in (
        ({"x_axis": 90.0, "location": 3}, "has 2 points, and location is 3"),
        ({"location": 2}, "directions are nautical; give the compass heading of the x axis"),
    ):
        with pytest.raises(TableError, match=says):
            read_sea(path, **words)


def test_times_of_a_transfer_file_are_told_apart(tmp_path):
    two = written(tmp_path, wavewatch(("20260101 000000", "20260101 030000"), factor=(1.0, 3.0)), "ww3.txt")
    late = read_sea(two, 90.0, "20260101 030000", 2)
    assert late.spectrum.values[1] == pytest.approx(24.0 * 0.5 * math.pi / HZ, rel=1e-6)
    early = read_sea(two, 90.0, "20260101 000000", 2)
    assert early.spectrum.values[1] == pytest.approx(8.0 * 0.5 * math.pi / HZ, rel=1e-6)
    with pytest.raises(TableError, match="has 2 times, the first is 20260101 000000; choose one with time"):
        read_sea(two, 90.0)
    with pytest.raises(TableError, match="has no time 5; it has 20260101 000000, 20260101 030000"):
        read_sea(two, 90.0, "5")
    cut = written(tmp_path, wavewatch()[:-4] + "\n", "cut.txt")
    with pytest.raises(TableError, match=r"\d+ words follow the directions; expected: 42 for each time"):
        read_sea(cut, 90.0)
    word = written(tmp_path, wavewatch().replace("0.2 0.3", "0.2 abc"), "word.txt")
    with pytest.raises(TableError, match="has 'abc'; expected: numbers, the frequencies and directions"):
        read_sea(word, 90.0)
    head = written(tmp_path, wavewatch().replace("     3     4", "     x     4", 1), "head.txt")
    with pytest.raises(TableError, match="its header has 'x'"):
        read_sea(head, 90.0)


# ------------------------------------------------------------------ systems


SWELL, WIND = tabulated([0.4, 0.5, 0.6], [0.0, 8.0, 0.0]), tabulated([0.8, 1.0, 1.2], [0.0, 1.0, 0.0])  # 0.8 and 0.2 m²


def test_energies_and_directions_of_systems_add_up():
    """0.8 m² towards 0, 0.2 m² towards 90°: atan ¼; moments and densities are sums, the peak is the higher one"""
    sea = Systems((Sea(SWELL, 0.0), Sea(WIND, math.pi / 2)))
    assert sea.direction == pytest.approx(math.atan(0.25))
    assert sea.spectrum.moment(0) == pytest.approx(1.0) and sea.spectrum.peak_omega == 0.5
    assert sea.spectrum.moment(1) == pytest.approx(0.8 * 0.5 + 0.2 * 1.0)
    assert (
        sea.spectrum.density(np.array([0.45, 1.0])) == pytest.approx([4.0, 1.0])
        and sea.spectrum.name == "table + table"
    )
    headings = np.radians([0.0, 45.0, 90.0])
    assert sea.directional(headings) == pytest.approx([0.8, 0.0, 0.2])
    assert sea.directional(headings, np.array([0.5, 1.0])) == pytest.approx(np.array([[1.0, 0, 0], [0, 0, 1.0]]))
    both = Sum((SWELL, tabulated([0.4, 0.5, 0.6], [0.0, 4.0, 0.0])))
    assert both.quantile(0.5) == pytest.approx(0.5, abs=1e-4)


def test_components_of_systems_are_shared_out_by_their_widths():
    """Widths of 0.2 and 0.4 rad/s: a third and two thirds of 90; of one a tenth as wide a quarter at least"""
    sea = Systems((Sea(SWELL, 0.3), Sea(WIND, 0.9)))
    found = sea.components(90, 1)
    swell = found.omega < 0.7
    assert swell.sum() == 30 and (~swell).sum() == 60
    assert np.all(found.direction[swell] == 0.3) and np.all(found.direction[~swell] == 0.9)
    assert 0.5 * np.sum(found.amplitude[swell] ** 2) == pytest.approx(0.8, rel=5e-3)
    thin = Systems((Sea(tabulated([0.49, 0.5, 0.51], [0.0, 8.0, 0.0])), Sea(WIND)))
    counts = thin.components(100, 1).omega < 0.7
    assert counts.sum() == round(100 * 0.25 / (0.25 + 0.4 / 0.42))
    assert np.all(sea.components(90, 1, low=0.7).omega > 0.7)
    with pytest.warns(UserWarning, match="miss 12"):  # of the wind sea: above 1.1 rad/s an eighth
        assert sea.components(90, 1, high=1.1).omega.max() < 1.1


def test_families_have_their_depth():
    """Φ of 12 m and no depth for tma; the others are those of their names"""
    made = families(12.0)
    assert tuple(made) == (*FAMILIES, "tma", "ochi_hubble", "torsethaugen")
    assert made["tma"](2.0, peak_period=8.0).depth == 12.0 and made["issc"] is issc
    for depth in (None, math.inf):
        with pytest.raises(ValueError, match="tma needs a finite water depth; give the depth, or use jonswap"):
            families(depth)["tma"](2.0, peak_period=8.0)
    assert np.all(limited(np.array([0.5, 2.0]), np.inf) == 1.0) and limited(np.array([0.0]), 9.0) == 0.0
    assert isinstance(tma(2.0, 9.0, peak_period=8.0), Shallow)
    with pytest.raises(
        ValueError, match="tma: significant_period is not defined for a TMA spectrum; give peak_period or mean_period"
    ):
        tma(2.0, 9.0, significant_period=8.0)


def test_the_two_systems_of_torsethaugen_by_hand():
    """DNV-RP-C205, appendix A: H = 4 m, T_f = 6.6 · 4^(1/3) = 10.477 s

    Tp 8 s: r = 0.7 + 0.3 exp(−(2 (T_f − 8)/(T_f − 4))²), γ = 35 (2π r H/g 64)^0.857
    Tp 14 s: t = (14 − T_f)/(25 − T_f), r = 0.6 + 0.4 exp(−(t/0.3)²), γ = 35 (2π H/g T_f²)^0.857 (1 + 6 t)
    """
    H, g, full = 4.0, 9.80665, 6.6 * 4 ** (1 / 3)
    wind, swell = torsethaugen(H, peak_period=8.0).parts
    r = 0.7 + 0.3 * math.exp(-((2 * (full - 8) / (full - 4)) ** 2))
    assert wind.system.height == pytest.approx(r * H) and wind.system.shape == 0.75
    assert wind.gamma == pytest.approx(35 * (2 * math.pi * r * H / (g * 64)) ** 0.857)
    assert (swell.height, swell.shape) == pytest.approx((math.sqrt(1 - r * r) * H, 0.75))
    swell, wind = torsethaugen(H, peak_period=14.0).parts
    t = (14 - full) / (25 - full)
    r = 0.6 + 0.4 * math.exp(-((t / 0.3) ** 2))
    assert swell.system.height == pytest.approx(r * H)
    assert swell.gamma == pytest.approx(35 * (2 * math.pi * H / (g * full**2)) ** 0.857 * (1 + 6 * t))
    assert wind.height == pytest.approx(math.sqrt(1 - r * r) * H)
    for part in (torsethaugen(H, peak_period=8.0).parts[0], swell):
        assert 4 * math.sqrt(part.moment(0)) == pytest.approx(part.system.height, rel=1e-9)


def test_the_most_probable_sea_by_hand():
    """Ochi & Hubble (1976), table 2b, first row, at 3 m: ω 0.7 e^−0.138 and 1.15 e^−0.117, λ 3 and 1.54 e^−0.186"""
    swell, wind = ochi_hubble(3.0).parts
    scale = 3.0 / math.hypot(0.84, 0.54)
    assert (swell.height, swell.peak_omega, swell.shape) == pytest.approx((0.84 * scale, 0.7 * math.exp(-0.138), 3.0))
    assert (wind.height, wind.peak_omega, wind.shape) == pytest.approx(
        (0.54 * scale, 1.15 * math.exp(-0.117), 1.54 * math.exp(-0.186))
    )
    one = OneSystem(2.0, 0.6, 2.5)
    b, lam, w = 2.75 * 0.6**4, 2.5, 0.8
    wanted = 0.25 * b**lam / math.gamma(lam) * 4.0 * w ** -(4 * lam + 1) * math.exp(-b / w**4)
    assert float(one.density(w)) == pytest.approx(wanted, rel=1e-12)
    with pytest.raises(ValueError, match="the moment of order 4 is infinite at the shape parameter 1"):
        OneSystem(2.0, 0.6, 1.0).moment(4)


# ------------------------------------------------------------------ records


def waves(height=1.0, step=0.5, seconds=3600):
    t = np.arange(0, seconds, step)
    return t, height / 4 * math.sqrt(2) * np.sin(2 * math.pi * t / 6.0 + 0.1)


@pytest.mark.parametrize("spike, told", [(7.9, False), (8.1, True)])
def test_a_value_beyond_eight_deviations_is_no_wave(spike, told):
    """1.4826 times the median distance from the median"""
    _, y = waves()
    deviation = 1.4826 * np.median(np.abs(y - np.median(y)))
    y[1000] = -spike * deviation
    said = list(faults(y, 0.5, 6.0))
    assert len(said) == told and (not told or f"the largest is {y[1000]:.4g} m at 500 s" in said[0])


@pytest.mark.parametrize("share, told", [(0.0195, False), (0.0205, True)])
def test_a_level_with_a_fiftieth_of_the_variance_is_told(share, told):
    """Two levels, half of the record each: their variance over all of it"""
    t, y = waves()
    level = math.sqrt(share / (1 - share)) * y.std()
    y = y + np.where(t < 1800, level, -level)
    said = list(faults(y, 0.5, 6.0))
    assert len(said) == told and (not told or (f"moves by {2 * level:.3g} m" in said[0] and "limit 2 %" in said[0]))


@pytest.mark.parametrize("share, told", [(0.99, False), (1.01, True)])
def test_a_record_steeper_than_a_seventh_is_told(share, told):
    """4σ over g T²/2π"""
    length = 9.80665 * 36 / (2 * math.pi)
    _, y = waves(share * length / 7)
    said = list(faults(y, 0.5, 6.0))
    assert len(said) == told and (not told or "are at most 8.03 m high" in said[0])


def test_a_narrow_sea_of_systems_keeps_its_spread():
    sea = Systems((Sea(SWELL, 0.2, WrappedNormal(0.05)), Sea(WIND, 0.2)))
    share = sea.directional(np.radians([-30.0, 0.0, 30.0, 60.0]), np.array([0.5, 1.0]))
    assert share.sum(axis=1) == pytest.approx([1.0, 1.0]) and share[1, 1] == pytest.approx(1 - math.degrees(0.2) / 30)
