"""Spectra in netCDF, identified by the names and units of variables that each program writes.

    WAVEWATCH III   efth(time, station, frequency, direction) m² s/rad, directions towards
    ERA5            d2fd(time, frequency, direction, place): log₁₀ of m² s/rad; 30 frequencies from 0.03453 Hz, each
                    1.1 times the one before; 24 directions towards, from 7.5°
    SWAN            density(time, points, frequency, direction) m² s/rad, directions in rad from (or towards); in one
                    dimension energy_1d m² s, theta_1d and spread_1d degrees
    WWM             AC(ocean_time, ndir, nfreq, nbstation) m² s²/rad, action: spsig times it is energy by spsig rad/s
                    and spdir rad, anticlockwise from east, towards
    wavespectra     efth(…, freq, dir) m² s/degree, directions from
    MetOcean        specden(time, site, freq, dir) in bytes, plus 127 and times factor(time, site) m² s/degree, from
    Sofar           variance_density(time, frequency) m² s, moments a1, b1, a2, b2 anticlockwise from east, towards
    NDBC            spectral_wave_density(time, frequency) m²/Hz, mean_wave_dir, principal_wave_dir, wave_spectrum_r1,
                    wave_spectrum_r2

Directions are clockwise from north. Waves travel towards them if the standard name has "to_direction"; otherwise
waves come from them.
"""

import numpy as np

from ..environment.tables import TableError
from . import buoys, directions

DENSITIES = ("efth", "d2fd", "density", "spectral_wave_density", "AC", "variance_density", "energy_1d", "specden")
AXES = dict.fromkeys(("frequency", "freq", "frequencyNumber", "nfreq"), "f") | dict.fromkeys(
    ("direction", "dir", "directionNumber", "ndir"), "d"
)
TIMES = ("time", "valid_time", "ocean_time")
AT_ONCE = 4096  # hours of planes that are in memory together
HEIGHTS = ("hs", "swh", "VHM0", "HS")
MOMENTS = ("a1", "b1", "a2", "b2")
MEANS = ("theta_1d", "spread_1d")
NDBC = ("mean_wave_dir", "principal_wave_dir", "wave_spectrum_r1", "wave_spectrum_r2")
ERA5 = 0.03453, 1.1  # Hz, and ratio of successive frequencies (ECMWF, 2D wave spectra)
INTEGRALS = {"swh": "m high", "hs": "m high", "VHM0": "m high", "pp1d": "s of peak", "mwp": "s mean", "mwd": "° from"}


def read_netcdf(path, x_axis, time, location):
    """Sea of one time and place, as in `spectra_files.read_sea`.  Raises TableError."""
    try:
        import xarray
    except ImportError:
        raise TableError(f"{path} is netCDF; pip install 'hakobune[xarray]' to read it") from None
    try:
        if path.open("rb").read(4) == b"\x89HDF":
            import h5py

            h5py.File(path).close()  # fails here on a truncated file; h5netcdf would print a traceback
        with xarray.open_dataset(path) as data:
            return _sea(path, data, x_axis, time, location)
    except TableError:
        raise
    except Exception as error:
        raise TableError(
            f"{path}: cannot be read ({str(error).splitlines()[0] if str(error) else type(error)})"
        ) from None


def _sea(path, data, x_axis, time, location):
    name = _density(path, data)
    data = _at_place(path, _at_time(path, data, time), name, location)
    values, frequency, old = _renamed(path, data, name)
    if not np.any(np.isfinite(values)):
        raise TableError(f"{path} has no data there (all of {name} is missing); choose another time or location")
    frequency, order = np.sort(frequency), np.argsort(frequency)
    if "d" not in values.dims:
        return _measured(path, data, frequency, order, np.nan_to_num(np.asarray(values, float)), x_axis)
    density = np.nan_to_num(np.asarray(values.transpose("f", "d"), float))[order]
    if x_axis is None:
        raise buoys._no_axis(path)
    sea = buoys._plane(path, frequency, np.radians(x_axis) - _towards(data, name, old["d"]), density)
    height = next((float(data[one]) for one in HEIGHTS if one in data and data[one].size == 1), np.nan)
    buoys.check_height(path, sea, height)
    return sea


def planes_of(path, location):
    """Planes of all hours of a file at one place, AT_ONCE hours at a time.

    yields : times (m,); frequencies (f,), Hz, ascending; directions of travel (d,), rad clockwise from north; and
        densities (m, f, d), m²/Hz/rad, float32, nan for an hour without a plane.  Raises TableError.
    """
    import xarray

    with xarray.open_dataset(path) as data:
        name = _density(path, data)
        axis = next((one for one in TIMES if one in data[name].dims), None)
        if axis is None or not any(one in AXES and AXES[one] == "d" for one in data[name].dims):
            axes = ", ".join(map(str, data[name].dims))
            raise TableError(
                f"{path}: {name} has the axes {axes}; allowed: a time, frequencies and directions; otherwise give "
                "height, period and direction as columns"
            )
        count = data[name].isel({axis: 0}).size // np.prod([n for one, n in data[name].sizes.items() if one in AXES])
        if location is None and count > 1:
            raise TableError(
                f"{path} has {count} locations; choose one by its number with location, counted from 1 with the "
                "last axis fastest"
            )
        data = _at_place(path, data, name, location or 1, (axis,))
        for first in range(0, data.sizes[axis], AT_ONCE):
            part = data.isel({axis: slice(first, first + AT_ONCE)})
            values, frequency, old = _renamed(path, part, name, (axis,))
            order = np.argsort(frequency)
            values = np.asarray(values.transpose(axis, "f", "d"), np.float32)[:, order]
            missing = ~np.isfinite(values).any(axis=(1, 2))
            values = np.nan_to_num(values)
            values[missing] = np.nan
            moments = np.asarray(part[axis].values).astype("datetime64[s]")
            yield moments, frequency[order], _towards(data, name, old["d"]), values


def _density(path, data):
    name = next((name for name in DENSITIES if name in data and set(data[name].dims) & set(AXES)), None)
    if name is None:
        other = next((one for one in data if {AXES.get(axis) for axis in data[one].dims} >= {"f", "d"}), None)
        if other is not None:
            raise TableError(
                f"{path}: {other} has frequencies and directions, but in an unknown layout: its unit, and "
                "whether waves come from its directions, are not known; rename it efth, give it units, and "
                "give its directions a standard_name"
            )
        raise TableError(f"{path} has no spectrum ({', '.join(DENSITIES)}){_integrals(data)}")
    return name


def _renamed(path, data, name, more=()):
    """Density per Hz and rad with axes "f", "d" and those of `more`, (f,) Hz, {"f", "d": axis of the file}"""
    rename = {axis: AXES[axis] for axis in data[name].dims if axis in AXES}
    values = data[name].rename(rename)
    if "f" not in values.dims or set(values.dims) - {"f", "d", *more}:
        raise TableError(f"{path}: {name} has the axes {', '.join(data[name].dims)}; allowed: frequency and direction")
    old = {new: axis for axis, new in rename.items()}
    if name == "d2fd":
        return 10**values, ERA5[0] * ERA5[1] ** np.arange(values.sizes["f"]), old
    if name == "AC":
        sigma = np.asarray(data["spsig"], float)
        return values.transpose(..., "f") * (2 * np.pi * sigma), sigma / (2 * np.pi), old
    if name == "specden" and "factor" in data:
        packed = (values.astype(float) + 127) * data["factor"]
        return packed * np.degrees(1.0), np.asarray(data[old["f"]], float), old
    unit = np.degrees(1.0) if "d" in values.dims and "deg" in str(data[name].attrs.get("units", "")) else 1.0
    return values * unit, np.asarray(data[old["f"]], float), old


def _towards(data, name, axis):
    """Direction, clockwise from north, that waves travel to, rad; shape (m,)"""
    if name == "d2fd":
        count = data.sizes[axis]
        return (np.arange(count) + 0.5) * (2 * np.pi / count)
    if name == "AC":
        return 0.5 * np.pi - np.asarray(data["spdir"], float)
    return _clockwise(data[axis])


def _clockwise(angles):
    """rad clockwise from north, from angles with a unit, and whether they are towards or from"""
    values, attrs = np.asarray(angles, float), angles.attrs
    values = values if str(attrs.get("units", "")).startswith("rad") else np.radians(values)
    return values if "to_direction" in str(attrs.get("standard_name", "")) else values + np.pi


def _measured(path, data, frequency, order, density, x_axis):
    def of(names):
        return (np.asarray(data[name], float)[order] for name in names)

    if x_axis is None:
        return buoys._plain(path, frequency, density[order])
    if all(name in data for name in NDBC):
        a1, a2, r1, r2 = of(NDBC)
        spread = directions.of_moments(r1, r2, np.radians(a1), np.radians(a2))
    elif all(name in data for name in MOMENTS):
        a1, b1, a2, b2 = of(MOMENTS)
        c1, c2 = a1 + 1j * b1, a2 + 1j * b2
        west = 1.5 * np.pi  # direction from which waves come that travel east
        spread = directions.of_moments(abs(c1), abs(c2), west - np.angle(c1), west - 0.5 * np.angle(c2))
    elif all(name in data for name in MEANS):
        spread = directions.of_spread(_clockwise(data["theta_1d"])[order] - np.pi, np.radians(next(of(MEANS[1:]))))
    else:
        return buoys._plain(path, frequency, density[order])
    return buoys._spread(path, frequency, density[order], spread, x_axis)


def _at_time(path, data, time):
    axis = next((one for one in TIMES if one in data.dims), None)
    if axis is None:
        return data
    times = [str(one)[:16] for one in data[axis].values]
    wanted = None if time is None else str(time).strip().replace(" ", "T")
    return data.isel({axis: buoys.one_of(path, times, wanted)})


def _at_place(path, data, name, location, kept=()):
    """The place number `location`, from 1, over the axes that are neither frequency nor direction, the last fastest"""
    axes = [axis for axis in data[name].dims if axis not in AXES and axis not in kept]
    sizes = [data.sizes[axis] for axis in axes]
    if not 1 <= location <= np.prod(sizes, dtype=int):
        raise TableError(
            f"{path} has {np.prod(sizes, dtype=int)} locations, and location is {location}; allowed: up to that number"
        )
    place = np.unravel_index(location - 1, sizes) if sizes else ()
    return data.isel(dict(zip(axes, map(int, place), strict=True)))


def _integrals(data):
    there = [(name, unit) for name, unit in INTEGRALS.items() if name in data and data[name].size == 1]
    found = ", ".join(f"{name} {data[name].values.item():.4g} {unit}" for name, unit in there)
    return f" but {found}: give height, a period and a direction" if found else ""
