"""Steady current force on a box.

SR179 report (1982), section 2.2: tank tests of a fixed box in uniform current, C_x on B d, C_y on L d, for
length/beam L/B = 2 with B/d = 5 … 20 and depth/draft H/d from 1.2 (tables 2.2.3.2, 2.2.3.3, 2.2.3.5, 2.2.3.6), and for
L/B = 1.2 with B/d = 10, H/d from 1.05, and 15 in deep water (2.2.3.1, 2.2.3.4).  For L/B = 2

    C_x(χ) = C_x(0°) S_x(χ),   C_y(χ) = C_y(90°) S_y(χ)

where C_x(0°), C_y(90°) over B/d and H/d are interpolated along their crest (see `crest`) and the shapes S between the
three depths at which all angles were tested.  Water deeper than the tank is treated as water of the tank's depth. The
moment is not tabulated; the report's text gives the lever 0.09 (sin 2χ)^1.2 of the length for L/B = 2.

A square has the mean coefficients of both sides of L/B = 1.2, because its sides are equal; boxes with L/B below 1.2
are in between.

Beyond the tests coefficients are extrapolated, and a note says so. Longer boxes, and smaller or larger B/d, have the
coefficients of the nearest tested proportion. L/B < 2 with an untested B/d follows the trend of L/B = 2 over B/d. In
water shallower than in the tests, C_y increases as for ships (UFC 4-159-03, Design: Moorings, 2005, eq. 11), to 3.2
abeam when aground:

    C = C₁ + (3.2 − C₁) ((d/H)² − (d/H₁)²) / (1 − (d/H₁)²),    C₁ of the shallowest test H₁
"""

import warnings
from functools import cache, lru_cache

import numpy as np

from hakobune.meshing.text_files import packaged_rows

from .box_drag import DragTable, box_drag, check_positive, stream_pressure
from .crest import CrestSurface, Point
from .smooth import parabolic, smooth

DEGREES = ("0", "15", "30", "45", "60", "75", "90")
ANGLES = np.deg2rad([float(a) for a in DEGREES])
TANK = {1.2: 1.4, 2.0: 1.8}  # depth of the tank in beams, for each L/B
SAME = 0.025  # relative distance of L/B or B/d within which it counts as a tested proportion
REACH = {"L/B": (1.0, 12.0), "B/d": (2.0, 60.0), "H/d": (1.02, np.inf)}  # limits of the extrapolation
SHALLOWEST = {1.2: 1.05, 2.0: 1.2}  # H/d of the tests, by L/B
GROUNDED = 3.2  # C_y abeam of grounded ships


@lru_cache(maxsize=64)  # every seed of a study asks for that of its hulls
def box_table(length, beam, draft, depth):
    """DragTable of a box, sizes in m.

    Its `notes` name uncertain values: printed values that break the trend of their neighbours, proportions beyond or
    between the tested ones, and the moment for L/B other than 2. The lever is then 0.09 (L/B − 1) (sin 2χ)^1.2, at
    most that of L/B = 2; it is 0 for a square, which has no long side. Turning tests give 0.058 at L/B = 1.5 and
    0.091 at 2.
    raises : ValueError beyond the limits REACH, where the user must give coefficients
    """
    check_positive(length=length, beam=beam, draft=draft)
    if not depth > 0:
        raise ValueError(f"depth is {depth:g}; allowed: above 0")
    if beam > length:
        return _across(box_table(beam, length, draft, depth), beam / length)
    given = {"L/B": length / beam, "B/d": beam / draft, "H/d": depth / draft}
    for name, value in given.items():
        _require(name, value, *REACH[name])
    slender, wide = min(max(given["L/B"], 1.2), 2.0), min(max(given["B/d"], 5.0), 20.0)
    slender = next((s for s in TANK if abs(slender / s - 1) <= SAME), slender)
    share = (slender - 1.2) / 0.8
    series = {1.2: 1 - share, 2.0: share}
    parts = [(part, _tested(ratio, wide, given["H/d"])) for ratio, part in series.items() if part > 0]
    x, y = (sum(part * found[i] for part, found in parts) for i in range(2))
    if given["L/B"] < 1.2:  # a square has one coefficient for both sides, and boxes up to the tests are in between
        square, part = 0.5 * (x + y[::-1]), (1.2 - given["L/B"]) / 0.2
        x, y = x + part * (square - x), y + part * (square[::-1] - y)
    lever = 0.09 * (min(given["L/B"], 2.0) - 1) * np.maximum(np.sin(2 * ANGLES), 0.0) ** 1.2
    notes = [note for ratio, part in series.items() if part > 0 for note in _suspects(ratio, wide, given["H/d"])]
    led_on = dict.fromkeys(note for _, found in parts for note in found[2])
    beyond = [_beyond(name, given[name], at) for name, at in (("L/B", slender), ("B/d", wide))]
    return DragTable(ANGLES, x, y, lever, (*notes, *filter(None, beyond), *led_on, *_guesses(slender, given["L/B"])))


def current_force(speed, direction, length, beam, draft, density=1025.0, table=None, depth=np.inf):
    """Forces F_x, F_y, N, and moment M_z, N m, about the middle of the box; shape (…, 3).

    speed : (…) m/s; direction : direction of flow, (…) rad
    table : DragTable; by default `box_table` at the water depth `depth`, m, whose notes become warnings
    """
    check_positive(length=length, beam=beam, draft=draft)
    if table is None:
        table = box_table(length, beam, draft, depth)
        for note in table.notes:
            warnings.warn(note, stacklevel=2)
    pressure = stream_pressure("current", speed, density)
    return box_drag(direction, pressure, beam * draft, length * draft, length, table)


def _require(name, value, low, high):
    if not low * (1 - 1e-9) <= value <= high * (1 + 1e-9):
        span = f"{low:g} to {high:g}" if high < np.inf else f"from {low:g} on"
        raise ValueError(
            f"{name} = {value:.4g} is too far outside the current force tests ({span}) for an extrapolation; give "
            "current "
            "coefficients"
        )


def _across(table, ratio):
    """The DragTable of a box turned by 90°, whose length over beam was `ratio`"""
    return DragTable(ANGLES, table.y[::-1], table.x[::-1], -ratio * table.lever[::-1], table.notes)


def _beyond(name, value, taken):
    """A note where tests of the nearest proportion are used; "" within the tests"""
    if abs(value / taken - 1) <= SAME:
        return ""
    more = (
        "; narrower sections have more drag than that: a square one (B/d = 2) about 1.5 times as much"
        if name == "B/d" and value < 5
        else ""
    )
    return f"current force: {name} = {value:.4g} is outside the tests; the value for {taken:g} is used{more}"


def _tested(slender, wide, relative):
    """C_x, C_y (7,) of a tested L/B at any B/d from 5 to 20 and H/d, and notes on extrapolation"""
    edge = SHALLOWEST[slender]
    if slender == 2.0:
        x, y, notes = *_slender(wide, max(relative, edge)), ()
    else:
        x, y, notes = _broad(wide, max(relative, edge))
    if relative >= edge * (1 - 1e-9):
        return x, y, notes
    rise = ((1 / relative) ** 2 - (1 / edge) ** 2) / (1 - (1 / edge) ** 2)
    y = y * (1 + max(GROUNDED / y[-1] - 1, 0.0) * rise)
    told = (
        f"current force: H/d = {relative:.4g} is below the tests of L/B = {slender:g} ({edge:g}); C_y is "
        "extrapolated up to 3.2"
    )
    return x, y, (*notes, told)


def _slender(wide, relative):
    """C_x, C_y (7,) of L/B = 2"""
    deepest = min(relative, TANK[2.0] * wide)
    return [_crest(name)(wide, deepest) * _shape(name, wide, relative) for name in ("C_x", "C_y")]


def _broad(wide, relative):
    """C_x, C_y (7,) of L/B = 1.2, and notes"""
    if abs(wide / 10.0 - 1) <= SAME:
        return *(_over_depth(name, relative) for name in ("C_x", "C_y")), ()
    if 10.0 <= wide <= 15.0 and relative >= TANK[1.2] * wide * (1 - 1e-9):
        deep = [[_rows(name, 1.2)[b, TANK[1.2] * b] for b in (10.0, 15.0)] for name in ("C_x", "C_y")]
        return *(smooth([10.0, 15.0], values)(wide) for values in deep), ()
    known, low = [_over_depth(name, relative) for name in ("C_x", "C_y")], max(relative, SHALLOWEST[2.0])
    trend = [a[i] / b[i] for a, b, i in zip(_slender(wide, low), _slender(10.0, low), (0, -1), strict=True)]
    note = f"current force: B/d = {wide:.4g} was not tested with L/B = 1.2; the trend of L/B = 2 is used"
    return known[0] * trend[0], known[1] * trend[1], (note,)


def _over_depth(name, relative):
    """Coefficients for L/B = 1.2, B/d = 10, a curve over d/H; shape (7,)"""
    rows = sorted((1 / h, values) for (b, h), values in _rows(name, 1.2).items() if b == 10.0)
    x, values = [r[0] for r in rows], [r[1] for r in rows]
    return smooth(x, values, flat=[0])(max(1 / relative, x[0]))


def _shape(name, wide, relative):
    """Ratios of the coefficients for L/B = 2 to that at 0° (C_x) or 90° (C_y); shape (7,): curves over B/d, then over
    d/H"""
    rows, beams = _rows(name, 2.0), (5.0, 10.0, 15.0, 20.0)
    largest = 0 if name == "C_x" else -1

    def at(depths):
        values = np.array([rows[b, h] for b, h in zip(beams, depths, strict=True)])
        return smooth(beams, values / values[:, [largest]])(wide)

    x = [1 / (TANK[2.0] * wide), 1 / 1.6, 1 / 1.2]
    values = [at([TANK[2.0] * b for b in beams]), at([1.6] * 4), at([1.2] * 4)]
    return parabolic(x, values, flat=[0])(max(1 / relative, x[0]))


@cache
def _rows(name, slender):
    """{(B/d, H/d): (7,) coefficients} at all angles"""
    return {
        (float(r["beam_over_draft"]), float(r["depth_over_draft"])): np.array([float(r[a]) for a in DEGREES])
        for r in packaged_rows(__package__, "current_angles")
        if r["coefficient"] == name and float(r["length_over_beam"]) == slender
    }


@cache
def _crest(name):
    points = [
        Point(float(r["beam_over_draft"]), float(r["depth_over_draft"]), float(r["value"]), r["crest"] == "1")
        for r in packaged_rows(__package__, "current_depths")
        if r["coefficient"] == name
    ]
    return CrestSurface(points, TANK[2.0])


def _suspects(slender, wide, relative):
    """One message for each printed value out of trend among the tests next to these proportions"""
    for r in packaged_rows(__package__, "current_angles"):
        if not r["suspect"] or float(r["length_over_beam"]) != slender:
            continue
        name, b, h = r["coefficient"], float(r["beam_over_draft"]), float(r["depth_over_draft"])
        tests = _rows(name, slender)
        beams, depths = {key[0] for key in tests}, {_column(slender, *key) for key in tests}
        if _next_to(wide, b, beams) and _next_to(_column(slender, wide, relative), _column(slender, b, h), depths):
            angle = int(r["suspect"])
            beside = [f"{r[str(a)]} at {a}°" for a in (angle - 15, angle + 15) if a <= 90]
            yield (
                f"current force: {name} = {r[r['suspect']]} at L/B = {slender:g}, B/d = {b:g}, H/d = {h:g}, "
                f"{angle}° of the report deviates from its neighbours ({', '.join(beside)}); it is used as "
                f"printed, and {name} of this hull follows it around {angle}°; give current coefficients to "
                "replace it"
            )


def _column(slender, b, h):
    """H/d, infinite from the depth of the tank on"""
    return h if h < TANK[slender] * b * (1 - 1e-9) else np.inf


def _next_to(value, node, nodes):
    """Whether no other node lies between a value and this node, or at the value"""
    low, high = min(value, node), max(value, node)
    return not any(low <= n <= high for n in nodes - {node})


def _guesses(slender, given):
    if 1.2 < slender < 2.0:
        yield f"current force: L/B = {slender:.4g} lies between the tested 1.2 and 2; it is interpolated linearly"
    if slender != 2.0 or given > 2.0 * (1 + SAME):
        yield (
            f"current moment for L/B = {given:.4g} is a guess (lever {0.09 * (min(given, 2.0) - 1):.2g} L at "
            "45°): the report prints only the moment for L/B = 2; give current coefficients"
        )
