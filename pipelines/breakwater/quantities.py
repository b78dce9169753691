"""Quantities of a breakwater: (quantities, labels of their axes) of each of its parts."""

import numpy as np

from hakobune.mooring.breakwater.holdings import mean_drift
from hakobune.mooring.studies.breakwater.breakwater import THEORIES
from hakobune.mooring.studies.breakwater.curves import sections
from hakobune.mooring.studies.breakwater.tides import ENDS

from ..results.quantity import Quantity, quantities
from ..results.result import labels, records

PARTS = {  # parts of a Response per wave amplitude: unit, description, table
    "transmission": ("", "K_T", "transmission"), "reflection": ("", "reflection", ""), "sway": ("m/m", "sway", ""),
    "heave": ("m/m", "heave", ""), "roll": ("rad/m", "roll", ""),
}  # fmt: skip
TIDE = {  # parts of a Tide: unit, description
    "rise": ("m", "rise"), "change": ("N/m", "change of P₀"), "front": ("N/m", "front"),
    "front_at": ("s", "front, at"), "back": ("N/m", "back"), "back_at": ("s", "back, at"),
}  # fmt: skip
PULLS = "tension amplitudes per metre of wave amplitude"
DESIGN = {"draft": ("m", 1.0, "draft"), "width": ("m", 1.0, "width"), "angle_deg": ("rad", np.pi / 180, "lines at")}


def curves_of(asked, found):
    """Transmission, reflection, motions and tensions of each holding, over period"""
    made, axes = (
        {},
        labels("period", asked.waves.period, "s") | labels("holding", [curve.name for curve in found.curves]),
    )
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


def natural_of(asked, found):
    """Natural periods of what floats, with K_T and tension there"""
    if not found.natural:
        return {}, {}
    title = "natural periods, by potential theory"
    made = {
        "natural.period": Quantity([one.period for one in found.natural], ("natural",), "s", "natural period", title),
        "natural.transmission": Quantity([one.transmission for one in found.natural], ("natural",), "", "K_T", title),
    }
    fronts = [one.front for one in found.natural]
    if np.isfinite(fronts).any():
        made["natural.front"] = Quantity(fronts, ("natural",), "N/m2", "front tension per metre of amplitude", title)
    return made, labels("natural", [f"{one.holding}, {one.motion}" for one in found.natural])


def _moduli(name, values, axes, unit, words, table):
    return {
        name: Quantity(np.abs(values), axes, unit, words, table),
        f"{name}.complex": Quantity(np.asarray(values, complex), axes, unit, f"{words or name}, complex", record=True),
    }


def checks_of(asked, found):
    """Mean drift, and violations of energy conservation and Haskind's relation"""
    obliquity = asked.waves.obliquity
    omega, water = 2 * np.pi / asked.waves.period, asked.fluid | {"obliquity": obliquity}
    parts = [curve.response for curve in found.curves]
    drift = [mean_drift(one, omega, asked.depth(0.0), **water) for one in parts]
    energy = [abs(one.transmission) ** 2 + abs(one.reflection) ** 2 - 1 for one in parts]
    two = ("period", "holding")
    made = {
        "mean_drift": Quantity(np.stack(drift, axis=1), two, "N/m3", "mean drift"),
        "check.energy": Quantity(np.stack(energy, axis=1), two, "", "energy amiss"),
    }
    if THEORIES[0] in asked.theories:
        waters = sections(asked, asked.wetted(0.0), 0.0, omega, obliquity)
        misses = [abs(one.haskind - one.excitation).max() / abs(one.excitation).max() for one in waters]
        made["check.haskind"] = Quantity(misses, ("period",), "", "error of Haskind's relation")
    return made, {}


def pretension_of(asked, found):
    """Tensions at every level of the tide, and the required pretension"""
    tides, held = found.tides, found.pretension
    if tides is None:
        return {}, {}
    title = "" if held is None else f"greatest amplitudes of tension in waves of {asked.waves.height:g} m"
    columns = {name: [getattr(one, name) for one in tides] for name in TIDE}
    made = quantities(title, {f"tide.{name}": (columns[name], *TIDE[name]) for name in TIDE}, "level")
    axes = labels("level", [one.level for one in tides]) | labels("end", ENDS)
    return (made, axes) if held is None else (made | _pretension(asked, held), axes)


def _pretension(asked, held):
    given = {
        "pretension.least": (held.least, "N/m", "least that keeps lines taut"),
        "pretension.used": (held.used, "N/m", "that is used" if held.given is None else "of the body"),
        "pretension.most": (held.most, "N/m", "most within the allowable tension"),
    }
    greatest = {"pretension.greatest": (held.greatest, "N/m", "greatest tension")}
    known = {name: row for name, row in given.items() if row[0] is not None}
    return quantities(f"pretension P₀ of {', '.join(asked.design)}", known) | quantities(
        "lines with this pretension", greatest, "end"
    )


def anchors_of(asked, found):
    """Required sizes of anchors, and the sizes provided"""
    if not found.anchors:
        return {}, {}
    units = tuple(one.unit for one in found.anchors)
    parts = ((one.provided, one.utilisation) for one in found.anchors)
    provided, used = np.array([[np.nan if part is None else part for part in row] for row in parts]).T
    unit, known = units[0] if len(units) == 1 else units, "anchors" if np.isfinite(provided).any() else ""
    needed = {
        "anchor.needed": ([one.needed for one in found.anchors], unit, "needed"),
        "anchor.size": ([one.note for one in found.anchors], "", "size"),
    }
    given = {"anchor.provided": (provided, unit, "provided"), "anchor.used": (used, "%", "used")}
    axes = labels("anchor", [one.name for one in found.anchors])
    return quantities("anchors", needed, "anchor") | quantities(known, given, "anchor"), axes


def behind_in_words(sea, asked=None):
    """Note on the height behind the breakwater for each way to hold it; nothing without a sea

    asked : m, significant height in the study, which the constants of older spectra miss by a thousandth
    """
    if sea is None or not sea.heights:
        return
    before = sea.cells.height
    behind = [f"{name} {height:.3g} m ({100 * height / before:.0f} %)" for name, height in sea.heights.items()]
    missed = asked is not None and abs(before / asked - 1) > 1e-4
    words = f" (4√m₀ of {asked:g} m by the constants of its spectrum)" if missed else ""
    yield f"of a sea of {before:.4g} m{words} passes: {'; '.join(behind)}"


def behind_of(asked, found):
    """The sea behind the breakwater, and tensions in that sea"""
    sea = found.sea
    if sea is None:
        return {}, {}
    names, heights = list(sea.heights), np.array(list(sea.heights.values()))
    title, density = f"sea of {sea.cells.height:.4g} m", sea.cells.energy / sea.cells.width
    over = np.stack(list(sea.transmission.values()), axis=1) if names else np.zeros((len(density), 0))
    made = quantities("", {
        "sea.height": (float(sea.cells.height), "m", "significant height"),
        "sea.waves": (float(sea.waves), "", "number of waves"),
    })  # fmt: skip
    made |= quantities(title, {
        "sea.behind": (heights, "m", "4√m₀ behind"),
        "sea.share": (heights / sea.cells.height, "%", "of the height"),
    }, "behind")  # fmt: skip
    made |= records({
        "sea.spectrum": (density, ("omega",), "m2 s/rad", "spectrum before"),
        "sea.spectrum_behind": (over**2 * density[:, None], ("omega", "behind"), "m2 s/rad", "spectrum behind"),
    })  # fmt: skip
    if sea.greatest is not None:
        made |= quantities(f"lines in the greatest of {sea.waves:.0f} waves of the sea", {
            "sea.amplitude": (sea.greatest, "N/m", "greatest amplitude"),
            "sea.tension": (sea.tension, "N/m", "greatest tension at the worst level"),
            "sea.slack": (sea.slack, "%", "share of the cycles with slack lines"),
        }, "end")  # fmt: skip
        made |= quantities("", {"sea.deviation": (sea.deviation, "N/m", "standard deviation")}, "end")
        made["sea.least_pretension"] = Quantity(sea.least, (), "N/m", "least pretension that keeps lines taut in it")
    return made, labels("behind", names) | labels("omega", sea.cells.omega, "rad/s") | labels("end", ENDS)


def snapping_of(asked, found):
    """Lines that go slack, in time"""
    if found.snapping is None:
        return {}, {}
    level, period, snap = found.snapping
    title = f"lines that go slack and snap, in time, {period:.4g} s at {level} water"
    when = {"snap.level": (level, "", "level"), "snap.period": (float(period), "s", "period")}
    return quantities("", when) | quantities(title, {
        "snap.largest": (snap.largest, "N/m", "snaps to"),
        "snap.mean": (snap.peaks, "N/m", "mean of the cycles"),
        "snap.slack": (snap.slack, "%", "share of the time with slack lines"),
    }, "end"), {}  # fmt: skip


def front_of(asked, found):
    """The best designs"""
    front = found.front
    if front is None:
        return {}, {}
    behind = ("m", "4√m₀ behind") if asked.sea is not None else ("", "greatest K_T")
    made = {"tension": (front.tension, "N/m", "greatest tension"), "behind": (front.behind, *behind)}
    for name, values in zip(front.names, front.designs.T, strict=True):
        unit, size, words = DESIGN[name]
        made[name.removesuffix("_deg")] = values * size, unit, words
    made = {f"design.{name}": row for name, row in made.items()}
    return quantities(f"best of {front.trials} designs", made, "design"), labels(
        "design", np.arange(1, len(front.tension) + 1)
    )


def lee_of(asked, found):
    """Waves around units of finite length"""
    lee = found.lee
    if lee is None:
        return {}, {}
    units = f"{len(lee.units)} unit{'s' * (len(lee.units) > 1)} of {2 * lee.half[0]:.4g} m"
    leeward, ratios = np.array(lee.behind).T
    made = {
        "lee.behind": Quantity(
            ratios, ("leeward",), "", "height over incident height, rms along the row", f"behind {units} in {lee.waves}"
        ),
        "lee.ratio": Quantity(lee.ratio, ("map_y", "map_x"), "", "height over incident height", record=True),
        "lee.unit": Quantity(lee.units, ("unit", "xy"), "m", "middle of a unit"),
    }
    axes = labels("leeward", leeward, "m") | labels("map_x", lee.x, "m") | labels("map_y", lee.y, "m")
    axes |= labels("unit", np.arange(1, len(lee.units) + 1)) | labels("xy", ["x", "y"])
    if lee.tension is not None:
        made["lee.tension"] = Quantity(lee.tension, ("end", "along"), "N/m2", "amplitude of tension")
        made |= quantities("lines of a single unit, per metre of wave amplitude", {
            "lee.largest": (lee.tension.max(axis=1), "N/m2", "largest amplitude"),
            "lee.largest_at": (lee.lines[lee.tension.argmax(axis=1)], "m", "at x"),
        }, "end")  # fmt: skip
        axes |= labels("along", lee.lines, "m") | labels("end", ENDS)
    return made, axes
