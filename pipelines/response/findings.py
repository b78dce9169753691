"""Findings on a response: failures, and limits of its tables."""

import numpy as np

from hakobune.bem.modes import words_of
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.response.findings import large_rotations
from hakobune.mooring.response.long_term import YEAR
from hakobune.mooring.response.points import KeelPoint, Point, keel_name, relative_name
from hakobune.mooring.response.return_period import probability_not_exceeded

from ..common.units import KN

ONE_BODY = words_of(())
WORTH_NAMING = 1e-3  # estimated error of a result


def turned(quantities, axes):
    """Messages on rotations too large for linear theory, by the largest expected or the return value"""
    largest = quantities.get("response.expected_maximum") or quantities["response.once_in_return_period"]
    rows = zip(axes["response"].values.tolist(), largest.units(), largest.values, strict=True)
    return large_rotations({n: np.degrees(v) for n, unit, v in rows if unit == "rad"})


def failures(result, stiffness, years=None, words=ONE_BODY):
    """Failures of a SeaState, or of a Climate in `years`: a body that capsizes, water on deck, contact with the bed

    stiffness : (n, n) restoring of the body, N m/rad, with its mooring, or None; words : (n,) names of its motions
    """
    for mode in [d for d, word in enumerate(words) if word.split()[-1] in ("roll", "pitch")]:
        if stiffness is not None and stiffness[mode, mode] < 0:
            yield fails(
                f"the body capsizes: its restoring in {words[mode]} is {stiffness[mode, mode] / KN:.4g} kN m/rad"
                ", limit 0; lower its centre of gravity or make it wider"
            )
    for word, gaps, way_out in (
        ("air gap at", air_gaps(result, years), "give more freeboard"),
        ("under keel, at", keel_gaps(result, years), "give more water or less draft"),
    ):
        for name, (gap, left, _) in gaps.items():
            if left < 0:
                yield fails(f"{word} {name}: {left:.3g} m of {gap:.3g} m are left, limit 0; {way_out}")


def air_gaps(result, years=None):
    """{point: (clearance, m, remaining clearance, m, frequency of contact)} for the largest expected rise, or that
    of `years`.

    The frequency is the probability in a SeaState, and the years between two events in a Climate
    """
    if years is None:
        return result.air_gaps()
    points = [p for p in result.points if isinstance(p, Point) and p.clearance is not None]
    return {p.name: _left_in_years(result, relative_name(p), p.clearance, years) for p in points}


def keel_gaps(result, years=None):
    """{point: (clearance, m, remaining clearance, m, frequency of contact)} of points of the bottom, for the largest
    drop
    """
    if years is None:
        return result.under_keel()
    points = [p for p in result.points if isinstance(p, KeelPoint)]
    return {p.name: _left_in_years(result, keel_name(p), p.gap, years) for p in points}


def _left_in_years(result, name, gap, years):
    term = result.long_term(name)
    rate = float(term.crossing_rate(gap)) * YEAR
    return gap, gap - term.level(years * YEAR), 1 / rate if rate > 0 else np.inf


def notes(result, years=None):
    """Notes on the sea, drift, air gap and duration"""
    if years is None:
        lines = [sea_in_words(result), *_of_drift(result.slow), *_gap_lines(result), *_keel_lines(result)]
        named = result.errors.named(WORTH_NAMING)
        return lines + ([f"estimated errors between stored waves: {', '.join(named)}"] if named else [])
    lines = [f"{len(result.height)} sea states"]
    if years > 1:
        q = 100 * probability_not_exceeded(years, years)
        lines.append(
            f"the value reached once in {years:g} years is not exceeded in {years:g} years with a "
            f"probability of {q:.0f} %"
        )
    return [*lines, *_gaps_in_years(result, years), *_keel_in_years(result, years)]


def _of_drift(slow):
    if slow is None:
        return ["no drift: the database has no drift_force"]
    lines = [f"slow drift: difference frequencies up to {slow.difference[-1]:g} rad/s"]
    if slow.by_current is not None:
        lines.append('current.waves = "still" excludes the change of drift by the current')
    if slow.damping is None:
        lines.append("wave drift damping is left out: it needs stored headings on both sides of the wave direction")
    return lines


def sea_in_words(result):
    """Spectrum, direction and duration of a SeaState"""
    systems = getattr(result.sea, "systems", (result.sea,))
    whole = f"together {result.sea.spectrum.significant_height:.4g} m, " if len(systems) > 1 else ""
    return f"{' and '.join(map(system_in_words, systems))}, {whole}{result.duration / 3600:.3g} h"


def system_in_words(sea):
    """Spectrum, height, period, direction and spreading of one system of waves"""
    s = sea.spectrum
    crests = "long-crested" if sea.spreading is None else str(sea.spreading)
    return (
        f"{s.name} spectrum, {s.significant_height:.4g} m, T01 {s.T01:.4g} s, travelling to "
        f"{np.degrees(sea.direction) % 360:.4g}°, {crests}"
    )


def _gaps_in_years(result, years):
    """Air gap of points with a clearance in a Climate"""
    for point in (p for p in result.points if isinstance(p, Point) and p.clearance is not None):
        term = result.long_term(relative_name(point))
        left = point.clearance - term.level(years * YEAR)
        yield (
            f"air gap at {point.name}: the rise reached once in {years:g} years leaves {left:.3g} of "
            f"{point.clearance:.3g} m; water reaches the point {_often(term, point.clearance)}; "
            f"{_whose_waves(result)}"
        )


def _keel_lines(result):
    """The point of the bottom with the smallest clearance in a SeaState"""
    found = result.under_keel()
    if found:
        name = min(found, key=lambda name: found[name][1])
        gap, left, touched = found[name]
        hours = result.duration / 3600
        yield (
            f"under keel: the largest drop leaves {left:.3g} of {gap:.3g} m at {name}, the least of all points; the "
            f"hull touches the bed with probability {touched:.3g} in {hours:.3g} h; this includes waves only, not squat"
        )


def _keel_in_years(result, years):
    points = [point for point in result.points if isinstance(point, KeelPoint)]
    if points:
        terms = {point: result.long_term(keel_name(point)) for point in points}
        worst = min(points, key=lambda point: point.gap - terms[point].level(years * YEAR))
        left = worst.gap - terms[worst].level(years * YEAR)
        yield (
            f"under keel: the drop reached once in {years:g} years leaves {left:.3g} of {worst.gap:.3g} m at "
            f"{worst.name}, "
            f"the least of all points; the hull touches the bed {_often(terms[worst], worst.gap)}; this includes waves "
            "only, not squat"
        )


def _often(term, level):
    rate = float(term.crossing_rate(level)) * YEAR
    return f"once in {1 / rate:.3g} years" if rate * 1e6 > 1 else "less than once in a million years"


def _whose_waves(result):
    """Which waves are included in the elevation at points of a SeaState or Climate"""
    if result.missed is None:
        return "waves scattered and radiated by the body are not included: the database has no Kochin functions"
    return (
        "this includes the waves that the body scatters and radiates, except waves that decay within a depth or wave "
        "length of it"
    )


def _gap_lines(result):
    for name, (clearance, left, reached) in result.air_gaps().items():
        yield (
            f"air gap at {name}: the largest rise leaves {left:.3g} of {clearance:.3g} m; water reaches the "
            f"point with probability {reached:.3g}; {_whose_waves(result)}"
        )
