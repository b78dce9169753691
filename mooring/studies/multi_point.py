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

from ..environment.between_waves import motion_amplitudes
from ..equilibrium import Equilibrium, displaced, find_equilibrium, mooring_load
from ..layout import Layout
from ..lines.catenary.solve import LineSolution
from .conditions import Conditions
from .multi_point_findings import findings
from .natural_periods import NaturalPeriods, natural_periods
from .steady_loads import steady_loads, with_coefficients


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
    conditions = with_coefficients(conditions, hull, depth)
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


def _periods(db, stiffness):
    db.require("added_mass")
    try:
        limit = db["added_mass_zero"]
    except ValueError:
        limit = None
    total = np.asarray(db.hydrostatic_stiffness, float) + stiffness
    return natural_periods(db.omega, db["added_mass"], db.inertia_matrix, total, limit)
