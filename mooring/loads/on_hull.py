"""Wind and current on a hull: six components, from coefficients over all directions and the height of their action.

    F = |U|² c(α),    E₄ = −E₂ Z,    E₅ = E₁ Z,    E₃ = 0            SR179 report (1982), eq. 3.7.1.8

Z : height of the centre of pressure above the point that moments are about.  Wind on a box acts at half the exposed
    height; wind on superstructures acts at their middle. In the report a current has no heeling moment (eq.
    3.7.1.10), as if it acted at the centre of gravity. Here a uniform current has equal pressure over the draft and
    acts at half the draft.

A round hull, for which the report has no tests, is a vertical cylinder: F = ½ρ C_D D d U² along the stream, without a
moment.  In a current C_D is ROUGH, an upper bound. A smooth cylinder has a C_D of 0.65, short cylinders less than
long cylinders (Gonçalves et al., OMAE 2013); columns of OC4 have 0.56 to 0.68 (NREL/TP-5000-60601). Water at rest
only damps the motion; a large C_D would then be unsafe, so STILL is low. Between STILL and ROUGH, C_D follows the
ratio of the speed V of the current to the speed v of the hull. A current that carries the wake away counts as steady:

    C_D = STILL + (ROUGH − STILL) x² (3 − 2x),    x = min(1, V/(STEADY v))

In air C_D comes from the report's table of members.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .box_current import box_table, current_force
from .box_drag import about
from .box_wind import BOX, wind_force
from .coefficients import HullCoefficients, hull_force
from .members import C_D
from .ship_derivatives import tanker_current

# C_D of a rough circular cylinder, post-critical (DNV-RP-C205, 2019, section 6.7), without relief at its ends; API RP
# 2A-WSD has 1.00 to 1.10 with marine growth (commentary on drag coefficients; not held against the print)
ROUGH = 1.05
STEADY = 0.4  # V/v above which C_D is steady, in line (API RP 2A-WSD, commentary on drag coefficients, current/wave
# velocity ratio; not held against the print)
STILL = 0.5  # the same cylinder in an oscillation below a third of its diameter, KC < 2: 0.47 × 1.05 (same section)


@dataclass(frozen=True, eq=False)
class StreamOnHull:
    """Force of a stream over its direction of flow, rad from the bow.

    unit : (…) rad → (…, 3), N s²/m², N s²/m², N s², force amidships at 1 m/s; height : heights of F_x and F_y above
        still water, (2,) m
    notes : remarks on the origin of the coefficients, one line each
    still : fraction of the coefficients that applies where the stream is at rest and the hull moves
    """

    unit: Callable
    height: tuple[float, float]
    notes: tuple[str, ...] = ()
    still: float = 1.0

    def about(self, angle, center):
        """Force and moment at 1 m/s about `center` (3,) m, N s²/m² and N s²; shape (…, 6); center is measured from
        midship at still water
        """
        return heeling(about(self.unit(angle), (0.0, 0.0), center), self.height, center[2])

    def share(self, speed, own):
        """Fraction of the coefficients that applies in a stream of `speed` for speeds `own` of the hull, m/s; 1 for
        a hull at rest
        """
        return drag_share(self.still, speed, own)


def drag_share(still, speed, own):
    """Fraction of C_D that applies in a stream of `speed` for speeds `own` of the hull, m/s; `still` in water at
    rest
    """
    x = np.minimum(1.0, speed / np.maximum(STEADY * np.asarray(own, float), np.finfo(float).tiny))
    return np.where(np.asarray(own) == 0, 1.0, still + (1.0 - still) * x * x * (3.0 - 2.0 * x))


def heeling(load, height, up=0.0):
    """Load (…, 6) about a point `up` m high, from a load (…, 3), N, N, N m, whose forces along and across act at
    heights (2,) m
    """
    x, y, turn = np.moveaxis(load, -1, 0)
    return np.stack([x, y, 0 * x, (up - height[1]) * y, (height[0] - up) * x, turn], axis=-1)


def wind_on(wind, hull):
    """StreamOnHull of a `Wind` on an `ExposedBox`; raises ValueError for a hull with unknown freeboard"""
    table = _of(wind.table, hull)
    if isinstance(table, HullCoefficients):
        middle = 0.5 * table.area_y / table.length
        unit = lambda angle: hull_force(table, 1.0, angle, wind.density)  # noqa: E731
        return StreamOnHull(unit, (_first(wind.height, table.height, middle),) * 2)
    areas = {"front_area": hull.front_area, "side_area": hull.side_area}
    (front, along), (side, across) = silhouettes(hull)
    if hull.is_round and table is BOX:
        less = (1.0 - C_D["cylinder"]) * hull.beam * hull.freeboard  # m², of the areas with C_D 1
        unit = _along_stream(0.5 * wind.density * (front - less), 0.5 * wind.density * (side - less))
        return StreamOnHull(unit, (_first(wind.height, along), _first(wind.height, across)))
    sizes = hull.length, hull.beam, hull.freeboard, wind.density, table
    return StreamOnHull(
        lambda angle: wind_force(1.0, angle, *sizes, **areas), (_first(wind.height, along), _first(wind.height, across))
    )


def current_on(current, hull, density, depth):
    """StreamOnHull of a `Current` (None: water at rest) on an `ExposedBox`; water depth m, density kg/m³"""
    table, height = (None, None) if current is None else (_of(current.table, hull), current.height)
    table = own_table(current, hull, depth) if table is None else table
    if isinstance(table, HullCoefficients):
        unit = lambda angle: hull_force(table, 1.0, angle, density)  # noqa: E731
        return StreamOnHull(unit, (_first(height, table.height, -0.5 * hull.draft),) * 2, table.notes)
    if isinstance(table, RoundDrag):
        pull = 0.5 * density * table.C * hull.beam * hull.draft
        across = _first(height, -0.5 * hull.draft)
        return StreamOnHull(_along_stream(pull, pull), (across,) * 2, table.notes, STILL / table.C)
    sizes = hull.length, hull.beam, hull.draft
    unit = lambda angle: current_force(1.0, angle, *sizes, density, table)  # noqa: E731
    return StreamOnHull(unit, (_first(height, -0.5 * hull.draft),) * 2, table.notes)


class RoundDrag(NamedTuple):
    """C : C_D of a vertical cylinder in a stream of any direction; notes : remarks on the origin of the coefficient"""

    C: float
    notes: tuple[str, ...]


def own_table(current, hull, depth):
    """Coefficients of an `ExposedBox` in a `Current` without coefficients (None: water at rest), at a depth, m: those
    of its type of ship, of the box tests, or RoundDrag"""
    if current is not None and current.ship == "tanker":
        return tanker_current(hull.length, hull.beam, hull.draft, depth)
    if not hull.is_round:
        return box_table(hull.length, hull.beam, hull.draft, depth)
    rest = current is None or current.speed == 0
    C, smooth = (STILL, 0.2) if rest else (ROUGH, 0.65)
    faster = "" if rest else f"; motion above {1 / STEADY:g} times the current is damped by less, down to {STILL:g}"
    return RoundDrag(C, (
        f"current force: C_D {C:g} of a rough cylinder on the round hull, where a smooth one has {smooth:g}{faster}; "
        f"give current coefficients for another",
    ))  # fmt: skip


def _along_stream(x, y):
    """Callable: (…) rad → (…, 3) N s²/m², N s² of forces x from ahead and y from abeam, without a moment"""
    return lambda angle: np.stack([x * np.cos(angle), y * np.sin(angle), 0.0 * np.asarray(angle)], axis=-1)


def _of(table, hull):
    """Coefficients; those that depend on the hull are made for it"""
    return table(hull) if callable(table) else table


def _first(*values):
    """The first argument that is not None"""
    return next(value for value in values if value is not None)


def silhouettes(hull):
    """Exposed areas from ahead and from abeam, and heights of their middles above still water, ((A_f, z), (A_s, z)),
    m² and m

    Superstructures without a given height stand on the deck, over the whole hull.
    raises : ValueError for a hull with unknown freeboard
    """
    if hull.freeboard is None:
        raise ValueError("hull.freeboard is missing; wind acts on the freeboard; give hull.freeboard, or wind.file")
    on_deck = 0.5 * max(hull.front_area / hull.beam, hull.side_area / hull.length)
    middle = hull.freeboard + on_deck if hull.superstructure_z is None else hull.superstructure_z
    boxes = (
        (width * hull.freeboard, more) for width, more in ((hull.beam, hull.front_area), (hull.length, hull.side_area))
    )
    return tuple((box + more, (0.5 * box * hull.freeboard + more * middle) / (box + more)) for box, more in boxes)


def turning_drag(water, length):
    """N₂ of yaw, N m s², due to cross flow on a hull of `length` m that turns on the spot; water : StreamOnHull of
    the current

    M = −¼ ρ C_y(90°) d (L/2)⁴ r|r|      SR179 report (1982), guideline 3.6.5 (its "+" between factors is a product)
    """
    return 0.5 * water.still * abs(float(water.unit(0.5 * np.pi)[1])) / length * (0.5 * length) ** 4
