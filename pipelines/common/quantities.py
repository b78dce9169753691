"""Quantities of a study file in SI, and the one-line message for an impossible value.

A quantity outside SI has its unit in the key: `speed_knots`, `pretension_tonf`.  Wind, current and waves have either
`direction_deg`, the direction of travel, 0 → +x, or `incidence_deg`, the angle χ of the reports, 0 from ahead:
direction = incidence + 180°.
"""

import math

import msgspec

from .units import KNOT, TONF

DEEPEST = 12_000.0  # m, the deepest sea
LONGEST = 1e5  # m, a line
HEAVIEST = 1e6  # N/m, chain of 2 m diameter
ROUGHEST = 5.0  # coefficient of friction
DENSITIES = 900.0, 1300.0  # kg/m³ of water, from fresh and warm to the Dead Sea


RADIANS = math.pi / 12, 0.0051, 0.5  # step of headings in radians, how far two decimals miss it, step of degrees


class StudyError(ValueError):
    """A study cannot be used; the message names the key, its value and the allowed values."""


class Table(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    pass


def positive(key, value):
    if not 0 < value < math.inf:
        raise StudyError(f"{key} is {value:g}; allowed: above 0, finite")
    return value


def below(key, value, limit, why=""):
    """The value, above 0 and at most `limit`.  Raises StudyError."""
    if not 0 < value <= limit:
        raise StudyError(f"{key} is {value:g}; allowed: above 0, at most {limit:g}{why}")
    return value


def level_of(key, value):
    """One of `mooring.response.pair_levels.LEVELS`.  Raises StudyError."""
    from hakobune.mooring.response.pair_levels import LEVELS

    if value not in LEVELS:
        raise StudyError(f"{key} is {value!r}; allowed levels: {', '.join(LEVELS)}")
    return value


def friction(key, value):
    """The coefficient of friction, 0 to ROUGHEST.  Raises StudyError."""
    if not 0 <= value <= ROUGHEST:
        raise StudyError(f"{key} is {value:g}; allowed: 0 to {ROUGHEST:g}")
    return value


def water_depth(key, value):
    """Water depth, m, above 0 and at most DEEPEST. Raises StudyError."""
    return below(key, value, DEEPEST, ", the deepest sea")


def water_density(key, value):
    """Density of water, kg/m³. Raises StudyError."""
    low, high = DENSITIES
    if not low <= value <= high:
        raise StudyError(f"{key} is {value:g}; allowed: {low:g} to {high:g} kg/m³, as for water")
    return value


def one_of(where, table, units, required=False):
    """The value, in SI, of the only given key of `units` {key: factor}; None if no key is given and none is
    required.
    """
    given = [key for key in units if getattr(table, key) is not None]
    if len(given) > 1 or (required and not given):
        state = " and ".join(given) + " are given" if given else "nothing is given"
        raise StudyError(f"{where}: {state}; give one of {', '.join(units)}")
    return positive(f"{where}.{given[0]}", getattr(table, given[0])) * units[given[0]] if given else None


def force(where, table, name, required=False):
    return one_of(where, table, {f"{name}_tonf": TONF, f"{name}_kN": 1e3}, required)


def speed(where, table):
    """Speed, m/s, at least 0"""
    if table.speed == 0 and table.speed_knots is None:
        return 0.0
    return one_of(where, table, {"speed": 1.0, "speed_knots": KNOT}, required=True)


def waves_on(current):
    """Effect of a table's current on waves.  Raises StudyError."""
    from hakobune.mooring.on_current.waves import SPECTRA

    if current.waves not in SPECTRA:
        raise StudyError(f"current.waves is {current.waves!r}; allowed: {', '.join(SPECTRA)}")
    return current.waves


def in_radians(key, degrees):
    """A message if all nonzero values of a key in degrees look like multiples of 15° in radians, such as 0.52 and
    1.57; else []
    """
    step, near, whole = RADIANS
    given = [abs(value) for value in degrees if value]
    fits = all(
        abs(value - step * round(value / step)) < near and abs(value - whole * round(value / whole)) > 1e-9
        for value in given
    )
    if not (given and fits and max(given) <= 2 * math.pi + near):
        return []
    shown = ", ".join(f"{value:g}" for value in degrees)
    turned = ", ".join(f"{round(math.degrees(value)):g}" for value in degrees)
    return [f"{key} is {shown}, in degrees; if radians are meant, give {turned}"]


def direction(where, table):
    """rad travelled to"""
    to, incidence = table.direction_deg, table.incidence_deg
    if (to is None) == (incidence is None):
        state = "neither is given" if to is None else "both are given"
        raise StudyError(f"{where}: {state}; give one of direction_deg, incidence_deg")
    degrees = incidence + 180.0 if to is None else to
    if not -360 <= degrees <= 720:
        key = "incidence_deg" if to is None else "direction_deg"
        raise StudyError(f"{where}.{key} is {getattr(table, key):g}; allowed: −360 to 360")
    return math.radians(degrees % 360.0)
