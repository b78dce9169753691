"""Static lines that one does hang: what the catalogue holds, over beds of usual slope and friction, at usual pulls.

    python tests/bench/adversarial_lines.py --usual [--lines 10000] [--seed 1] [--first 0] [--processes 1]

Chain, or chain with wire or fibre rope, scope 1.5 to 8 times the depth; sinkers of 1 to 20 t and buoys of 1 to 30 t in
water, at most 40 % of the line's weight each; beds of up to four facets no steeper than 1 to 5, friction 0.2 to 1, or
no bed; from slack to half the breaking load, the fairlead below the water or on a deck above it.
"""

import numpy as np

from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine

CHAINS = ("R3 studless", "R4 studlink", "R5 studless", "grade 2", "grade 3", "ORQ")
ROPES = ("wire 6x36 IWRC", "wire 6x19 FC", "spiral strand", "polyester", "nylon")
TONNE, STEEPEST = 9806.65, 0.2


def part(rng, names, sizes, length):
    kind = line_type(f"{rng.choice(names)} {rng.uniform(*sizes):.0f} mm")
    return Segment(float(length), kind.weight, kind.axial_stiffness, breaking_load=kind.breaking_load, name=kind.name)


def usual_segments(rng, length):
    """Chain alone; chain and a rope above it; or chain, rope and a chain through the fairlead"""
    kind, size = rng.integers(0, 3), rng.uniform(40, 120)
    sizes = (size, size + 1)
    if kind == 0:
        return [part(rng, CHAINS, sizes, length)]
    shares = rng.dirichlet((4, 4, 1)[: kind + 1])
    materials = (CHAINS, sizes), (ROPES, (size, 2 * size)), (CHAINS, sizes)
    return [part(rng, *one, length * share) for one, share in zip(materials, shares, strict=False)]


def usual_loads(rng, length, weight):
    loads = []
    for _ in range(rng.choice([0, 0, 1, 1, 2])):
        sinks = rng.random() < 0.5
        force = min(TONNE * rng.uniform(1, 20 if sinks else 30), 0.4 * weight)
        in_air = 0.0 if sinks else force * rng.uniform(0.05, 0.5)
        loads.append(PointLoad(float(length * rng.uniform(0.1, 0.95)), force if sinks else -force, in_air))
    return loads


def usual_bed(rng, length):
    if rng.random() < 0.05:
        return None
    friction, kind = float(rng.uniform(0.2, 1.0)), rng.integers(0, 3)
    if kind == 0:
        return Bed.sloping(0.0, friction)
    if kind == 1:
        return Bed.sloping(float(np.arctan(rng.uniform(-STEEPEST, STEEPEST))), friction)
    count = rng.integers(2, 5)
    steps = length * rng.dirichlet(np.full(count, 3.0))
    rises = steps * rng.uniform(-STEEPEST, STEEPEST, count)
    points = np.column_stack([np.append(0.0, np.cumsum(steps)), np.append(0.0, np.cumsum(rises))])
    return Bed(points, friction)


def usual_line(rng):
    """A StaticLine and its fairlead (x, z), m."""
    depth = 10 ** rng.uniform(1.0, 2.5)
    length = depth * rng.uniform(1.5, 8)
    segments = usual_segments(rng, length)
    loads = usual_loads(rng, length, sum(one.length * one.weight for one in segments))
    bed = usual_bed(rng, length)
    # what is taut under half the breaking load is longer by this share
    stretch = sum(0.5 * one.length * one.breaking_load / one.axial_stiffness for one in segments) / length
    most = np.sqrt((length * (1 + 0.5 * stretch)) ** 2 - depth**2)
    x = float(most * (rng.uniform(0.3, 0.9) if rng.random() < 0.2 else 1 - 0.1 * rng.random() ** 2))
    floor = 0.0 if bed is None else -float(bed.depth_below(x, 0.0))
    surface = max(depth, floor + 5.0)
    z = float(surface - rng.uniform(0, 0.2) * (surface - floor) if rng.random() < 0.7 else surface + rng.uniform(0, 8))
    return StaticLine(segments, loads, bed, surface), x, z
