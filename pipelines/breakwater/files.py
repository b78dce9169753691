"""Files of a breakwater: curves over period as CSV, everything as HDF5 in SI units."""

from __future__ import annotations

import numpy as np

from hakobune.bem.database.results import has_schema
from hakobune.meshing.seals import write_sealed
from hakobune.mooring.breakwater.holdings import mean_drift

from ..common.outputs import opening
from .curves import sections
from .tables import THEORIES

SCHEMA = "hakobune breakwater study 1"
UNITS = {
    "transmission": "m/m", "reflection": "m/m", "sway": "m/m", "heave": "m/m", "roll": "rad/m", "front": "N/m per m",
    "back": "N/m per m",
}  # fmt: skip


def write_csv(path, study, found):
    """Write the amplitudes of all curves over period."""
    head = f"# {study.name}: amplitudes per m of wave amplitude, tensions in N/m"
    names, columns = ["period_s"], [found.period]
    for curve in found.curves:
        for part in UNITS:
            values = getattr(curve.response, part)
            if np.isfinite(values).all():
                names.append(f"{part} {curve.name}".replace(",", ""))
                columns.append(abs(values))
    rows = [",".join(f"{value:.7g}" for value in row) for row in zip(*columns, strict=True)]
    write_sealed(path, "\n".join([head, ",".join(names), *rows]) + "\n")


def write_h5(path, breakwater, text, found):
    """Write Results of a `Breakwater` with the text of its study, the mean drift of every curve, and what its energy
    and Haskind's relation of its section miss."""
    from hakobune.bem.database.file import beside

    with beside(path) as file:
        file.attrs["schema"], file.attrs["study"], file.attrs["warnings"] = SCHEMA, text, "\n".join(found.warned)
        _put(file, "period", found.period, "s")
        for curve in found.curves:
            for part, unit in UNITS.items():
                _put(file, f"{curve.name}/{part}", getattr(curve.response, part), unit)
            omega, water = 2 * np.pi / found.period, breakwater.water | {"obliquity": breakwater.obliquity}
            drift = mean_drift(curve.response, omega, breakwater.depth(0.0), **water)
            _put(file, f"{curve.name}/mean_drift", drift, "N/m per m2")
            parts = (curve.response.transmission, curve.response.reflection)
            _put(file, f"checks/energy/{curve.name}", sum(abs(part) ** 2 for part in parts) - 1, "1")
        if THEORIES[0] in breakwater.study.theories:
            waters = sections(breakwater, breakwater.wetted(0.0), 0.0, 2 * np.pi / found.period, breakwater.obliquity)
            misses = [abs(one.haskind - one.excitation).max() / abs(one.excitation).max() for one in waters]
            _put(file, "checks/haskind", misses, "1")
        if found.sea is not None:
            _put_sea(file, found.sea)
        for one in found.tides or []:
            for name in ("rise", "change", "front", "back", "front_at", "back_at"):
                unit = {"rise": "m", "front_at": "s", "back_at": "s"}.get(name, "N/m")
                _put(file, f"tide/{one.level}/{name}", getattr(one, name), unit)
        if found.pretension is not None:
            held = found.pretension
            for name in ("given", "used", "least", "most", "greatest"):
                value = getattr(held, name)
                _put(file, f"pretension/{name}", np.nan if value is None else value, "N/m")
            file["pretension"].attrs["slack"] = ", ".join(f"{end} at {level}" for level, end in held.slack)
        if found.front is not None:
            for name, values in zip(found.front.names, found.front.designs.T, strict=True):
                _put(file, f"front/{name}", values, "degree" if name == "angle_deg" else "m")
            _put(file, "front/tension", found.front.tension, "N/m")
            _put(file, "front/behind", found.front.behind, "m, or 1 without a sea")
        if found.lee is not None:
            for name, unit in (("x", "m"), ("y", "m"), ("ratio", "1"), ("units", "m")):
                _put(file, f"map/{name}", getattr(found.lee, name), unit)
            if found.lee.tension is not None:
                _put(file, "map/lines", found.lee.lines, "m")
                _put(file, "map/tension", found.lee.tension, "N/m2")
            _put(file, "map/behind", found.lee.behind, "m, 1")
            file["map"].attrs["waves"] = found.lee.waves
        for one in found.anchors:
            _put(file, f"anchors/{one.name}", one.needed, one.unit)


def is_breakwater(path):
    """Whether a file was written here"""
    if path.suffix == ".csv":
        first, names = opening(path)
        return "tensions in N/m" in first and names.startswith("period_s,")
    return has_schema(path, SCHEMA)


def _put_sea(file, sea):
    _put(file, "sea/omega", sea.cells.omega, "rad/s")
    density = sea.cells.energy / sea.cells.width
    _put(file, "sea/spectrum", density, "m2 s/rad")
    for name, K in sea.transmission.items():
        _put(file, f"sea/behind/{name}", K**2 * density, "m2 s/rad")
        file[f"sea/behind/{name}"].attrs["height_m"] = sea.heights[name]
    for name in ("deviation", "greatest"):
        if getattr(sea, name) is not None:
            _put(file, f"sea/tension_{name}", getattr(sea, name), "N/m")
    if sea.slack is not None:
        _put(file, "sea/slack_share", sea.slack, "1")
        _put(file, "sea/largest_tension", sea.tension, "N/m")
        _put(file, "sea/least_pretension", sea.least, "N/m")


def _put(file, name, value, unit):
    file.create_dataset(name, data=np.asarray(value)).attrs["units"] = unit
