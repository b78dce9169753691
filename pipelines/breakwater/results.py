"""What a study of a breakwater finds: curves over period, the sea behind it, pretension over the tide, anchors."""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import wavenumber
from hakobune.mooring.breakwater import anchors as sizes
from hakobune.mooring.breakwater.holdings import Response
from hakobune.mooring.breakwater.loss import GAUSSIAN
from hakobune.mooring.breakwater.transmission import Cells, equal_cells, greatest_of, slack_share

from ..common.quantities import StudyError, positive
from ..common.weather.seas import spectrum_of, spreading_of
from .build import KN
from .curves import Curve, curves, response, sections
from .study import MOST_OBLIQUE, periods
from .tables import THEORIES

SEA_CELLS = 120  # the height behind a circle is within 2e-4 of that of 2000
HIGH_SINKER = 0.5  # of the water under the keel: higher ones move the lower ends of the lines
WAYS = 12  # of a sea spread over directions: the height behind is within 4e-3 of that of 48
BREAKING = 0.142  # Miche (1944): H = 0.142 λ tanh kh


class Tide(NamedTuple):
    """Tensions per metre at one level, N/m; change : ΔP of the pretension; front, back : greatest amplitudes over the
    periods, at periods front_at, back_at, s"""

    level: str
    rise: float
    change: float
    front: float
    back: float
    front_at: float
    back_at: float


class Pretension(NamedTuple):
    """N/m at mean level, of the worse line; given : of the study, or None; least : that keeps both lines taut
    most : that the allowable tension leaves, or None; greatest : (front, back) tension with `used`"""

    given: float | None
    used: float
    least: float
    most: float | None
    greatest: tuple
    slack: list


class Snapping(NamedTuple):
    """Lines that go slack, in time: level, period (s), `mooring.breakwater.snap.Snap`"""

    level: str
    period: float
    found: object


class SeaBehind(NamedTuple):
    """cells : `Cells`; heights : {curve: 4√m₀ behind, m}; transmission : {curve: (m,) |K_T|}

    deviation : (front, back) of tensions of the design curve, N/m, or None; waves : their number
    greatest : (front, back) expected greatest amplitude; slack : share of cycles at the worst level
    tension : (front, back) expected greatest tension at the worst level, N/m; least : pretension that keeps both taut
    """

    cells: Cells
    heights: dict
    transmission: dict
    deviation: tuple | None
    waves: float
    greatest: tuple | None
    slack: tuple | None
    tension: tuple | None = None
    least: float | None = None


class AnchorRow(NamedTuple):
    """needed, provided : in `unit`; utilisation : needed over provided, None where nothing is provided"""

    name: str
    needed: float
    unit: str
    note: str = ""
    provided: float | None = None
    utilisation: float | None = None


class Results(NamedTuple):
    """period : (n,) s; curves : list of `Curve`; tides : list of Tide, None without lines; front : of `pareto`
    lee : of `lee`"""

    period: np.ndarray
    curves: list
    tides: list | None
    pretension: Pretension | None
    sea: SeaBehind | None
    anchors: list
    warned: list
    snapping: Snapping | None = None
    front: object = None
    lee: object = None


def results(breakwater):
    """`Results` of a `Breakwater`.  Raises ValueError."""
    study = breakwater.study
    period = periods(study)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made, left_out = curves(breakwater, 2 * np.pi / period)
        tides = tides_of(breakwater, period) if study.lines is not None else None
        has_tensions = tides is not None and np.isfinite(tides[0].front)
        held = pretension_of(breakwater, tides) if has_tensions else None
        sea = _sea(breakwater, made, tides, held) if study.sea is not None else None
        rows = _anchors(breakwater, period, held) if held is not None else []
    warned = [
        *breakwater.beside(),
        *_breaking(breakwater, period),
        *left_out,
        *dict.fromkeys(str(w.message) for w in caught),
    ]
    warned += _rougher(study, held, sea)
    if study.lines is not None and not has_tensions:
        warned.append(f"holding {design(study)[0]} tells no tension of these lines: no pretension and no anchors")
    return Results(period, made, tides, held, sea, rows, warned, _snapping(breakwater, tides, held))


def _rougher(study, held, sea):
    """What is said where lines carry more in the sea than in the waves that pretension and anchors go by"""
    if sea is None or sea.tension is None:
        return
    over = [(end, s, w) for end, s, w in zip(("front", "back"), sea.tension, held.greatest, strict=True) if s > w]
    if over or sea.least > held.used:
        tensions = "; ".join(f"{end} {s / KN:.4g} kN/m for {w / KN:.4g}" for end, s, w in over)
        yield (
            f"the greatest of {sea.waves:.0f} waves of the sea is rougher than waves of {study.waves.height:g} m, by "
            f"which pretension and anchors go: {tensions or 'lines go slack'}; taut in it takes a pretension of "
            f"{sea.least / KN:.4g} kN/m; give waves.height of the highest wave"
        )


def design(study):
    """(holding, theory) that tensions are of: as given, else the first of the holdings that has lines"""
    held = [holding for holding in study.holdings if holding in ("taut", "elastic")]
    return study.design.holding or (held or study.holdings)[0], study.design.theory


def _breaking(breakwater, period):
    height = breakwater.study.waves.height
    k = wavenumber(2 * np.pi / period, breakwater.depth(0.0), breakwater.study.water.gravity)
    limit = BREAKING * 2 * np.pi / k * np.tanh(k * breakwater.depth(0.0))
    if np.any(breaks := height > limit):
        longest = period[breaks].max()
        yield (
            f"waves of {height:g} m break at {breaks.sum()} of {len(period)} periods, up to {longest:g} s, where "
            f"{limit[breaks].max():.3g} m is the highest (Miche); they are left out of the tensions"
        )


def unbroken(breakwater, period):
    """(n,) whether a wave of the study's height stands at a period"""
    k = wavenumber(2 * np.pi / period, breakwater.depth(0.0), breakwater.study.water.gravity)
    return breakwater.study.waves.height <= BREAKING * 2 * np.pi / k * np.tanh(k * breakwater.depth(0.0))


def tides_of(breakwater, period):
    study, stands = breakwater.study, unbroken(breakwater, period)
    if not stands.any():
        raise ValueError(f"waves.height is {study.waves.height:g} m: waves of every period break; give lower waves")
    made = []
    for level, rise in breakwater.levels:
        curve = response(breakwater, *design(study), rise, 2 * np.pi / period[stands])
        tensions = [abs(P) * study.waves.height / 2 for P in (curve.front, curve.back)]
        worst = [int(np.argmax(P)) for P in tensions]
        front, back = (P[i] for P, i in zip(tensions, worst, strict=True))
        at = period[stands][worst]
        made.append(Tide(level, rise, breakwater.tide_tension(rise), front, back, *at))
    return made


def pretension_of(breakwater, tides):
    lines = breakwater.study.lines
    least = max(0.0, max(sizes.pretension_needed(max(one.front, one.back), -one.change) for one in tides))
    given = breakwater.pretension(0.0)
    used = least if given is None else given
    greatest = tuple(max(used + one.change + getattr(one, end) for one in tides) for end in ("front", "back"))
    most = None
    if lines.allowable_kN is not None:
        most = lines.allowable_kN * KN / lines.spacing - (max(greatest) - used)
    slack = [
        (one.level, end)
        for one in tides
        for end in ("front", "back")
        if given is not None and sizes.goes_slack(given, -one.change, getattr(one, end))
    ]
    return Pretension(given, used, least, most, greatest, slack)


def _snapping(breakwater, tides, held):
    """`Snapping` at the first level where a line goes slack, at the period of its largest tension; None without"""
    lines = breakwater.study.lines
    if held is None or not held.slack or lines.axial_stiffness_kN is None:
        return None
    from hakobune.mooring.breakwater.snap import frequencies, snap

    level, end = held.slack[0]
    tide = next(one for one in tides if one.level == level)
    period, body = getattr(tide, f"{end}_at"), breakwater.taut(tide.rise)
    omega, stiffness = 2 * np.pi / period, lines.axial_stiffness_kN * KN / lines.spacing
    waters = sections(breakwater, breakwater.wetted(tide.rise), tide.rise, frequencies(body, omega))
    return Snapping(level, period, snap(body, waters, stiffness, omega, breakwater.study.waves.height / 2))


def _sea(breakwater, made, tides, held):
    study = breakwater.study
    spectrum = spectrum_of("sea", study.sea, study.water.depth)
    sea = equal_cells(spectrum, SEA_CELLS)
    amplitude, behind, ways = GAUSSIAN * sea.height / 4, {}, ways_of(study, spectrum, sea.omega)
    for curve in made:
        if curve.theory == THEORIES[0] or not np.any(ways):
            behind[curve.name] = in_sea(breakwater, curve, 0.0, sea.omega, amplitude, ways).transmission
        else:
            warnings.warn(f"the sea behind {curve.name} is left out: it has waves along the normal only", stacklevel=2)
    heights = {name: 4 * float(sea.deviation(K)) for name, K in behind.items()}
    waves = positive("sea.duration_hours", study.sea.duration_hours) * 3600 / spectrum.T02
    if held is None:
        return SeaBehind(sea, heights, behind, None, waves, None, None)
    deviations, shares = [], []
    for one in tides:
        curve = in_sea(breakwater, Curve(*design(study), one.level, None), one.rise, sea.omega, amplitude, ways)
        both = [float(sea.deviation(P)) for P in (curve.front, curve.back)]
        deviations.append(both)
        shares.append([slack_share(held.used + one.change, deviation) for deviation in both])
    deviation = tuple(np.max(deviations, axis=0))
    greatest = tuple(float(greatest_of(one, waves)) for one in deviation)
    changes, amplitudes = np.array([[one.change] for one in tides]), greatest_of(np.array(deviations), waves)
    tension = tuple(map(float, np.max(held.used + changes + amplitudes, axis=0)))
    least = max(0.0, max(sizes.pretension_needed(P.max(), -c) for P, (c,) in zip(amplitudes, changes, strict=True)))
    slack = tuple(np.max(shares, axis=0))
    return SeaBehind(sea, heights, behind, deviation, waves, greatest, slack, tension, float(least))


def in_sea(breakwater, curve, rise, omega, amplitude, ways):
    """`Response` (m,) of a `Curve` in moduli, root mean squares over the ways (d, m) rad of the sea's waves"""
    over = [response(breakwater, curve.holding, curve.theory, rise, omega, amplitude, way) for way in ways]
    return Response(*(np.sqrt(np.mean(np.abs(part) ** 2, axis=0)) for part in zip(*over, strict=True)))


def ways_of(study, spectrum, omega, count=WAYS, any_section=False):
    """(d, m) rad, angles with the normal of waves of equal energy at frequencies (m,) rad/s.  Raises StudyError."""
    mean, spread = np.radians(study.sea.obliquity_deg), spreading_of("sea", study.sea, spectrum)
    if not any_section and study.section.shape != "rectangle" and not study.sea.is_normal:
        warnings.warn(
            "waves at an angle are told for rectangles: the sea in two dimensions is taken along the normal",
            stacklevel=2,
        )
        return np.zeros((1, len(omega)))
    if spread is None:
        return np.full((1, len(omega)), mean)
    shares = (np.arange(count) + 0.5) / count
    ways = mean + np.array([spread.quantile(np.full(len(omega), share), omega) for share in shares])
    if np.any(abs(ways) > np.radians(MOST_OBLIQUE)):
        raise StudyError(
            f"sea.spreading sends waves at {np.degrees(abs(ways).max()):.3g}° with the normal; allowed: "
            f"{MOST_OBLIQUE}; give a narrower spreading or less obliquity_deg"
        )
    return ways


def _anchors(breakwater, period, held):
    asked, angle, rows = breakwater.study.anchors, breakwater.angle, []
    if angle >= np.pi / 2 and any((asked.sinker, asked.common_sinker, asked.pile)):
        angle = np.pi - angle
    greatest, room = dict(zip(("front", "back"), held.greatest, strict=True)), _room(breakwater)
    for end, tension in greatest.items():
        if asked.sinker is not None:
            one = asked.sinker
            weight = sizes.sinker(tension, angle, one.friction, one.lifted)
            _check_not_lifted(weight, tension * np.sin(angle))
            rows.append(_sinker_row(f"sinker, {end}", one, weight, room))
        if asked.pile is not None:
            rows.append(_pile_row(end, asked.pile, tension, angle))
        if asked.holding is not None:
            one = asked.holding
            pull = tension * positive("anchors.holding.spacing", one.spacing)
            capacity = (
                positive("anchors.holding.capacity_kN", one.capacity_kN)
                * KN
                / positive("anchors.holding.safety", one.safety)
            )
            rows.append(
                AnchorRow(f"anchor, {end}", pull / KN, "kN", f"every {one.spacing:g} m", capacity / KN, pull / capacity)
            )
    if asked.common_sinker is not None:
        rows.append(_common_row(breakwater, period))
    return rows


def _check_not_lifted(weight, pull):
    if weight < pull:
        raise StudyError(
            f"anchors.sinker: the line pulls up with {pull / KN:.4g} kN/m, more than the {weight / KN:.4g} that keep "
            "it from sliding; give lifted = true"
        )


def _room(breakwater):
    """m under the keel at mean level"""
    return breakwater.study.water.depth - breakwater.study.section.draft


def _sinker_row(name, table, weight, room, note=""):
    height = sizes.sinker_height(weight, table.width, table.unit_weight_kN_per_m3 * KN)
    if height > HIGH_SINKER * room:
        wide = table.width * height / (HIGH_SINKER * room)
        warnings.warn(
            f"{name}: {height:.3g} m high, where the lines are taken to begin on the bed and {room:.3g} m are under "
            f"the keel; allowed: up to {HIGH_SINKER * room:.3g} m; give a width of {wide:.3g} m",
            stacklevel=2,
        )
    note = f"{height:.3g} m high, {table.width:g} m wide{note}"
    given = None if table.weight_kN_per_m is None else positive("weight_kN_per_m", table.weight_kN_per_m) * KN
    use = None if given is None else weight / given
    return AnchorRow(name, weight / KN, "kN/m", note, None if given is None else given / KN, use)


def _pile_row(end, table, tension, angle):
    around = np.pi * positive("anchors.pile.diameter", table.diameter)
    length = positive("anchors.pile.length", table.length)
    cohesion = positive("anchors.pile.cohesion_kPa", table.cohesion_kPa) * KN
    capacity = sizes.pile_capacity(around, length, cohesion, table.safety)
    spacing = sizes.pile_spacing(capacity, tension, angle)
    use = None if table.spacing is None else positive("anchors.pile.spacing", table.spacing) / spacing
    return AnchorRow(f"piles, {end}", spacing, "m apart", f"each holds {capacity / KN:.4g} kN", table.spacing, use)


def _common_row(breakwater, period):
    """One sinker under both lines: the greatest over periods and levels"""
    study, table = breakwater.study, breakwater.study.anchors.common_sinker
    omega = 2 * np.pi / period[unbroken(breakwater, period)]
    greatest, c, s = 0.0, np.cos(breakwater.angle), np.sin(breakwater.angle)
    for _, rise in breakwater.levels:
        curve = response(breakwater, *design(study), rise, omega)
        across, up = (curve.front - curve.back) * c, (curve.front + curve.back) * s
        weight = sizes.common_sinker(across, up, table.friction) * study.waves.height / 2
        buoyancy = 2 * s * (breakwater.pretension(rise) or 0.0)
        greatest = max(greatest, weight.max() + buoyancy)
    note = ", the body's buoyancy held too" if breakwater.study.body is not None else ", without the body's buoyancy"
    return _sinker_row("sinker of both lines", table, greatest, _room(breakwater), note)
