"""Spectra of netCDF by their variables: axes, units, directions and moments of each source, made in memory."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray

from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.seas import directions, netcdf
from hakobune.mooring.seas.swan import Swan

PATH = Path("x.nc")


def dataset(name, dims, values, coords=None, **attrs):
    return xarray.Dataset({name: (dims, np.asarray(values, float), attrs)}, coords or {})


@pytest.mark.parametrize(
    "units, factor", [("m^2 s / deg", 180 / math.pi), ("m2 s/degree", 180 / math.pi), ("m2 s", 1.0)]
)
def test_densities_per_degree_are_turned_to_radians(units, factor):
    """Only of planes; a spectrum of frequency alone has no such unit"""
    name = next(one for one in netcdf.DENSITIES if one not in ("d2fd", "AC"))
    f, d = (next(axis for axis, kind in netcdf.AXES.items() if kind == which) for which in "fd")
    data = dataset(name, (d, f), [[1.0, 2.0, 3.0]] * 2, {f: [0.1, 0.2, 0.3], d: [0.0, 90.0]}, units=units)
    values, frequency, old = netcdf._renamed(PATH, data, name)
    assert values.transpose("f", "d").values[:, 0] == pytest.approx(factor * np.array([1.0, 2.0, 3.0]))
    assert frequency.tolist() == [0.1, 0.2, 0.3] and old == {"f": f, "d": d}
    alone = dataset(name, (f,), [1.0, 2.0, 3.0], {f: [0.1, 0.2, 0.3]}, units=units)
    assert netcdf._renamed(PATH, alone, name)[0].values.tolist() == [1.0, 2.0, 3.0]
    with pytest.raises(TableError, match=f"x.nc: {name} has the axes {f}, station; allowed: frequency and direction"):
        netcdf._renamed(PATH, dataset(name, (f, "station"), np.ones((3, 2))), name)
    assert netcdf._renamed(PATH, dataset(name, (f, "station"), np.ones((3, 2)), {f: [1, 2, 3]}), name, ("station",))


def test_a_plane_of_an_unknown_layout_is_refused_with_its_name():
    """Its unit and the sense of its directions are nowhere; a spectrum of frequency alone is none of these"""
    data = dataset("spectral_density", ("time_index", "frequency", "direction"), np.ones((1, 2, 2)))
    with pytest.raises(TableError, match="spectral_density has frequencies and directions, but in an unknown layout"):
        netcdf._density(PATH, data)
    with pytest.raises(TableError, match=r"x\.nc has no spectrum"):
        netcdf._density(PATH, dataset("spectral_density", ("time_index", "frequency"), np.ones((1, 2))))


def test_bytes_of_metocean_are_unpacked_by_the_factor_of_their_time_and_site():
    """(byte + 127) factor, m² s/degree; nothing at −127"""
    packed = np.array([-127, -126, 0, 127], np.int8).reshape(1, 2, 2, 1)
    data = xarray.Dataset(
        {"specden": (("time", "site", "freq", "dir"), packed, {"units": "norm_byte"}),
         "factor": (("time", "site"), [[2.0, 0.5]])},
        {"freq": [0.1, 0.2], "dir": ("dir", [90.0], {"units": "deg from"})},
    )  # fmt: skip
    assert netcdf._density(PATH, data) == "specden"
    values, frequency, old = netcdf._renamed(PATH, data, "specden", ("time", "site"))
    expected = 180 / math.pi * np.array([[0.0, 2.0], [63.5, 127.0]])
    assert values.transpose("time", "site", "f", "d").values[0, :, :, 0] == pytest.approx(expected)
    assert frequency.tolist() == [0.1, 0.2]
    assert netcdf._towards(data, "specden", old["d"]) == pytest.approx(1.5 * math.pi)


def test_a_plane_of_era5_is_a_logarithm_at_its_own_frequencies_and_directions():
    """log₁₀; f₁ qⁿ; sectors from north, clockwise, towards, in their middles"""
    f, d = (next(axis for axis, kind in netcdf.AXES.items() if kind == which and axis.lower().startswith(start))
            for which, start in (("f", "freq"), ("d", "dir")))  # fmt: skip
    data = dataset("d2fd", (f, d), np.log10([[1.0, 10.0], [100.0, 1000.0]]))
    values, frequency, old = netcdf._renamed(PATH, data, "d2fd")
    assert values.values == pytest.approx(np.array([[1.0, 10.0], [100.0, 1000.0]]))
    assert frequency == pytest.approx(netcdf.ERA5[0] * np.array([1.0, netcdf.ERA5[1]]))
    assert netcdf._towards(data, "d2fd", old["d"]) == pytest.approx([math.pi / 2, 3 * math.pi / 2])


@pytest.mark.parametrize("attrs, wanted", [
    ({"units": "degree", "standard_name": "sea_surface_wave_to_direction"}, math.radians(30)),
    ({"units": "degree", "standard_name": "sea_surface_wave_from_direction"}, math.radians(210)),
    ({"units": "radian", "standard_name": "sea_surface_wave_to_direction"}, 30.0), ({}, math.radians(210)),
])  # fmt: skip
def test_angles_say_their_unit_and_whether_waves_go_or_come(attrs, wanted):
    assert netcdf._clockwise(xarray.DataArray([30.0], attrs=attrs)) == pytest.approx([wanted])


@pytest.fixture
def spread(monkeypatch):
    """What a spreading is made of"""
    asked = {}
    monkeypatch.setattr(directions, "of_moments", lambda *given: asked.update(moments=given) or "of moments")
    monkeypatch.setattr(directions, "of_spread", lambda *given: asked.update(spread=given) or "of spread")
    monkeypatch.setattr(netcdf.buoys, "_plain", lambda *given: ("plain", *given))
    monkeypatch.setattr(netcdf.buoys, "_spread", lambda *given: ("spread", *given))
    return asked


ORDER, DENSITY, FREQUENCY = np.array([1, 0]), np.array([5.0, 7.0]), np.array([0.1, 0.2])


def measured(names, columns, x_axis=30.0, **attrs):
    data = xarray.Dataset({name: ("f", column, attrs) for name, column in zip(names, columns, strict=True)})
    return netcdf._measured(PATH, data, FREQUENCY, ORDER, DENSITY, x_axis)


def test_a_measured_sea_has_the_moments_of_its_source(spread):
    """NDBC: r₁, r₂ and angles from, degrees; Fourier: c = a + ib anticlockwise from east, towards; means and spreads"""
    kind, path, frequency, density, what, x_axis = measured(netcdf.NDBC, ([90, 180], [10, 20], [0.5, 0.6], [0.2, 0.3]))
    assert (kind, path, what, x_axis) == ("spread", PATH, "of moments", 30.0)
    assert density.tolist() == [7.0, 5.0] and frequency is FREQUENCY
    r1, r2, one, two = spread["moments"]
    assert r1.tolist() == [0.6, 0.5] and r2.tolist() == [0.3, 0.2]
    assert one == pytest.approx([math.pi, math.pi / 2]) and two == pytest.approx(np.radians([20, 10]))
    columns = ([0.3, 0.0], [0.4, 0.5], [0.0, 0.1], [0.2, 0.0])
    measured(netcdf.MOMENTS, columns)
    r1, r2, one, two = spread["moments"]
    assert r1 == pytest.approx([0.5, 0.5]) and r2 == pytest.approx([0.1, 0.2])
    assert one == pytest.approx([math.pi, 1.5 * math.pi - math.atan2(0.4, 0.3)])
    assert two == pytest.approx([1.5 * math.pi, 1.5 * math.pi - math.pi / 4])
    *_, what, _ = measured(netcdf.MEANS, ([90.0, 180.0], [20.0, 30.0]), units="degree")
    alpha, width = spread["spread"]
    assert what == "of spread" and alpha == pytest.approx([math.pi, math.pi / 2])
    assert width == pytest.approx(np.radians([30.0, 20.0]))


def test_a_measured_sea_without_directions_or_axes_has_long_crests(spread):
    for found in (measured((), ()), measured(netcdf.NDBC, [[1.0, 2.0]] * 4, None)):
        assert found[:3] == ("plain", PATH, FREQUENCY) and found[3].tolist() == [7.0, 5.0]
    assert not spread


@pytest.mark.parametrize("location, place", [(1, (0, 0)), (3, (0, 2)), (4, (1, 0)), (6, (1, 2)), (0, None), (7, None)])
def test_places_are_counted_with_the_last_axis_fastest(location, place):
    f = next(axis for axis, kind in netcdf.AXES.items() if kind == "f")
    data = dataset("E", ("lat", "lon", f), np.arange(12.0).reshape(2, 3, 2))
    if place is None:
        with pytest.raises(TableError, match=f"x.nc has 6 locations, and location is {location}; allowed"):
            netcdf._at_place(PATH, data, "E", location)
    else:
        found = netcdf._at_place(PATH, data, "E", location)["E"]
        assert found.dims == (f,) and found.values.tolist() == data["E"].values[place].tolist()


def test_a_time_is_chosen_by_its_minute_and_one_place_of_all_hours_is_needed(monkeypatch):
    axis = netcdf.TIMES[0]
    hours = np.array(["2020-01-01T00:00", "2020-01-01T01:00"], "datetime64[ns]")
    data = dataset("E", (axis,), [1.0, 2.0], {axis: hours})
    assert netcdf._at_time(PATH, data, " 2020-01-01 01:00 ")["E"].item() == 2.0
    still = dataset("E", ("f",), [1.0])
    assert netcdf._at_time(PATH, still, "whatever") is still


def test_a_file_without_a_spectrum_names_the_integrals_that_it_has():
    data = xarray.Dataset({"swh": 2.345678, "mwd": ("t", [1.0, 2.0])})
    with pytest.raises(TableError) as refused:
        netcdf._density(PATH, data)
    assert str(refused.value).endswith("but swh 2.346 m high: give height, a period and a direction")
    with pytest.raises(TableError) as refused:
        netcdf._density(PATH, xarray.Dataset())
    assert str(refused.value).endswith(")")


@pytest.mark.parametrize("lines, read, none", [
    ("0 number of directions\nQUANT\n", 1, True), ("2 directions\n10.0\n20.0\n", 0, False),
    ("0 directions\n 10.0\n", 0, False), ("1 directions\nQUANT\n", 0, False),
])  # fmt: skip
def test_a_file_of_swan_of_one_dimension_lists_no_directions(lines, read, none):
    one = Swan(PATH, f"$ a remark\n{lines}")
    assert one.none_follows() is none and one.at == read


def test_planes_of_all_hours_are_read_a_few_at_a_time_with_frequencies_that_rise(monkeypatch):
    """Three hours of two stations of WAVEWATCH III, two at a time; the second hour is missing, a value of the third"""
    hours = np.array(["2020-01-01T00", "2020-01-01T01", "2020-01-01T02"], "datetime64[ns]")
    values = np.arange(24.0).reshape(3, 2, 2, 2)
    values[1, 1], values[2, 1, 0, 0] = np.nan, np.nan
    data = xarray.Dataset(
        {"efth": (("time", "station", "frequency", "direction"), values, {"units": "m2 s rad-1"})},
        {"time": hours, "frequency": [0.2, 0.1],
         "direction": ("direction", [0.0, 90.0], {"standard_name": "sea_surface_wave_to_direction"})},
    )  # fmt: skip
    monkeypatch.setattr(xarray, "open_dataset", lambda path: data)
    monkeypatch.setattr(netcdf, "AT_ONCE", 2)
    parts = list(netcdf.planes_of(PATH, 2))
    assert [part[0].astype(str).tolist() for part in parts] == [["2020-01-01T00:00:00", "2020-01-01T01:00:00"],
                                                                ["2020-01-01T02:00:00"]]  # fmt: skip
    for _, frequency, towards, density in parts:
        assert frequency.tolist() == [0.1, 0.2] and towards == pytest.approx([0.0, math.pi / 2])
        assert density.dtype == np.float32
    assert parts[0][3][0].tolist() == [[6.0, 7.0], [4.0, 5.0]] and np.isnan(parts[0][3][1]).all()
    assert parts[1][3][0].tolist() == [[22.0, 23.0], [0.0, 21.0]]
    with pytest.raises(TableError, match=r"x\.nc has 2 locations; choose one by its number with location"):
        list(netcdf.planes_of(PATH, None))
    alone = data.isel(station=0, drop=True)
    monkeypatch.setattr(xarray, "open_dataset", lambda path: alone)
    assert next(netcdf.planes_of(PATH, None))[3][0].tolist() == [[2.0, 3.0], [0.0, 1.0]]
    for lacks in (alone.isel(time=0, drop=True), alone.isel(direction=0, drop=True)):
        monkeypatch.setattr(xarray, "open_dataset", lambda path, lacks=lacks: lacks)
        with pytest.raises(TableError, match="allowed: a time, frequencies and directions"):
            next(netcdf.planes_of(PATH, None))
