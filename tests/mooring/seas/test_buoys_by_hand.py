"""Spectra of buoys and of netCDF files number by number; heights of files are held against their spectra."""

import gc
import gzip
import math

import numpy as np
import pytest

from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.seas import buoys, directions
from hakobune.mooring.seas.spectra_files import read_sea

HZ = 2 * math.pi
F = np.array([0.1, 0.2, 0.3, 0.4])
S = np.array([1.0, 4.0, 2.0, 0.0])  # m²/Hz; m₀ = 0.1 (0.5 + 4 + 2) = 0.65 m² by straight lines
M0 = 0.65


def height(sea):
    return float(sea.spectrum.significant_height)


def mean(sea, omega):
    """rad, mean direction of a frequency, by a sum over one turn"""
    angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    return np.angle(sea.spreading.density(angle, omega) @ np.exp(1j * angle))


def test_the_most_even_spreading_has_the_moments_it_is_made_of():
    """Whatever a sea can have: those of 2 cos²ˢ lobes; it is nowhere negative, as their Fourier sum is"""
    rng = np.random.default_rng(1)
    lobes = directions.of_spread(rng.uniform(0, 2 * np.pi, 20), rng.uniform(0.2, 1.2, 20))
    sea = 0.7 * lobes[:10] + 0.3 * lobes[10:]
    cell = 2 * np.pi / directions.ROWS
    c1, c2 = (sea @ np.exp(1j * n * directions.ALPHA) * cell for n in (1, 2))
    made = directions.of_moments(np.abs(c1), np.abs(c2), np.angle(c1), np.angle(c2) / 2)
    assert made.min() >= 0
    np.testing.assert_allclose(made.sum(axis=1) * cell, 1, rtol=1e-12)
    np.testing.assert_allclose(made @ np.exp(1j * directions.ALPHA) * cell, c1, atol=1e-6)
    np.testing.assert_allclose(made @ np.exp(2j * directions.ALPHA) * cell, c2, atol=1e-6)
    sum_of_fourier = 0.5 + np.real(np.outer(c1.conj(), np.exp(1j * directions.ALPHA)))
    sum_of_fourier += np.real(np.outer(c2.conj(), np.exp(2j * directions.ALPHA)))
    assert sum_of_fourier.min() < 0
    unknown = directions.of_moments(np.array([np.nan]), np.array([0.2]), np.array([0.1]), np.array([0.1]))
    np.testing.assert_allclose(unknown, 1 / (2 * np.pi))


def test_a_spread_has_its_first_moment():
    """|c₁| = s/(s + 1) of cos²ˢ, s = 2/σ² − 1: 1 − σ²/2"""
    made = directions.of_spread(np.radians([200.0]), np.radians([25.0]))
    c1 = made[0] @ np.exp(1j * directions.ALPHA) * (2 * np.pi / directions.ROWS)
    assert abs(c1) == pytest.approx(1 - math.radians(25) ** 2 / 2, abs=1e-6)
    assert np.degrees(np.angle(c1)) % 360 == pytest.approx(200, abs=1e-6)


NDBC = {"w": S, "d": np.full(4, 270.0), "i": np.full(4, 270.0), "j": np.full(4, 80.0), "k": np.full(4, 50.0)}


@pytest.mark.parametrize("ending", [".txt", ".txt.gz"])
def test_moments_beside_a_year_of_ndbc_are_its_directions(tmp_path, ending):
    """From 270° (west), of an x axis to the north: towards −y; r₁, r₂ are hundredths, 0.8 and 0.5"""
    for letter, values in NDBC.items():
        text = (
            "#YY  MM DD hh mm" + "".join(f"  {f:.4f}" for f in F) + "\n2026 01 02 03 00 " + " ".join(map(str, values))
        )
        data = (text + "\n").encode()
        (tmp_path / f"41010{letter}2026{ending}").write_bytes(gzip.compress(data) if ending == ".txt.gz" else data)
    path = tmp_path / f"41010w2026{ending}"
    sea = read_sea(path, 0.0)
    assert height(sea) == pytest.approx(4 * math.sqrt(M0))
    assert mean(sea, HZ * 0.2) == pytest.approx(-math.pi / 2, abs=1e-6)
    angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    assert sea.spreading.density(angle, HZ * 0.2) @ np.cos(angle + np.pi / 2) / 720 * 2 * np.pi == pytest.approx(
        0.8, abs=1e-3
    )
    assert read_sea(path).spreading is None  # without an x axis directions have none
    with pytest.raises(
        TableError, match=r"contains directions or moments; give the file of spectral densities of the same buoy, w…"
    ):
        read_sea(tmp_path / f"41010d2026{ending}")
    (tmp_path / f"41010k2026{ending}").unlink()
    assert read_sea(path, 0.0).spreading is None


def test_moments_beside_the_last_days_of_ndbc_are_its_directions(tmp_path):
    def row(values, head="", name="spec"):
        pairs = " ".join(f"{v} ({f})" for v, f in zip(values, F, strict=True))
        return f"#YY MM DD hh mm {name}_1 (freq_1)\n2026 01 02 03 00 {head}{pairs}"

    (tmp_path / "a.data_spec").write_text(row(S, "0.2 ") + "\n")
    for ending, value in ((".swdir", 90.0), (".swdir2", 90.0), (".swr1", 0.6), (".swr2", 0.3)):
        values = np.full(4, value)
        values[3] = 999.0
        (tmp_path / f"a{ending}").write_text(row(values, name="alpha1" if "dir" in ending else "r1") + "\n")
    sea = read_sea(tmp_path / "a.data_spec", 90.0, "2026 01 02 03 00")
    assert height(sea) == pytest.approx(4 * math.sqrt(M0))
    assert abs(mean(sea, HZ * 0.2)) == pytest.approx(math.pi, abs=1e-6)  # from where x heads
    assert sea.spreading.density(np.array([0.3]), HZ * 0.4) == pytest.approx(1 / HZ, rel=1e-6)  # 999: all alike
    for ending in (".swdir", ".swr1"):
        with pytest.raises(TableError, match="contains directions or moments"):
            read_sea(tmp_path / f"a{ending}")
    (tmp_path / "b.txt").write_text("#YY  MM DD hh mm WVHT  DPD  APD MWD\n2026 01 02 03 00 1.1 8 6 200\n")
    with pytest.raises(TableError, match=r"no densities by frequency but heights and periods \(WVHT, DPD, APD, MWD\)"):
        read_sea(tmp_path / "b.txt")


def test_wavesmon_has_slices_of_directions_or_roots_of_densities(tmp_path):
    head = "% Directional Spectrum\n% from 2 to 3\n%\n% 4 Directions and 4 Frequencies\n"
    bands = "% Frequency Bands are 0.1 Hz wide(first frequency band is centered at 0.1)\n"
    rows = "".join(f" 0 {1e6 * s / 90:.4f} 0 0\n" for s in S)
    (tmp_path / "DSpec2601010000.txt").write_text(
        f"{head}{bands}% The first direction slice begins at 315 degrees\n{rows}"
    )
    sea = read_sea(tmp_path / "DSpec2601010000.txt", 0.0)  # slices of 90° about 0°, 90°, …
    assert height(sea) == pytest.approx(4 * math.sqrt(M0), rel=1e-6)
    assert mean(sea, HZ * 0.2) == pytest.approx(math.pi / 2, abs=1e-6)
    (tmp_path / "SSpec.txt").write_text("%\n% 4 Frequencies\n" + bands + "".join(f" {1e3 * s**0.5:.6f}\n" for s in S))
    assert height(read_sea(tmp_path / "SSpec.txt")) == pytest.approx(4 * math.sqrt(M0), rel=1e-6)


def test_a_history_of_datawell_is_no_spectrum_and_told(tmp_path):
    row = "2026-01-01T00:30:00.000Z,11.1,213,28,6.1,245,7,6,5,8,9,10.8,0.4,0.8,1.9,0.04,19,18,4"
    (tmp_path / "a.his").write_text(row + "\n")
    with pytest.raises(TableError, match=r"a height of 2.45 m and a peak period of 11.1 s from 213°; give these"):
        read_sea(tmp_path / "a.his", 0.0, "2026-01-01 00:30")


def spt(hm0):
    rows = "\n".join(f"{f:.3f},{s / 4:.4E},180.0,30.0,0.1,2.0" for f, s in zip(F, S, strict=True))
    return f"10\n{100 * hm0:.1f}\n4.5\n4.0\n25.1\n19.7\n7\n-0.2\n0.4\n0.3\n213.8\n68.2\n{rows}\n"


def test_a_spt_of_datawell_is_a_share_of_its_largest_density(tmp_path):
    path = tmp_path / "a.spt"
    path.write_text(spt(4 * math.sqrt(M0)))
    sea = read_sea(path, 180.0)
    assert height(sea) == pytest.approx(4 * math.sqrt(M0))
    assert abs(mean(sea, HZ * 0.2)) == pytest.approx(math.pi, abs=1e-6)
    path.write_text(spt(1.15 * 4 * math.sqrt(M0)))
    with pytest.raises(
        TableError, match=r"4√m₀ of its spectrum is 3.225 m, but the significant height in the file is 3.709 m"
    ):
        read_sea(path, 180.0)
    path.write_text(spt(3.0).replace("25.1", "25.1,1"))
    with pytest.raises(TableError, match="is not a spectrum of SWAN, NDBC or WAVEWATCH III, Datawell"):
        read_sea(path, 180.0)


def test_triaxys_without_and_with_directions(tmp_path):
    head = "TRIAXYS BUOY DATA REPORT - by hand\nTYPE = SPECTRUM\nDATE    = 2026-01-31 21:00(UTC)\n"
    head += "INITIAL FREQUENCY (Hz)             =   0.000\nFREQUENCY SPACING (Hz)             =   0.100\n"
    plain = head + "".join(f"{f:.3f}  {s:.7E}\n" for f, s in zip([0.0, *F], [0.0, *S], strict=True))
    (tmp_path / "a.NONDIRSPEC").write_text(plain)
    assert height(read_sea(tmp_path / "a.NONDIRSPEC")) == pytest.approx(4 * math.sqrt(M0))
    head += "DIRECTION SPACING (DEG)            =      90\n"
    rows = "".join(f" 0.0 {s / 90:.8E} 0.0 0.0 0.0\n" for s in (0.0, *S))  # all of it from 90°; 0 and 360° are one
    (tmp_path / "a.DIRSPEC").write_text(head + rows)
    sea = read_sea(tmp_path / "a.DIRSPEC", 0.0)
    assert height(sea) == pytest.approx(4 * math.sqrt(M0), rel=1e-6)
    assert mean(sea, HZ * 0.2) == pytest.approx(math.pi / 2, abs=1e-6)  # towards west, of x to the north +y
    with pytest.raises(TableError, match="directions are nautical; give the compass heading of the x axis"):
        read_sea(tmp_path / "a.DIRSPEC")


def test_a_row_of_spotter_is_found_by_its_time(tmp_path):
    names = ("f", "varianceDensity", "direction", "directionalSpread")
    head = "Epoch Time ,Significant Wave Height (m) ," + ",".join(f"{name}_{i} " for name in names for i in range(4))
    values = [F, S, np.full(4, 45.0), np.full(4, 30.0)]
    row = ",".join(f" {v:.5f}" for part in values for v in part)
    (tmp_path / "a.csv").write_text(f"{head}\n1632834721 , {4 * math.sqrt(M0):.3f} ,{row}\n1632834000 ,9.0 ,{row}\n")
    sea = read_sea(tmp_path / "a.csv", 45.0, "2021-09-28T13:12")
    assert height(sea) == pytest.approx(4 * math.sqrt(M0))
    assert abs(mean(sea, HZ * 0.2)) == pytest.approx(math.pi, abs=1e-6)
    with pytest.raises(TableError, match="several times; it has 2 times from 2021-09-28T13:12 to 2021-09-28T13:00"):
        read_sea(tmp_path / "a.csv", 45.0)
    with pytest.raises(TableError, match="the significant height in the file is 9 m"):
        read_sea(tmp_path / "a.csv", 45.0, "2021-09-28T13:00")


FROM = np.array([0.0, 90.0, 180.0, 270.0])


def planes(xarray, tmp_path):
    """{name: (file, time, place)} of the sea with all its energy from 90°, as each program writes it"""
    plane = np.outer(S, FROM == 90) / (math.pi / 2)  # m²/Hz/rad
    two = np.stack([0 * plane, plane])[:, None]  # times
    f, time = ("frequency", F, {"units": "s-1"}), ("time", np.array(["2026-01-01", "2026-01-02"], "datetime64[ns]"))
    axes = ("time", "station", "frequency", "direction")
    made = {
        "ww3": {"efth": (axes, two, {"units": "m2 s rad-1"}), "frequency": f, "time": time,
                "direction": ("direction", (FROM + 180) % 360,
                              {"units": "degree", "standard_name": "sea_surface_wave_to_direction"})},
        "swan": {"density": (axes, two, {"units": "m2 s rad-1"}), "frequency": f, "time": time,
                 "direction": ("direction", np.radians(FROM),
                               {"units": "radians", "standard_name": "sea_surface_wave_from_direction"}),
                 "hs": (("time", "station"), [[0.0], [4 * math.sqrt(M0)]])},
        "wavespectra": {"efth": (("time", "station", "freq", "dir"), np.radians(two), {"units": "m^{2}.s.degree^{-1}"}),
                        "freq": ("freq", F), "dir": ("dir", FROM), "time": time},
    }  # fmt: skip
    sigma, two = HZ * F, np.stack([0 * plane, plane])
    made["wwm"] = {
        "AC": (("ocean_time", "ndir", "nfreq", "nbstation"), (two / HZ / sigma[:, None]).swapaxes(1, 2)[..., None]),
        "spsig": ("nfreq", sigma), "spdir": ("ndir", np.radians(270 - FROM)),  # anticlockwise from east, towards
        "ocean_time": ("ocean_time", time[1]), "HS": (("ocean_time", "nbstation"), [[0.0], [4 * math.sqrt(M0)]]),
    }  # fmt: skip
    for name, variables in made.items():
        engine = "scipy" if name == "ww3" else "h5netcdf"
        xarray.Dataset(variables).to_netcdf(tmp_path / f"{name}.nc", engine=engine)
    return made


@pytest.fixture(scope="module")
def xarray():
    return pytest.importorskip("xarray")


def test_planes_in_netcdf_are_read_by_the_names_of_their_programs(xarray, tmp_path):
    for name in planes(xarray, tmp_path):
        sea = read_sea(tmp_path / f"{name}.nc", 0.0, "2026-01-02")
        assert height(sea) == pytest.approx(4 * math.sqrt(M0), rel=1e-6), name
        assert mean(sea, HZ * 0.2) == pytest.approx(math.pi / 2, abs=1e-6), name
        with pytest.raises(TableError, match="several times; it has 2 times from 2026-01-01T00:00"):
            read_sea(tmp_path / f"{name}.nc", 0.0)
    with pytest.raises(TableError, match="has 1 locations, and location is 2"):
        read_sea(tmp_path / "ww3.nc", 0.0, "2026-01-02", location=2)
    with pytest.raises(TableError, match="directions are nautical; give the compass heading of the x axis"):
        read_sea(tmp_path / "ww3.nc", None, "2026-01-02")
    data = xarray.open_dataset(tmp_path / "swan.nc").load()
    data["hs"][:] = 1.0
    data.to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with pytest.raises(TableError, match="the significant height in the file is 1 m"):
        read_sea(tmp_path / "other.nc", 0.0, "2026-01-02")


def test_era5_has_logarithms_and_numbers_for_frequencies_and_directions(xarray, tmp_path):
    """The 12th frequency is 0.03453 × 1.1¹¹ Hz, the first direction 7.5° towards, the second place has no waves"""
    log = np.full((1, 30, 24, 1, 2), np.nan)
    log[0, 11, 0, 0, 0] = 1.0  # 10 m² s/rad
    axes = ("time", "frequency", "direction", "latitude", "longitude")
    data = xarray.Dataset({"d2fd": (axes, log)}, {"time": np.array(["2026-01-01"], "datetime64[ns]")})
    data.to_netcdf(tmp_path / "era5.nc", engine="scipy")
    sea = read_sea(tmp_path / "era5.nc", 0.0)
    f = 0.03453 * 1.1 ** np.arange(30)
    assert sea.spectrum.omega == pytest.approx(HZ * f)
    m0 = 10 * math.radians(15) * 0.5 * (f[12] - f[10])
    assert height(sea) == pytest.approx(4 * math.sqrt(m0), rel=1e-6)
    assert mean(sea, HZ * f[11]) == pytest.approx(-math.radians(7.5), abs=1e-6)
    with pytest.raises(TableError, match="no data there"):
        read_sea(tmp_path / "era5.nc", 0.0, location=2)
    with pytest.raises(TableError, match="2 locations, and location is 3"):
        read_sea(tmp_path / "era5.nc", 0.0, location=3)


@pytest.mark.filterwarnings("error::pytest.PytestUnraisableExceptionWarning")
def test_integrals_in_netcdf_are_no_spectrum_and_told(xarray, tmp_path):
    one = {name: (("time",), [value]) for name, value in (("swh", 2.5), ("pp1d", 9.0), ("mwd", 270.0))}
    xarray.Dataset(one, {"time": np.array(["2026-01-01"], "datetime64[ns]")}).to_netcdf(tmp_path / "a.nc")
    with pytest.raises(TableError, match=r"no spectrum .* but swh 2.5 m high, pp1d 9 s of peak, mwd 270 ° from: give"):
        read_sea(tmp_path / "a.nc", 0.0)
    for engine in ("scipy", "h5netcdf"):
        xarray.Dataset(one).to_netcdf(tmp_path / "b.nc", engine=engine)
        (tmp_path / "cut.nc").write_bytes((tmp_path / "b.nc").read_bytes()[:200])
        with pytest.raises(TableError, match=r"cut\.nc: cannot be read"):
            read_sea(tmp_path / "cut.nc", 0.0)
        gc.collect()  # of a file that is half open h5netcdf would print where it fails to close it


def test_the_netcdf_of_a_buoy_has_moments(xarray, tmp_path):
    axes = ("time", "frequency")
    names = ("spectral_wave_density", "mean_wave_dir", "principal_wave_dir", "wave_spectrum_r1", "wave_spectrum_r2")
    values = (S, 180 + 0 * S, 180 + 0 * S, 0.5 + 0 * S, 0.2 + 0 * S)
    data = {name: (axes, [value]) for name, value in zip(names, values, strict=True)}
    coords = {"frequency": F, "time": np.array(["2026-01-01"], "datetime64[ns]")}
    xarray.Dataset(data, coords).to_netcdf(tmp_path / "a.nc")
    sea = read_sea(tmp_path / "a.nc", 0.0)
    assert height(sea) == pytest.approx(4 * math.sqrt(M0))
    assert mean(sea, HZ * 0.2) == pytest.approx(0, abs=1e-6)
    assert read_sea(tmp_path / "a.nc").spreading is None
    others = (
        {"variance_density": S, "a1": 0 * S, "b1": 0.5 + 0 * S, "a2": -0.2 + 0 * S, "b2": 0 * S},  # Sofar, to north
        {"energy_1d": S, "theta_1d": 180 + 0 * S, "spread_1d": 30 + 0 * S},  # SWAN, from south
    )
    for quantities in others:
        xarray.Dataset({name: (axes, [value]) for name, value in quantities.items()}, coords).to_netcdf(
            tmp_path / "b.nc"
        )
        sea = read_sea(tmp_path / "b.nc", 0.0)
        assert height(sea) == pytest.approx(4 * math.sqrt(M0))
        assert mean(sea, HZ * 0.2) == pytest.approx(0, abs=1e-6)


def test_spectra_of_wavesmon_are_millimetres_of_each_band_and_slices_that_begin_at_an_angle(monkeypatch):
    """mm/√Hz: 2000 → 4 m²/Hz; mm²/Hz a degree: 5e5 → 0.5 m²/Hz; slices from 10°, 130° and 250° on"""
    for name in ("_plain", "_plane"):
        monkeypatch.setattr(buoys, name, lambda *given: given[1:])
    head = "% 3 Frequency Bands are 0.02 Hz wide (first frequency band is centered at 0.05 )\n"
    frequency, density = buoys.trdi("a.txt", head + "2000 1000\n500\n", None, None)
    assert frequency == pytest.approx([0.05, 0.07, 0.09])
    assert density == pytest.approx([4.0, 1.0, 0.25])
    slices = head + "% the first direction slice begins at 10 degrees\n5e5 1e5 0\n0 2e5 1e6\n"
    assert buoys.kind(slices) is buoys.trdi
    frequency, direction, density = buoys.trdi("a.txt", slices, 90.0, None)
    assert frequency == pytest.approx([0.05, 0.07])
    assert np.degrees(direction) == pytest.approx(90.0 - np.array([70.0, 190.0, 310.0]) - 180.0)  # middles of slices
    assert np.radians(density) == pytest.approx(np.array([[0.5, 0.1, 0.0], [0.0, 0.2, 1.0]]))
    for text in ("% no bands\n1 2\n", head + "1 a\n"):
        with pytest.raises(
            buoys.TableError, match="a WavesMon file states its frequency bands, then gives numbers; this file does not"
        ):
            buoys.trdi("a.txt", text, None, None)


def test_a_row_of_ndbc_that_lacks_its_swell_is_not_a_lower_sea(tmp_path):
    """999 stands for none: beyond the measured band it is nothing, within it or in a whole row it is told"""
    path = tmp_path / "46022w2005.txt"
    head = "YYYY MM DD hh" + "".join(f"  {f:.4f}" for f in F)
    rows = {"00": (*S[:3], 999.0), "01": (S[0], 999.0, *S[2:]), "02": (999.0,) * 4}
    path.write_text(
        "\n".join([head, *(f"2005 12 14 {hour} " + " ".join(map(str, row)) for hour, row in rows.items())]) + "\n"
    )
    assert height(read_sea(path, time="2005 12 14 00")) == pytest.approx(4 * math.sqrt(M0))
    with pytest.raises(TableError, match=r"row of 2005 12 14 01 has 1 densities of 999.* from 0\.\d+ to 0\.\d+ Hz"):
        read_sea(path, time="2005 12 14 01")
    with pytest.raises(TableError, match="row of 2005 12 14 02 has no measured density, all are 999; choose another"):
        read_sea(path, time="2005 12 14 02")
    with pytest.raises(TableError, match=r"has 3 rows; choose one with time = .*, of 2005 12 14 00 to 2005 12 14 02"):
        read_sea(path)
