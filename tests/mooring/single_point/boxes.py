"""Boxes on a buoy for tests: the report's floater A on six chains, and boxes and lines of random proportions."""

import numpy as np

from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.moored_body import leg_at_tension, moored_body
from hakobune.mooring.lines.system.parts import LineType, MooredBody, UniformLine
from hakobune.mooring.loads.box_current import current_force
from hakobune.mooring.loads.box_drag import drag_table
from hakobune.mooring.loads.box_wind import wind_force
from hakobune.mooring.loads.turning import turning_coefficients
from hakobune.mooring.single_point.body import SinglePoint
from hakobune.mooring.single_point.loads import Loads, WaterLoad, WindLoad, isotropic_drift, still_table, turning_table

RHO, TONF, KNOT = 1025.0, 9806.65, 1852 / 3600
ANGLES = np.arange(720) * np.pi / 360


def buoy(headings_deg=(30, 90, 150, -150, -90, -30), depth=14.0, z=-3.0, weight=0.2414 * TONF, tension=15 * TONF,
         length=150.0, stiffness=np.inf):  # fmt: skip
    """System of a buoy on chains with that tension at its top"""
    horizontal = tension - weight * (depth + z)
    kind = LineType("chain", weight, stiffness)
    legs = [
        leg_at_tension(UniformLine(f"line {i}", kind, length, "", ""), (0, 0, z), np.deg2rad(a), depth, horizontal)
        for i, a in enumerate(headings_deg, 1)
    ]
    made = moored_body(legs, depth, (0.0, 0.0, z), RHO, name="buoy")
    held = MooredBody("buoy", (0.0, 0.0, z, 0.0, 0.0, 0.0), ("Surge", "Sway"))
    return System(depth, made.lines, made.points, (held,), RHO)


def turning_water(length, draft, relative_depth, wide=10.0, slender=2.0, speed=0.0, direction=np.pi):
    table = turning_table(turning_coefficients(slender, wide, relative_depth), length, draft, RHO)
    return WaterLoad(table, length, True, speed, direction)


def box_mass(length, beam, draft, added=(0.1, 0.6, 0.4)):
    M = RHO * length * beam * draft
    return np.diag(M * np.array([1 + added[0], 1 + added[1], (1 + added[2]) * (0.28 * length) ** 2]))


def floater_A(current_deg=0.0, hawser=0.0, wind=25.0, height=1.5, knots=1.5):
    """Floater A of the report's series at 14 m; wind and waves from ahead, the current from current_deg"""
    L, B, d, freeboard = 100.0, 50.0, 10.0, 10.0
    water = turning_water(L, d, 1.4, speed=knots * KNOT, direction=np.pi + np.deg2rad(current_deg))
    air = WindLoad(wind_force(np.ones(720), ANGLES, L, B, freeboard), wind, np.pi)
    drift = isotropic_drift(4.988 * TONF * height**2, np.pi)
    return SinglePoint(Loads(water, air, drift), box_mass(L, B, d), [(L / 2, 0.0)], [hawser], buoy())


def random_loads(rng, head_on=False):
    """Loads on a box of random size in wind, current and waves; and its length, beam, draft"""
    L = rng.uniform(50, 300)
    B, relative, wide = L / 2, rng.uniform(1.25, 8), rng.uniform(10, 20)
    d = B / wide
    angles = np.full(3, np.pi) if head_on else rng.uniform(0, 2 * np.pi, 3)
    speed = rng.uniform(0.2, 2.0)
    if head_on or rng.random() < 0.5:
        water = turning_water(L, d, relative, wide, speed=speed, direction=angles[0])
    else:
        places = np.linspace(0, np.pi / 2, 7)
        x, y = np.sort(rng.uniform(0, 2, 7))[::-1], np.sort(rng.uniform(0, 3, 7))
        x[-1] = y[0] = 0.0
        lever = rng.uniform(-0.1, 0.2) * np.sin(2 * places)
        lever[[0, -1]] = 0.0
        table = drag_table(places, x, y, lever)
        unit = current_force(np.ones(720), ANGLES, L, B, d, RHO, table)
        water = WaterLoad(still_table(unit), L, False, speed, angles[0])
    unit = wind_force(np.ones(720), ANGLES, L, B, rng.uniform(0.5, 2) * d)
    wind = WindLoad(unit, rng.uniform(0, 50), angles[1])
    drift = isotropic_drift(rng.uniform(0, 300) * L, angles[2])
    return Loads(water, wind, drift), (L, B, d)


def random_head_on(rng):
    """SinglePoint in which wind, current and waves come from one side, contact buoy or hawser"""
    loads, (L, B, d) = random_loads(rng, head_on=True)
    hawser = 0.0 if rng.random() < 0.4 else rng.uniform(0.1, 1.0) * L
    pull = np.hypot(*loads.at_rest(np.zeros(1))[0, :2])
    depth = rng.uniform(1.3, 4.0) * d + 5.0
    weight = rng.uniform(0.5, 3.0) * pull / 400.0
    spread = rng.uniform(20, 70)
    tension, length = weight * depth * rng.uniform(1.5, 4), rng.uniform(15, 30) * depth
    lines = buoy((spread, -spread, 180 - spread, spread - 180), depth, -2.0, weight, tension, length)
    mass = box_mass(L, B, d, rng.uniform((0.05, 0.2, 0.1), (0.3, 2.0, 2.0)))
    return SinglePoint(loads, mass, [(rng.uniform(0.4, 0.6) * L, 0.0)], [hawser], lines)
