"""Warnings of effects that a system of lines neglects; and the line or degree of freedom at fault without an
equilibrium.
"""

import warnings

import numpy as np

from hakobune.bem import DOFS

from ..catenary.state import State
from .checks import ON_BED
from .composite import solution
from .hawser import Hawser
from .parts import CompositeLine

LONGEST_STRAIN = 0.5  # nylon rope parts before
NEARER = "give the line its axial stiffness or more length, or move its ends nearer to each other"


def strains(system, tension):
    """Strain of the softest segment of each line at tension (n,) N, shape (n,); 0 for a tension table, which
    includes strain
    """
    stiffness = [
        min((part.axial_stiffness for part in _parts(line) if not np.ndim(part.axial_stiffness)), default=np.inf)
        for line in system.lines
    ]
    return np.asarray(tension) / np.array(stiffness)


def _parts(line):
    if isinstance(line, Hawser):
        return []
    return line.segments if isinstance(line, CompositeLine) else [line.type]


def beyond_tables(system, tension):
    """A message on hawsers whose tension, (n,) N, lies beyond their tension tables"""
    past = [
        f"{system.lines[i].name} {tension[i] / 1e3:.4g} kN, table to {system.lines[i].most / 1e3:.4g} kN"
        for i in system.hawsers
        if tension[i] > system.lines[i].most
    ]
    if past:
        yield (
            "these lines exceed their table of load over elongation, which is extrapolated linearly: "
            f"{', '.join(past)}; extend the table"
        )


def warn_of_floating(system, load):
    """Warn of lines lighter than water that would rise above the water surface; the surface is not modelled as a
    limit."""
    for i, line in enumerate(system.lines):
        if isinstance(line, CompositeLine | Hawser) or line.type.weight > 0:
            continue
        down, ends = load.rows[i, 3:5], load.points[system.arrays.ends[i], 2]
        part, top = "end", ends.max()
        if np.all(down < 0):
            tension = np.hypot(load.rows[i, 1], down[0])
            bend = 1 / (tension + load.rows[i, 1]) + 0.5 / line.type.axial_stiffness
            middle = ends[0] + down[0] ** 2 * bend / -line.type.weight
            if middle > top + 1e-3 * line.length:
                part, top = "middle", middle
        if top > ON_BED:
            warnings.warn(
                f"line {line.name} floats and its {part} would be {top:.3g} m above the water; allowed: below "
                "the surface, since the program does not let lines float on it; shorten the line, or give its weight "
                "in air",
                stacklevel=4,
            )


def warn_of_friction(system, lines):
    """Warn of lines on the bed whose friction is neglected."""
    left = [
        f"{line.name} ({lying:.3g} m)"
        for line, end, lying in zip(system.lines, system.anchored_ends, lines.grounded_length, strict=True)
        if not end and line.bed_friction > 0 and lying > 0
    ]
    if left:
        warnings.warn(
            f"bed friction is not included on {', '.join(left)}: between free points friction depends on the history "
            "of the motion; allowed: lines that end at an anchor on the bed",
            stacklevel=4,
        )


def unheld(lines):
    """Whether a part of each line without tension lies on a bed that is too steep for its friction; shape (n,) of
    LineForces.

    The solution leaves such a part in place. In reality it slides down to the nearest low point of the bed and pulls
    the line.
    """
    return np.array([i in lines.solutions and lines.solutions[i].slides for i in range(len(lines.status))], bool)


def warn_of_sliding(system, lines):
    """Warn of multi-segment lines with parts that would slide."""
    names = [name for name, slides in zip(system.line_names, unheld(lines), strict=True) if slides]
    if names:
        warnings.warn(
            f"these lines are slack on a bed that is too steep for its friction: {', '.join(names)}; the program "
            "keeps such a line where it lies, but in reality the line slides and pulls; allowed: tan of the slope up "
            "to the friction coefficient; give more friction or a shorter line",
            stacklevel=4,
        )


def fault_of(one, a, b):
    """Message of the solver of a Composite for its ends at a and b, (3,) m each."""
    try:
        solution(one, *((b, a) if one.flipped else (a, b)))
    except ValueError as error:
        return str(error)
    return "it has an equilibrium"


def freedom_name(system, index):
    """Name of a degree of freedom: body and motion, or point and axis."""
    count = 6 * len(system.bodies)
    if index < count:
        return f"{system.bodies[index // 6].name} {DOFS[index % 6].lower()}"
    return f"{system.free_points[(index - count) // 3].name} {'xyz'[(index - count) % 3]}"


def culprit(system, rows, starts, ends, where):
    """Message on the first line without a solution between its ends, each (n, 3) m in space; where : words for these
    ends.
    """
    bad = int(np.argmax(rows[:, 0]))  # a line beyond reach, below the bed or unsolved
    line, a, b = system.lines[bad], starts[bad], ends[bad]
    if isinstance(line, CompositeLine):
        one = next(one for one in system.composites if one.number == bad)
        said = f"line {line.name}, {where}: {fault_of(one, a, b)}"
        return f"{said}; {NEARER}" if rows[bad, 0] == State.BEYOND_REACH else said
    if rows[bad, 0] == State.BELOW_BED:
        return f"line {line.name} has an end below the bed, {-system.depth:g} m, {where}"
    return (
        f"line {line.name}, inextensible and {line.length:g} m long, cannot span {np.linalg.norm(b - a):g} m, {where}; "
        f"{NEARER}"
    )
