"""Quantities of a breakwater: (quantities, labels of their axes) of each of its parts."""

from __future__ import annotations

import numpy as np

from hakobune.mooring.breakwater.holdings import mean_drift

from ..results.quantity import Quantity
from ..results.result import labels
from .build import KN
from .curves import sections
from .results import design
from .tables import THEORIES

ENDS = ("front", "back")
PARTS = {  # of a Response, over the amplitude of the waves: unit, description, table
    "transmission": ("", "K_T", "transmission"), "reflection": ("", "reflection", ""), "sway": ("m/m", "sway", ""),
    "heave": ("m/m", "heave", ""), "roll": ("rad/m", "roll", ""),
}  # fmt: skip
PULLS = "amplitudes of tension for each metre of wave amplitude"
ANCHOR_UNITS = {"kN": ("N", KN), "kN/m": ("N/m", KN), "m apart": ("m", 1.0)}
DESIGN = {"draft": ("m", 1.0), "width": ("m", 1.0), "angle_deg": ("rad", np.pi / 180)}


def curves_of(asked, found):
    """Transmission, reflection, motions and tensions of each way to hold the body, over period"""
    made, axes = {}, labels("period", found.period, "s") | labels("holding", [curve.name for curve in found.curves])
    for name, (unit, words, table) in PARTS.items():
        values = np.stack([getattr(curve.response, name) for curve in found.curves], axis=1)
        made |= _moduli(name, values, ("period", "holding"), unit, words, table)
    held = [curve for curve in found.curves if np.isfinite(curve.response.front).all()]
    if held:
        axes |= labels("held", [curve.name for curve in held])
        for name in ENDS:
            values = np.stack([getattr(curve.response, name) for curve in held], axis=1)
            made |= _moduli(f"{name}.tension", values, ("period", "held"), "N/m2", name, PULLS)
    return made, axes


def _moduli(name, values, axes, unit, words, table):
    return {
        name: Quantity(np.abs(values), axes, unit, words, table),
        f"{name}.complex": Quantity(np.asarray(values, complex), axes, unit, f"{words or name}, complex", record=True),
    }


def checks_of(asked, found):
    """Mean drift, and what energy and Haskind's relation miss"""
    omega, water = 2 * np.pi / found.period, asked.water | {"obliquity": asked.obliquity}
    parts = [curve.response for curve in found.curves]
    drift = [mean_drift(one, omega, asked.depth(0.0), **water) for one in parts]
    energy = [abs(one.transmission) ** 2 + abs(one.reflection) ** 2 - 1 for one in parts]
    two = ("period", "holding")
    made = {
        "mean_drift": Quantity(np.stack(drift, axis=1), two, "N/m3", "mean drift"),
        "check.energy": Quantity(np.stack(energy, axis=1), two, "", "energy amiss"),
    }
    if THEORIES[0] in asked.study.theories:
        waters = sections(asked, asked.wetted(0.0), 0.0, omega, asked.obliquity)
        misses = [abs(one.haskind - one.excitation).max() / abs(one.excitation).max() for one in waters]
        made["check.haskind"] = Quantity(misses, ("period",), "", "Haskind's relation amiss")
    return made, {}


def pretension_of(asked, found):
    """Tensions at every level of the tide, and the pretension that they ask for"""
    tides, held = found.tides, found.pretension
    if tides is None:
        return {}, {}
    title = f"greatest amplitudes of tension in waves of {asked.study.waves.height:g} m" if held is not None else ""
    rows = {
        "rise": ("m", "rise"), "change": ("N/m", "change of P₀"), "front": ("N/m", "front"),
        "front_at": ("s", "front, at"), "back": ("N/m", "back"), "back_at": ("s", "back, at"),
    }  # fmt: skip
    made = {
        f"tide.{name}": Quantity([getattr(one, name) for one in tides], ("level",), unit, words, title)
        for name, (unit, words) in rows.items()
    }
    axes = labels("level", [one.level for one in tides]) | labels("end", ENDS)
    return (made, axes) if held is None else (made | _pretension(asked.study, held), axes)


def _pretension(study, held):
    title = f"pretension P₀ of {', '.join(design(study))}"
    rows = {
        "least": (held.least, "least that keeps lines taut"),
        "used": (held.used, "that is used" if held.given is None else "of the body"),
        "most": (held.most, "most within the allowable tension"),
    }
    made = {
        f"pretension.{name}": Quantity(float(value), (), "N/m", words, title)
        for name, (value, words) in rows.items()
        if value is not None
    }
    made["pretension.greatest"] = Quantity(
        held.greatest, ("end",), "N/m", "greatest tension", "lines with this pretension"
    )
    return made


def anchors_of(asked, found):
    """What anchors have to be, and what is provided"""
    rows = found.anchors
    if not rows:
        return {}, {}
    units = [ANCHOR_UNITS[one.unit] for one in rows]
    sizes = np.array([size for _, size in units])
    provided = np.array([np.nan if one.provided is None else one.provided for one in rows])
    used = [np.nan if one.utilisation is None else one.utilisation for one in rows]
    unit = tuple(unit for unit, _ in units)
    unit, known = unit[0] if len(unit) == 1 else unit, "anchors" if np.isfinite(provided).any() else ""
    return {
        "anchor.needed": Quantity(sizes * [one.needed for one in rows], ("anchor",), unit, "needed", "anchors"),
        "anchor.size": Quantity([one.note for one in rows], ("anchor",), "", "size", "anchors"),
        "anchor.provided": Quantity(sizes * provided, ("anchor",), unit, "provided", known),
        "anchor.used": Quantity(used, ("anchor",), "", "used", known, share=True),
    }, labels("anchor", [one.name for one in rows])


def behind_of(asked, found):
    """The sea behind, and tensions in it"""
    sea = found.sea
    if sea is None:
        return {}, {}
    names, heights = list(sea.heights), np.array(list(sea.heights.values()))
    title, density = f"sea of {sea.cells.height:.4g} m", sea.cells.energy / sea.cells.width
    over = np.stack(list(sea.transmission.values()), axis=1) if names else np.zeros((len(density), 0))
    made = {
        "sea.height": Quantity(float(sea.cells.height), (), "m", "significant height"),
        "sea.waves": Quantity(float(sea.waves), (), "", "number of waves"),
        "sea.behind": Quantity(heights, ("behind",), "m", "4√m₀ behind", title),
        "sea.share": Quantity(heights / sea.cells.height, ("behind",), "", "of the height", title, share=True),
        "sea.spectrum": Quantity(density, ("omega",), "m2 s/rad", "spectrum before", record=True),
        "sea.spectrum_behind": Quantity(
            over**2 * density[:, None], ("omega", "behind"), "m2 s/rad", "spectrum behind", record=True
        ),
    }
    if sea.greatest is not None:
        title = f"lines in the greatest of {sea.waves:.0f} waves of the sea"
        rows = {
            "deviation": (sea.deviation, "N/m", "standard deviation", ""),
            "amplitude": (sea.greatest, "N/m", "greatest amplitude", title),
            "tension": (sea.tension, "N/m", "greatest tension at the worst level", title),
            "slack": (sea.slack, "", "slack in of the cycles", title),
        }
        made |= {
            f"sea.{name}": Quantity(values, ("end",), unit, words, table, name == "slack")
            for name, (values, unit, words, table) in rows.items()
        }
        made["sea.least_pretension"] = Quantity(sea.least, (), "N/m", "least pretension that keeps lines taut in it")
    return made, labels("behind", names) | labels("omega", sea.cells.omega, "rad/s") | labels("end", ENDS)


def snapping_of(asked, found):
    """Lines that go slack, in time"""
    if found.snapping is None:
        return {}, {}
    level, period, snap = found.snapping
    title = f"lines that snap, in time, {period:.4g} s at {level} water"
    return {
        "snap.level": Quantity(level, (), "", "level"),
        "snap.period": Quantity(float(period), (), "s", "period"),
        "snap.largest": Quantity(snap.largest, ("end",), "N/m", "snaps to", title),
        "snap.mean": Quantity(snap.peaks, ("end",), "N/m", "mean of the cycles", title),
        "snap.slack": Quantity(snap.slack, ("end",), "", "slack of the time", title, share=True),
    }, {}


def front_of(asked, found):
    """The best designs"""
    front = found.front
    if front is None:
        return {}, {}
    title, sea = f"best of {front.trials} designs", asked.study.sea is not None
    made = {
        "design.tension": Quantity(front.tension, ("design",), "N/m", "greatest tension", title),
        "design.behind": Quantity(
            front.behind, ("design",), "m" if sea else "", "4√m₀ behind" if sea else "greatest K_T", title
        ),
    }
    for name, values in zip(front.names, front.designs.T, strict=True):
        unit, size = DESIGN[name]
        word = name.removesuffix("_deg")
        made[f"design.{word}"] = Quantity(
            values * size, ("design",), unit, "lines at" if word == "angle" else word, title
        )
    return made, labels("design", np.arange(1, len(front.tension) + 1))


def lee_of(asked, found):
    """Waves around units of finite length"""
    lee = found.lee
    if lee is None:
        return {}, {}
    units = f"{len(lee.units)} unit{'s' * (len(lee.units) > 1)} of {2 * lee.half[0]:.4g} m"
    leeward, ratios = np.array(lee.behind).T
    made = {
        "lee.behind": Quantity(ratios, ("leeward",), "", "height over that before", f"behind {units} in {lee.waves}"),
        "lee.ratio": Quantity(lee.ratio, ("map_y", "map_x"), "", "height over that before", record=True),
        "lee.unit": Quantity(lee.units, ("unit", "xy"), "m", "middle of a unit"),
    }
    axes = labels("leeward", leeward, "m") | labels("map_x", lee.x, "m") | labels("map_y", lee.y, "m")
    axes |= labels("unit", np.arange(1, len(lee.units) + 1)) | labels("xy", ["x", "y"])
    if lee.tension is not None:
        title = "lines of a unit alone, for each metre of wave amplitude"
        made["lee.tension"] = Quantity(lee.tension, ("end", "along"), "N/m2", "amplitude of tension")
        made["lee.largest"] = Quantity(lee.tension.max(axis=1), ("end",), "N/m2", "largest amplitude", title)
        made["lee.largest_at"] = Quantity(lee.lines[lee.tension.argmax(axis=1)], ("end",), "m", "at x", title)
        axes |= labels("along", lee.lines, "m") | labels("end", ENDS)
    return made, axes
