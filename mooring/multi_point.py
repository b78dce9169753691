"""Multi-point mooring by the simplified method of the SR179 report (1982), section 5.1.1.

Natural periods come first: the method is not on the safe side where one of them lies near the wave period.
Then steady forces of wind, current and wave drift, the position in which the lines balance them, and there the
motion of the freely floating body in a regular wave of the significant height and mean period.  All modes are
taken in phase, with the signs, per line, that pull the fairlead outward and up; statics give the tension.
The body is small-angled throughout: loads and motions are those of its heading at rest.  Slow drift of irregular
waves is not in the method.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .environment.between_waves import between_frequencies, between_headings, mean_drift, motion_amplitudes
from .equilibrium import Equilibrium, displaced, find_equilibrium, mooring_load
from .layout import Layout
from .lines.catenary.solve import LineSolution, State
from .loads.box_current import box_table, current_force
from .loads.box_drag import DragTable, about
from .loads.box_wind import AIR_DENSITY, BOX, wind_force
from .natural_periods import NaturalPeriods, natural_periods

RESONANCE = (0.7, 1.5)  # natural period over wave period; outside, a light mode is amplified below 2
ROLLING = 1e-4  # rad per m of wave amplitude; less is rounding in waves that do not roll the body
ROLL = (0.85, 1.15)  # of the wave period; there roll without viscous damping is several times too large
NEGLIGIBLE = 0.05  # mooring over hydrostatic stiffness, where free motions are used
TURNED = 0.1  # rad; over that angle the drag coefficients of a box change by a tenth of their largest values
SHALLOW = 20.0  # m; SR179 report, section 5.5.3: there some simulations of its floaters exceeded this method
HORIZONTAL = ("Surge", "Sway", "Yaw")


@dataclass(frozen=True)
class Hull:
    """A box: length, beam, draft and freeboard (depth of the hull less draft), m, its middle at x = y = 0."""

    length: float
    beam: float
    draft: float
    freeboard: float


@dataclass(frozen=True)
class Wind:
    """speed m/s, direction rad blown to, density kg/m³"""

    speed: float
    direction: float
    density: float = AIR_DENSITY
    table: DragTable = BOX


@dataclass(frozen=True)
class Current:
    """speed m/s, direction rad flown to; without a table the box tests of the report are used"""

    speed: float
    direction: float
    table: DragTable | None = None


@dataclass(frozen=True)
class Waves:
    """height m, significant; period s, mean; direction rad travelled to"""

    height: float
    period: float
    direction: float


@dataclass(frozen=True)
class Conditions:
    """What a study applies; a load that is None is left out."""

    wind: Wind | None = None
    current: Current | None = None
    waves: Waves | None = None


@dataclass(frozen=True)
class MultiPoint:
    """Result of a study; per-line arrays follow the layout.

    at_rest, at_equilibrium : natural periods without and with the steady forces
    loads : {"wind", "current", "drift": (3,)} N, N, N m about the rotation centre
    rest, extreme : lines at rest and at the largest displacement; `equilibrium` has them under steady forces
    amplitudes : (6,) m, rad; outward, upward : (n,) m, largest displacement of each fairlead
    """

    layout: Layout
    conditions: Conditions
    allowable: float
    at_rest: NaturalPeriods
    at_equilibrium: NaturalPeriods
    loads: dict
    rest: LineSolution
    equilibrium: Equilibrium
    amplitudes: np.ndarray
    outward: np.ndarray
    upward: np.ndarray
    extreme: LineSolution
    warnings: tuple[str, ...]

    def __repr__(self):
        worst = int(np.argmax(self.tension))
        return (
            f"<MultiPoint {len(self.layout)} lines, largest tension {self.tension[worst]:.4g} N "
            f"in {self.layout.names[worst]}, {self.utilisation.max():.3g} of breaking load>"
        )

    @cached_property
    def tension(self):
        """(n,) N, largest at each fairlead"""
        return self.extreme.tension_fairlead

    @cached_property
    def utilisation(self):
        """(n,) largest tension over breaking load; infinite beyond reach, 0 where no breaking load is given"""
        finite = np.where(np.isfinite(self.tension), self.tension, 0.0)
        return np.where(np.isfinite(self.tension), finite / self.layout.breaking_load, np.inf)

    @cached_property
    def acceptable(self):
        """Whether every line stays within the allowable fraction of its breaking load."""
        return bool(np.all(self.utilisation <= self.allowable))


def multi_point(db, layout, hull, conditions, depth, allowable=0.4) -> MultiPoint:
    """Study of a body, its stored wave database `db`, and its lines.

    depth : m, water depth of the study; allowable : fraction of the breaking load
    raises : ValueError naming what does not fit or has no solution
    """
    _check(db, layout, hull, depth, allowable)
    conditions = _with_coefficients(conditions, hull, depth)
    center = np.asarray(db.rotation_center, float)
    rest = mooring_load(layout, (0.0, 0.0, 0.0), center, "raise")
    at_rest = _periods(db, rest.stiffness)
    loads = steady_loads(db, hull, conditions, depth)
    equilibrium = find_equilibrium(layout, sum(loads.values(), np.zeros(3)), center)
    at_equilibrium = _periods(db, equilibrium.stiffness)
    amplitudes = np.zeros(6)
    if conditions.waves:
        w = conditions.waves
        amplitudes = motion_amplitudes(db, w.height, w.period, w.direction)
    outward, upward = fairlead_displacements(layout, equilibrium, amplitudes, center)
    moved = equilibrium.points + np.column_stack([outward[:, None] * equilibrium.outward, upward])
    extreme, _ = layout.solve(moved)
    result = MultiPoint(
        layout,
        conditions,
        allowable,
        at_rest,
        at_equilibrium,
        loads,
        rest.lines,
        equilibrium,
        amplitudes,
        outward,
        upward,
        extreme,
        (),
    )
    return replace(result, warnings=tuple(findings(result, db)))


def steady_loads(db, hull, conditions, depth):
    """{"wind", "current", "drift"} of the conditions that are given, each (3,) N, N, N m about the rotation centre.

    Wind and current are taken at the heading of the body at rest.
    """
    loads, middle = {}, (0.0, 0.0)
    if conditions.wind:
        w = conditions.wind
        force = wind_force(w.speed, w.direction, hull.length, hull.beam, hull.freeboard, w.density, w.table)
        loads["wind"] = about(force, middle, db.rotation_center)
    if conditions.current:
        c = conditions.current
        force = current_force(c.speed, c.direction, hull.length, hull.beam, hull.draft, db.density, c.table, depth)
        loads["current"] = about(force, middle, db.rotation_center)
    if conditions.waves:
        w = conditions.waves
        loads["drift"] = mean_drift(db, w.height, w.period, w.direction)
    return loads


def fairlead_displacements(layout, equilibrium, amplitudes, center):
    """Largest displacement of each fairlead outward along its line and upward, all modes in phase: two (n,) m.

    Σⱼ |Dⱼ| Xⱼ with Dⱼ the displacement per unit of mode j; signs are chosen for each line and direction.
    The sum is an upper bound of the displacement; how far it is above depends on `center`, to which the motions refer.
    """
    moved = displaced(np.asarray(center)[None, :], equilibrium.position, center)[0]
    arm = equilibrium.points - moved
    turns = np.stack([np.cross(axis, arm) for axis in np.eye(3)])
    shifts = np.broadcast_to(np.eye(3)[:, None, :], (3, *arm.shape))
    modes = np.concatenate([shifts, turns])
    along = np.einsum("jni,ni->jn", modes[..., :2], equilibrium.outward)
    return np.abs(along).T @ amplitudes, np.abs(modes[..., 2]).T @ amplitudes


def findings(result, db):
    """What a reader of the result has to know: one line each, with the number and its limit."""
    waves, current = result.conditions.waves, result.conditions.current
    if current:
        yield from current.table.notes
    if waves:
        yield from _interpolated(db, waves)
        yield from resonances(result, waves.period)
        if db.has_viscous_motions:
            yield "motions and drift hold the viscous damping of the wave height in the database's scene"
        else:
            yield from _rolling(result, waves)
        yield from _stiff_modes(result, np.asarray(db.hydrostatic_stiffness, float))
    yield from _held(result.at_rest)
    yield from _outside_the_method(result, db.water_depth)
    yield from _line_findings(result)


def _check(db, layout, hull, depth, allowable):
    for name in ("length", "beam", "draft", "freeboard"):
        if not 0 < getattr(hull, name) < np.inf:
            raise ValueError(f"hull {name} is {getattr(hull, name):g} m; allowed: above 0")
    if not abs(depth - db.water_depth) <= 1e-6 * depth:
        raise ValueError(f"the study is for {depth:g} m of water, its database for {db.water_depth:g} m")
    low = layout.anchors[:, 2]
    if np.any(np.abs(low + depth) > 1e-6 * depth):
        worst = int(np.argmax(np.abs(low + depth)))
        raise ValueError(f"line {layout.names[worst]}: anchor z = {low[worst]:g} m; allowed: the bed at {-depth:g} m")
    if not 0 < allowable <= 1:
        raise ValueError(f"allowable fraction is {allowable:g}; allowed: above 0, at most 1")
    if db.inertia_matrix is None or db.hydrostatic_stiffness is None:
        raise ValueError("the database has no inertia of the body; give --gyration kxx,kyy,kzz and solve again")


def _with_coefficients(conditions, hull, depth):
    """The same conditions; a current without coefficients gets those of the box tests."""
    if conditions.current is None or conditions.current.table is not None:
        return conditions
    table = box_table(hull.length, hull.beam, hull.draft, depth)
    return replace(conditions, current=replace(conditions.current, table=table))


def _periods(db, stiffness):
    db.require("added_mass")
    try:
        limit = db["added_mass_zero"]
    except ValueError:
        limit = None
    total = np.asarray(db.hydrostatic_stiffness, float) + stiffness
    return natural_periods(db.omega, db["added_mass"], db.inertia_matrix, total, limit)


def _interpolated(db, waves):
    """What is a linear guess between stored waves.

    On a box of 100 m × 50 m × 10 m at 8 to 14 s most motions in the middle of a gap of 30° are 5 to 40 % off, small
    ones more, and drift in the middle of a second next to the natural period of roll up to a factor of two.
    """
    i, j, share = between_frequencies(db.omega, waves.period)
    if share > 0:
        low, high = (2 * np.pi / db.omega[n] for n in (j, i))
        yield (
            f"wave period {waves.period:g} s lies between the stored {low:.4g} and {high:.4g} s: drift is a linear "
            "guess there, poor near a resonance; add the period to the scene and solve again"
        )
    m, n, share = between_headings(db.wave_direction, waves.direction)
    if share > 0:
        to, low, high = (np.rad2deg(v) for v in (waves.direction, db.wave_direction[m], db.wave_direction[n]))
        yield (
            f"wave direction {to:.4g}° lies between the stored {low:.4g}° and {high:.4g}°: motions and drift are "
            "linear guesses there; add the direction to the scene and solve again"
        )


def resonances(result, wave_period):
    low, high = RESONANCE
    for state, periods in (("at rest", result.at_rest), ("under the steady forces", result.at_equilibrium)):
        near = [
            f"{name} {value:.3g} s"
            for name, value in zip(periods.names, periods.period, strict=True)
            if name in HORIZONTAL and low <= value / wave_period <= high
        ]
        if near:
            yield (
                f"natural periods {state} near the wave period {wave_period:g} s: {', '.join(near)} lie within "
                f"{low:g} to {high:g} of it; free motions underestimate the tension, simulate in time"
            )


def _rolling(result, waves):
    period = result.at_equilibrium.period[result.at_equilibrium.names.index("Roll")]
    rolls = result.amplitudes[3] > ROLLING * 0.5 * waves.height
    if rolls and ROLL[0] <= period / waves.period <= ROLL[1]:
        yield (
            f"natural period of roll {period:.3g} s lies within {ROLL[0]:g} to {ROLL[1]:g} of the wave period "
            f"{waves.period:g} s: its amplitude {result.amplitudes[3]:.2g} rad has no viscous damping; "
            "motion, drift and tension are too large"
        )


def _stiff_modes(result, hydrostatic):
    k = np.diag(result.equilibrium.stiffness)
    for i, name in ((2, "heave"), (3, "roll"), (4, "pitch")):
        ratio = k[i] / hydrostatic[i, i] if hydrostatic[i, i] > 0 else np.inf
        if ratio > NEGLIGIBLE:
            yield (
                f"{name}: mooring stiffness is {ratio:.2g} of the hydrostatic, limit {NEGLIGIBLE:g}; "
                "motions of the freely floating body are too large there"
            )


def _held(periods):
    held = [
        f"{name} {value:.3g} s"
        for name, value, inside in zip(periods.names, periods.period, periods.inside, strict=True)
        if not inside and np.isfinite(value)
    ]
    if held:
        yield f"natural periods outside the solved frequencies, with added mass of the nearest one: {', '.join(held)}"
    unstable = [n for n, value in zip(periods.names, periods.period, strict=True) if np.isnan(value)]
    if unstable:
        yield f"unstable without waves: {', '.join(unstable)}; the body needs more restoring"


def _outside_the_method(result, depth):
    turn = abs(result.equilibrium.position[2])
    if turn > TURNED:
        yield (
            f"the steady forces turn the body by {turn:.2g} rad, limit {TURNED:g}: they and the motions are those "
            "of its heading at rest"
        )
    if result.conditions.waves and depth <= SHALLOW:
        yield (
            f"water depth {depth:g} m is not above {SHALLOW:g} m: there simulations in heavy seas exceed this "
            "method (SR179 report, section 5.5.3); simulate in time"
        )


def _line_findings(result):
    names, lines = np.array(result.layout.names), result.extreme
    rest, mean = result.rest, result.equilibrium.lines
    beyond = lines.status == State.BEYOND_REACH
    groups = (
        (rest.status == State.SLACK, "slack at rest"),
        ((mean.status == State.SLACK) & (rest.status != State.SLACK), "slack under the steady forces"),
        ((mean.vertical_anchor > 0) & ~beyond, "lifting the anchor under the steady forces"),
        (
            (lines.vertical_anchor > 0) & (mean.vertical_anchor <= 0) & ~beyond,
            "lifting the anchor at the largest tension",
        ),
        (beyond, "beyond reach at the largest displacement: an inextensible line cannot follow, give its EA"),
        ((result.utilisation > 1) & ~beyond, "beyond the breaking load"),
        (
            (result.utilisation > result.allowable) & (result.utilisation <= 1),
            f"above the allowable {result.allowable:g} of the breaking load",
        ),
    )
    for chosen, text in groups:
        if np.any(chosen):
            yield f"{chosen.sum()} of {len(names)} lines {text}: {', '.join(names[chosen])}"
