"""`hakobune members`: forces on members over one wave, the largest of each and of all, and when."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.loads.morison import member_force

from ..common.bounds import told
from ..common.picture import PLOTS, check_picture, save
from ..printing.verdict import tell
from .study import placed, read_study, wave_of, wind_on

PHASES = 360  # of a wave
SLENDER = 0.2  # D/λ, above which a member scatters the wave
KILO = 1e3
IN_WATER, ALL = "all in the water", "all"
COLOUR = {IN_WATER: "grey", ALL: "black"}
A_MEMBER = 0.1  # s, over a wave


class Course(NamedTuple):
    """name; force : (p, 6) N and N m about the foot (3,) m over the phases of a wave"""

    name: str
    force: np.ndarray
    foot: np.ndarray


def members(path, plot):
    """Print a study of members, draw it to `plot`; returns the exit status.  Raises ValueError, one line."""
    if plot is not None:
        check_picture(plot, PLOTS)
    study = read_study(path)
    wave, wind = wave_of(study), wind_on(study)
    phases = np.linspace(0.0, 2 * np.pi, PHASES if wave.amplitude else 1, endpoint=False)
    standing = placed(study)
    told(f"{len(standing)} members take", A_MEMBER * len(standing))
    courses = [course(one, wave, phases, study.water.density) for one in standing]
    _show(courses, wind, phases, wave)
    if plot is not None:
        _draw(courses, wind, phases, plot)
    status = tell(remarks(standing, courses, wave), remark="")
    if plot is not None:
        print(plot)
    return status


def course(member, wave, phases, density):
    """`Course` of a `study.Placed` in a RegularWave, its wet part at each phase (p,) rad"""
    foot = min(member.start, member.end, key=lambda end: end[2])
    force = np.zeros((len(phases), 6))
    for row, phase in zip(force, phases, strict=True):
        wet = wet_part(member.start, member.end, wave, phase)
        if wet is not None:
            row[:] = member_force(member.section, *wet, lambda places, now=phase: wave.flow(places, now), density)
            row[3:] -= np.cross(foot, row[:3])
    return Course(member.name, force, foot)


def wet_part(start, end, wave, phase):
    """Two ends (3,) m of the part of a straight member below the surface, None where it is dry.

    A member is cut once: one that is longer than half a wave and lies in the surface is not followed.
    """

    from scipy.optimize import brentq

    def over(share):
        place = (start + share * (end - start))[None]
        return place[0, 2] - wave.elevation(place, phase)[0]

    dry = over(0.0) > 0, over(1.0) > 0
    if all(dry):
        return None
    if not any(dry):
        return start, end
    cut = start + brentq(over, 0.0, 1.0) * (end - start)
    return (cut, end) if dry[0] else (start, cut)


def remarks(standing, courses, wave):
    """One line each on members that are never wet or too wide for Morison's formula, and on the theory of the wave"""
    length = 2 * np.pi / wave.k
    dry = [one.name for one in courses if not one.force.any()]
    if dry:
        yield f"warning: {', '.join(dry)}: no force, or never in the water; z goes up from still water"
    wide = [one.name for one in standing if wave.amplitude > 0 and one.section.width > SLENDER * length]
    if wide:
        widest = max(one.section.width for one in standing)
        yield fails(
            f"{', '.join(wide)}: {widest:.3g} m wide, limit {SLENDER:g} of the wave's {length:.3g} m; it scatters the "
            "wave: solve it by hakobune box or buoy"
        )
    if wave.amplitude > 0:
        alone = ""
        if wave.current is not None:
            met = f"a place at rest meets it every {wave.met_period:.4g} s"
            alone = f" in the water that moves along, as without the current; {met}"
        yield (
            f"wave of {2 * wave.amplitude:g} m, {length:.4g} m long{alone}; linear theory up to the surface (Wheeler); "
            "phase 0 with the crest at the origin; moments about the foot of each member, of all and of the wind about "
            "the bed under the origin"
        )


def _show(courses, wind, phases, wave):
    from rich.table import Table

    from ..printing.console import new_console

    table = Table(title="largest over the wave" if wave.amplitude > 0 else "in the current")
    table.add_column("")
    for name in ("force kN", "at phase °", "Fx kN", "Fy kN", "Fz kN", "moment kN m", "at phase °"):
        table.add_column(name, justify="right", no_wrap=True)
    for one in courses:
        table.add_row(one.name, *_largest(one.force, phases))
    bed = np.array([0.0, 0.0, -wave.depth])
    in_water = sum((_moved(one.force, one.foot, bed) for one in courses), np.zeros((len(phases), 6)))
    in_wind = [(name, _moved(force[None], np.zeros(3), bed)) for name, force in wind]
    if courses:
        table.add_row(IN_WATER, *_largest(in_water, phases))
    for name, force in in_wind:
        table.add_row(f"{name}, wind", *_largest(force, phases))
    if courses and wind:
        table.add_row(ALL, *_largest(in_water + sum(force for _, force in in_wind), phases))
    console = new_console()
    console.print(table)


def _moved(force, about, other):
    """(p, 6) of forces (p, 6) with moments about a place (3,) m, with moments about another"""
    return np.concatenate([force[:, :3], force[:, 3:] + np.cross(about - other, force[:, :3])], axis=1)


def _largest(force, phases):
    size, turning = np.linalg.norm(force[:, :3], axis=1), np.linalg.norm(force[:, 3:], axis=1)
    i, j = int(size.argmax()), int(turning.argmax())
    parts = force[i, :3] / KILO + 0.0
    return (
        f"{size[i] / KILO:.4g}",
        f"{np.degrees(phases[i]):.0f}",
        *(f"{part:.4g}" for part in parts),
        f"{turning[j] / KILO:.4g}",
        f"{np.degrees(phases[j]):.0f}",
    )


def totals(courses, wind):
    """[(name, (p, 3) N)] of several members together: in the water, and with the wind"""
    in_water = sum(one.force[:, :3] for one in courses)
    found = [(IN_WATER, in_water)] if len(courses) > 1 else []
    return found + ([(ALL, in_water + sum(force[:3] for _, force in wind))] if courses and wind else [])


def _draw(courses, wind, phases, path):
    """Forces of the members over the phase, and of all with the wind, the rows of the table"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 5.0), layout="constrained")
    axis = figure.add_subplot()
    for i, one in enumerate(courses):
        style = ("-", (0, (4, 4)))[i % 2]  # piles side by side have the same force: both are to be seen
        axis.plot(np.degrees(phases), np.linalg.norm(one.force[:, :3], axis=1) / KILO, linestyle=style, label=one.name)
    for name, total in totals(courses, wind):
        axis.plot(np.degrees(phases), np.linalg.norm(total, axis=1) / KILO, COLOUR[name], linewidth=2, label=name)
    axis.set(xlabel="phase, °, crest at the origin at 0", ylabel="force, kN", xlim=(0, 360), ylim=(0, None))
    axis.set_xticks(range(0, 361, 45))
    axis.grid(alpha=0.3)
    axis.legend()
    save(figure, path, 110)
