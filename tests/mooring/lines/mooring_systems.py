"""Mooring systems of tests: bodies, buoys, sinkers and lines of several parts, some of them published."""

import numpy as np

from hakobune.bem import DOFS
from hakobune.mooring.lines.system.equilibrium import moved
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import (
    Anchor,
    Fairlead,
    FreePoint,
    LineType,
    MooredBody,
    UniformLine,
)

CHAIN = LineType("chain", 1000.0, 5e8, breaking_load=4e6)
ROPE = LineType("rope", 60.0, 2e7, breaking_load=2e6)


def turbine(depth, anchor_radius, fairlead_radius, fairlead_z, length, weight, stiffness, headings_deg):
    """Three equal lines of a floating wind turbine, fairleads about the point at still water on its axis."""
    angle = np.radians(headings_deg)
    kind = LineType("line", weight, stiffness)
    points, lines = [], []
    for i, (c, s) in enumerate(zip(np.cos(angle), np.sin(angle), strict=True)):
        points.append(Anchor(f"A{i}", (anchor_radius * c, anchor_radius * s, -depth)))
        points.append(Fairlead(f"F{i}", "platform", (fairlead_radius * c, fairlead_radius * s, fairlead_z)))
        lines.append(UniformLine(f"L{i}", kind, length, f"A{i}", f"F{i}"))
    return System(depth, lines, points, (MooredBody("platform", freedom=DOFS),))


OC3 = turbine(320.0, 853.87, 5.2, -70.0, 902.2, 698.094, 384.243e6, (180, 60, 300))
# the definition prints 835.5 m; the published matrix is that of 835.35 m, the length in the files of the model
OC4 = turbine(200.0, 837.6, 40.868, -14.0, 835.35, 108.63 * 9.80665, 753.6e6, (60, 180, 300))
SHIFT, TURN = 0.2 * np.pi / 180 / 0.01, 2 * np.pi / 180  # perturbations of FAST v7's linearization


def central_differences(system, pose, shift, turn, at_angle):
    """(N, N) −Δforce/2Δ; at_angle(turn) is the angle that a rotation coordinate of that value stands for."""
    load = system.total_load(pose)
    size = len(load.force)
    bodies = 6 * len(system.bodies)
    K = np.zeros((size, size))
    for j in range(size):
        rotates = j < bodies and j % 6 > 2
        value = turn if rotates else shift
        step = np.zeros(size)
        step[j] = at_angle(value) if rotates else value
        forces = [system.total_load(moved(system, pose, sign * step)).force for sign in (1, -1)]
        K[:, j] = -(forces[0] - forces[1]) / (2 * value)
    return K


def fourth_order(system, pose, h=2e-3):
    """(N, N) stiffness by differences of fourth order"""
    scale = max([np.linalg.norm(p.position) for p in system.points if isinstance(p, Fairlead)] + [1.0])
    fine, coarse = (central_differences(system, pose, step, step / scale, lambda angle: angle) for step in (h, 2 * h))
    return (4 * fine - coarse) / 3


def eight_lines(freedom=DOFS, load=(2e5, 1e5, 1e6, 0.0, 0.0, 2e6)):
    points, lines = [], []
    for i, a in enumerate(np.radians([20, 60, 120, 160, 200, 240, 300, 340])):
        points.append(Anchor(f"A{i}", (600 * np.cos(a), 600 * np.sin(a), -100.0)))
        points.append(Fairlead(f"F{i}", "ship", (50 * np.cos(a), 20 * np.sin(a), -5.0)))
        lines.append(UniformLine(f"L{i}", CHAIN, 595.0, f"A{i}", f"F{i}"))
    C = np.zeros((6, 6))
    C[2:5, 2:5] = [[3e7, 0, 1e7], [0, 5e9, 0], [1e7, 0, 3e10]]
    return System(100.0, lines, points, (MooredBody("ship", freedom=freedom, hydrostatic_stiffness=C, load=load),))


def catalogue_of_systems():
    """Bridle on a buoy, chain with sinker and hawser, two bodies side by side on a shared buoy."""
    bridle = System(
        60.0,
        [
            UniformLine("chain", CHAIN, 180.0, "anchor", "buoy"),
            UniformLine("port", ROPE, 40.0, "buoy", "port bow"),
            UniformLine("starboard", ROPE, 40.0, "buoy", "starboard bow"),
            UniformLine("stern", CHAIN, 260.0, "stern anchor", "stern"),
        ],
        [
            Anchor("anchor", (220.0, 10.0, -60.0)),
            FreePoint("buoy", (70.0, 0.0, -2.0), mass=5e3, volume=20.0),
            Fairlead("port bow", "barge", (30.0, 10.0, 1.0)),
            Fairlead("starboard bow", "barge", (30.0, -10.0, 1.0)),
            Fairlead("stern", "barge", (-30.0, 0.0, 1.0)),
            Anchor("stern anchor", (-270.0, 0.0, -60.0)),
        ],
        [MooredBody("barge", load=(-5e4, 2e4, 0, 0, 0, 0))],
    )
    two = System(
        80.0,
        [
            UniformLine("west", CHAIN, 300.0, "W", "west ship"),
            UniformLine("between", ROPE, 70.0, "west in", "float"),
            UniformLine("between too", ROPE, 70.0, "float", "east in"),
            UniformLine("down", CHAIN, 75.0, "sinker", "float"),
            UniformLine("guy", CHAIN, 90.0, "G", "sinker"),
            UniformLine("east", CHAIN, 300.0, "east ship", "E"),
            UniformLine("north", CHAIN, 300.0, "west north", "NW"),
            UniformLine("north too", CHAIN, 300.0, "east north", "NE"),
        ],
        [
            Anchor("W", (-360.0, -60.0, -80.0)),
            Anchor("E", (360.0, -70.0, -80.0)),
            Anchor("NW", (-200.0, 250.0, -80.0)),
            Anchor("NE", (200.0, 250.0, -80.0)),
            Anchor("G", (0.0, -90.0, -80.0)),
            Fairlead("west ship", "west hull", (-20.0, 0.0, 0.0)),
            Fairlead("west in", "west hull", (20.0, 0.0, 0.0)),
            Fairlead("west north", "west hull", (0.0, 10.0, 0.0)),
            Fairlead("east ship", "east hull", (20.0, 0.0, 0.0)),
            Fairlead("east in", "east hull", (-20.0, 0.0, 0.0)),
            Fairlead("east north", "east hull", (0.0, 10.0, 0.0)),
            FreePoint("float", (0.0, 0.0, -5.0), mass=1e4, volume=60.0),
            FreePoint("sinker", (0.0, -20.0, -78.0), mass=3e4, volume=4.0),
        ],
        [MooredBody("west hull", (-80.0, 0, 0, 0, 0, 0)), MooredBody("east hull", (80.0, 0, 0, 0, 0, 0.1))],
    )
    return {"eight lines": eight_lines(), "bridle": bridle, "two bodies": two}


SYSTEMS = catalogue_of_systems()
