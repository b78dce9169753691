"""A study of a breakwater, read and checked; every fault is one line with the key, the value and the allowed values."""

from pathlib import Path

import numpy as np

from ..common.bounds import check_count
from ..common.quantities import StudyError, positive, water_density, water_depth
from ..common.typed import typed
from ..common.weather.seas import spectrum_of, spreading_of
from ..site.link import BREAKWATER, read_study_at_site
from .tables import THEORIES, AnchorsTable, BreakwaterStudy, SpanTable

SHAPES = {"rectangle": ("beam", "height"), "circle": ("diameter",), "outline": ("points",)}
MOST_PERIODS = 1000
SHORTEST, LONGEST = 0.05, 1000.0  # s
LARGEST_LOSS = 1e4
MOST_OBLIQUE = 85  # degrees
MOST_UNITS = 30


def read_breakwater(path):
    """The BreakwaterStudy of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_study_at_site(Path(path), "a study of a breakwater", BREAKWATER)
    return make_breakwater(raw), text


def make_breakwater(raw):
    """The BreakwaterStudy of nested dictionaries read from TOML.  Raises StudyError."""
    study = typed(raw, BreakwaterStudy, StudyError)
    _check_water(study.water)
    _check_section(study.section)
    _check_names(study)
    if study.lines is not None:
        _check_lines(study.lines)
    _check_anchors(study.anchors)
    positive("waves.height", study.waves.height)
    _check_directions(study)
    if study.loss is not None and not 0 <= study.loss.coefficient <= LARGEST_LOSS:
        raise StudyError(f"loss.coefficient is {study.loss.coefficient:g}; allowed: 0 to {LARGEST_LOSS:g}")
    periods(study)
    if study.sea is not None:
        spreading_of("sea", study.sea, spectrum_of("sea", study.sea, study.water.depth))
        positive("sea.duration_hours", study.sea.duration_hours)
    _check_needs(study)
    if study.optimisation is not None:
        _check_optimisation(study)
    if study.map is not None:
        _check_map(study)
    return study


def _check_directions(study):
    for key in ("waves", "sea"):
        table = getattr(study, key)
        if table is not None and not -MOST_OBLIQUE <= table.obliquity_deg <= MOST_OBLIQUE:
            raise StudyError(
                f"{key}.obliquity_deg is {table.obliquity_deg:g}; allowed: {-MOST_OBLIQUE} to {MOST_OBLIQUE}"
            )
    if study.loss is not None and (study.waves.obliquity_deg or (study.sea is not None and not study.sea.is_normal)):
        raise StudyError("loss is given with waves at an angle, but it is valid for waves along the normal only")


def periods(study):
    """Wave periods of a study, ascending, s; shape (n,).  Raises StudyError."""
    given = study.waves.periods
    if isinstance(given, SpanTable):
        check_count("waves.periods", given.count, 2, MOST_PERIODS, StudyError)
        given = np.linspace(given.first, given.last, given.count).tolist()
    check_count("waves.periods", len(given), 1, MOST_PERIODS, StudyError)
    wrong = [T for T in given if not SHORTEST <= T <= LONGEST]
    if wrong:
        raise StudyError(f"waves.periods has {wrong[0]:g} s; allowed: {SHORTEST:g} to {LONGEST:g}")
    return np.unique(given)


def _check_water(water):
    water_depth("water.depth", water.depth)
    water_density("water.density", water.density)
    positive("water.gravity", water.gravity)
    if not 0 <= water.tide < water.depth:
        raise StudyError(f"water.tide is {water.tide:g} m; allowed: 0 to below the depth of {water.depth:g} m")


def _check_section(section):
    if section.shape not in SHAPES:
        raise StudyError(f"section.shape is {section.shape!r}; allowed: {', '.join(SHAPES)}")
    needed = SHAPES[section.shape]
    for key in ("beam", "height", "diameter", "points"):
        value = getattr(section, key)
        if key in needed and value is None:
            raise StudyError(f"section.{key} is missing; the shape {section.shape} needs {' and '.join(needed)}")
        if key not in needed and value is not None:
            raise StudyError(f"section.{key} is given; the shape {section.shape} has {' and '.join(needed)} only")
        if value is not None and key != "points":
            positive(f"section.{key}", value)
    for place, point in enumerate(section.points or []):
        if len(point) not in (2, 3):
            raise StudyError(f"section.points[{place}] has {len(point)} numbers; allowed: y, z, or y, z and bulge")
    positive("section.draft", section.draft)


def _check_names(study):
    from hakobune.mooring.breakwater.holdings import HOLDINGS

    asked = [("holdings", study.holdings, HOLDINGS), ("theories", study.theories, THEORIES)]
    for key, values, known in asked:
        check_count(key, len(values), 1, len(known), StudyError)
        wrong = [value for value in values if value not in known]
        if wrong or len(set(values)) < len(values):
            raise StudyError(f"{key} has {(wrong or values)[0]!r}; allowed: each of {', '.join(known)}, once")
    if study.design.holding is not None and study.design.holding not in study.holdings:
        raise StudyError(f"design.holding is {study.design.holding!r}; allowed: {', '.join(study.holdings)}")
    if study.design.theory not in THEORIES:
        raise StudyError(f"design.theory is {study.design.theory!r}; allowed: {', '.join(THEORIES)}")


def _check_lines(lines):
    if not 0 < lines.angle_deg < 180:
        raise StudyError(f"lines.angle_deg is {lines.angle_deg:g}; allowed: above 0 and below 180")
    for key in ("attachment", "length", "spacing", "allowable_kN", "axial_stiffness_kN"):
        value = getattr(lines, key)
        if value is not None:
            positive(f"lines.{key}", value)
    if not 0 <= lines.attachment_height < np.inf:
        raise StudyError(f"lines.attachment_height is {lines.attachment_height:g}; allowed: 0 or more, finite")
    if lines.pretension_kN_per_m is not None and not 0 <= lines.pretension_kN_per_m < np.inf:
        raise StudyError(f"lines.pretension_kN_per_m is {lines.pretension_kN_per_m:g}; allowed: 0 or more, finite")


def _check_anchors(anchors):
    for name in AnchorsTable.__struct_fields__:
        table = getattr(anchors, name)
        for key in () if table is None else table.__struct_fields__:
            value = getattr(table, key)
            if value is not None and not isinstance(value, bool):
                positive(f"anchors.{name}.{key}", value)


def _check_needs(study):
    body, lines = study.body, study.lines
    for holding in study.holdings:
        if holding != "fixed" and body is None:
            raise StudyError(
                f"body is missing; the holding {holding} needs center_of_gravity, gyration and the weight in [body]: "
                "mass_t_per_m or free_draft, or lines.pretension_kN_per_m in place of them"
            )
        if holding in ("taut", "elastic") and lines is None:
            raise StudyError(f"lines is missing; the holding {holding} needs angle_deg and attachment")
        if holding == "elastic" and lines.axial_stiffness_kN is None:
            raise StudyError("lines.axial_stiffness_kN is missing; the holding elastic needs it")
        if holding not in ("fixed", "taut") and study.theories == ["long waves"]:
            raise StudyError(f"holdings has {holding!r}; the theory of long waves covers fixed and taut only")
    if body is None:
        return
    positive("body.gyration", body.gyration)
    if not np.isfinite(body.center_of_gravity):
        raise StudyError(f"body.center_of_gravity is {body.center_of_gravity:g}; allowed: finite")
    weights = {
        "body.mass_t_per_m": body.mass_t_per_m,
        "body.free_draft": body.free_draft,
        "lines.pretension_kN_per_m": None if lines is None else lines.pretension_kN_per_m,
    }
    given = [key for key, value in weights.items() if value is not None]
    if len(given) != 1:
        state = "nothing is given" if not given else " and ".join(given) + " are given"
        raise StudyError(f"the body's weight: {state}; give one of {', '.join(weights)}")
    if not given[0].startswith("lines"):
        positive(given[0], weights[given[0]])


def _check_map(study):
    asked = study.map
    if asked.period is None and study.sea is None:
        raise StudyError("map needs waves; give map.period or [sea]")
    if asked.period is not None:
        positive("map.period", asked.period)
    check_count("map.units", asked.units, 1, MOST_UNITS, StudyError)
    check_count("map.points", asked.points, 2, 401, StudyError)
    if not (0 < asked.gap < np.inf if asked.units > 1 else asked.gap == 0):
        state = "above 0 between units" if asked.units > 1 else "0 with one unit"
        raise StudyError(f"map.gap is {asked.gap:g} m; allowed: {state}")
    for key in ("x", "y"):
        ends = getattr(asked, key)
        if ends is not None and not -np.inf < ends[0] < ends[1] < np.inf:
            raise StudyError(f"map.{key} is from {ends[0]:g} to {ends[1]:g} m; allowed: rising, finite")
    if study.loss is not None:
        raise StudyError(
            "map and loss are both given; a map is computed from a database, which has no loss; leave out one of them"
        )


def _check_optimisation(study):
    asked = study.optimisation
    if study.lines is None or study.lines.length is not None:
        raise StudyError("optimisation needs [lines] to the bed, without a length")
    if study.section.shape == "outline":
        raise StudyError("optimisation needs a rectangle or a circle; section.shape is 'outline'")
    ranges = {key: getattr(asked, key) for key in ("draft", "width", "angle_deg") if getattr(asked, key) is not None}
    if not ranges:
        raise StudyError("optimisation has no range; give draft, width or angle_deg as [from, to]")
    for key, (first, last) in ranges.items():
        if not 0 < first < last < np.inf:
            raise StudyError(f"optimisation.{key} is from {first:g} to {last:g}; allowed: above 0, rising")
    if not 4 <= asked.samples <= 4096 or asked.samples & (asked.samples - 1):
        raise StudyError(f"optimisation.samples is {asked.samples}; allowed: a power of two from 4 to 4096")
    if not 1 <= asked.limits <= 100:
        raise StudyError(f"optimisation.limits is {asked.limits}; allowed: 1 to 100")
