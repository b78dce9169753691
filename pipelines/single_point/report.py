"""What a single-point study says on the terminal."""

from __future__ import annotations

import numpy as np

from hakobune.mooring.criteria.overuse import overused
from hakobune.mooring.lines.system.parts import UniformLine
from hakobune.mooring.loads.turning import FITTED
from hakobune.mooring.single_point.body import SinglePointError
from hakobune.mooring.single_point.criterion import routh_hurwitz, undamped, undamped_stable
from hakobune.mooring.single_point.limit_cycle import limit_cycle
from hakobune.mooring.single_point.scope import length_without_uplift
from hakobune.mooring.single_point.yaw_criteria import yaw_stability

from ..common.quantities import force
from ..common.units import KN
from .running import largest_of

HELP = "give a stronger type or more lines"
REACH, LENGTHS = (0.02, 20.0), 200  # of the length of the line that its changes of stability are sought in


def show(console, study, made, found):
    """Tables of equilibria and of the lines in the first that is stable, and the verdict"""
    console.print(_equilibria_table(found))
    best = preferred(found)
    console.print(_lines_table(best, study.allowable))
    for line in words(study, made, best):
        console.print(line, highlight=False, soft_wrap=True, markup=False)


def preferred(found):
    """The stable Equilibrium that decays fastest; the one that grows least where none is stable"""
    return min(found, key=lambda one: one.slewing.growth)


def bow(one):
    """° from +x to the bow of an Equilibrium, 0 up to 360, to a hundredth"""
    return float(np.round(np.degrees(one.heading), 2) % 360) + 0.0


def words(study, made, one):
    """Lines on an Equilibrium"""
    x, y = one.place
    yield (
        f"heading {bow(one):.2f}° (bow from +x), centre of mass at x {x:.2f} m, y {y:.2f} m, buoy {one.buoy[0]:.2f}, "
        f"{one.buoy[1]:.2f} m; steady pull {one.pull / KN:.1f} kN"
    )
    s = one.slewing
    motion = "grows" if s.growth > 0 else "decays"
    period = "without oscillation" if np.isinf(s.period) else f"at a period of {s.period:.0f} s"
    state = "stable" if s.stable else "unstable"
    yield f"slewing: {state}; it {motion} by a factor e in {1 / abs(s.growth):.0f} s {period}"
    if one.quartic is not None:
        m, (_, A, B, C, D) = one.lateral, one.quartic
        state = {True: "stable", False: "slews"}
        yield (
            f"quartic λ⁴ + {A:.4g} λ³ + {B:.4g} λ² + {C:.4g} λ + {D:.4g}, effective line {m.length:.1f} m: "
            f"Routh–Hurwitz {state[bool(routh_hurwitz(one.quartic))]}, "
            f"undamped {state[bool(undamped_stable(undamped(one.quartic)))]}"
        )
        yield from _yaw_words(m, float(one.state[3]))
    line = made.point.system.lines[int(np.argmax(one.lines.tension))]
    if isinstance(line, UniformLine) and line.type.weight > 0:
        height = one.lines.position[0, 2] + made.point.system.depth
        need = float(length_without_uplift(one.lines.tension.max(), line.type.weight, height))
        yield (
            f"scope without uplift of the anchor, steady: {need / made.point.system.depth:.2f} times the depth "
            f"({need:.0f} m of {line.length:.0f} m)"
        )


def _yaw_words(m, speed):
    """A line on published criteria of yaw stability, of a Lateral at a speed, m/s, through the water"""
    y = yaw_stability(m, speed, np.geomspace(*REACH, LENGTHS) * m.length)
    state = "stable" if y.static else "unstable"
    straight = "keeps" if y.straight_line > 0 else "does not keep"
    turn = ", ".join(f"{length:.4g} m" for length in y.lengths) or "none"
    low, high = (part * m.length for part in REACH)
    yield (
        f"yaw: attachment {m.arm:.1f} m ahead of the centre of mass, side force of a small heading {y.lever:.1f} m: "
        f"statically {state}; running free it {straight} a straight line; slewing begins or ends at effective "
        f"lines of {turn} (of {low:.3g} to {high:.3g} m)"
    )


def cycle_of(one):
    """LimitCycle of an Equilibrium that is not stable, and a line on it; None where it is stable or comes to none"""
    if one.slewing.stable:
        return None, None
    try:
        found = limit_cycle(one)
    except SinglePointError as error:
        return None, f"limit cycle: {error}"
    pull = np.linalg.norm(found.hawser, axis=1) / KN
    return found, (
        f"limit cycle: the heading swings {np.degrees(found.amplitude):.1f}° to either side of "
        f"{np.degrees(found.middle) % 360:.1f}° in {found.period:.0f} s; "
        f"pull {pull.min():.1f} to {pull.max():.1f} kN, largest line {found.lines.max() / KN:.1f} kN"
    )


def findings(study, made, found):
    """One line each: what a reader has to know"""
    yield from made.findings
    best, water = preferred(found), made.point.loads.water
    if water.turning and water.speed > 0:
        drift = np.abs(np.arctan(np.tan(water.direction - best.heading)))
        if drift > FITTED * (1 + 1e-9):
            yield (
                f"the water meets the hull at {np.degrees(drift):.0f}°, {np.degrees(drift - FITTED):.0f}° beyond the "
                "turning tests (60°); coefficients there are led on by the symmetry of a box; give current coefficients"
            )
    stable = [one for one in found if one.slewing.stable]
    if not stable:
        yield "no heading is stable: the body slews; see the growth over hawser and attachment with [[maps]]"
    if len(stable) > 1:
        headings = ", ".join(f"{bow(one):.0f}°" for one in stable)
        yield f"{len(stable)} headings are stable ({headings}): the body lies at the one it comes to"


def overloads(study, best, cycle, run):
    """What fails of hawsers and lines at rest in the Equilibrium `best`, in its LimitCycle and in a Run, either None"""
    load = None if study.hawser is None else force("hawser", study.hawser, "breaking_load")
    count = 0 if study.hawser is None else len(best.hawser)
    names = [*(f"hawser {i + 1}" for i in range(count)), *best.point.system.line_names]
    breaking = np.array([*np.full(count, np.nan if load is None else load), *best.point.system.breaking_load])
    breaking[~np.isfinite(breaking)] = np.nan
    at_rest = [*best.hawser[:count] / breaking[:count], *best.lines.lines.utilisation]
    yield from overused(names, at_rest, study.allowable, "at rest", HELP)
    pulls = {}
    if cycle is not None:
        pulls["in the limit cycle"] = cycle.hawser.max(axis=0), cycle.lines.max(axis=0)
    if run is not None:
        pulls["in the run in time"] = largest_of(run, study.waves is not None)
    for where, (hawser, lines) in pulls.items():
        yield from overused(names, np.array([*hawser[:count], *lines]) / breaking, study.allowable, where, HELP)


def _table(title, *columns):
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for column in columns:
        table.add_column(column, justify="right")
    return table


def _equilibria_table(found):
    table = _table("headings of rest", "heading °", "stable", "growth 1/s", "period s", "pull kN", "hawser kN",
                   "largest line kN")  # fmt: skip
    for one in found:
        s = one.slewing
        hawsers = " ".join(f"{value / KN:.1f}" for value in one.hawser)
        table.add_row(
            f"{bow(one):.2f}",
            "yes" if s.stable else "no",
            f"{s.growth:.2e}",
            "–" if np.isinf(s.period) else f"{s.period:.0f}",
            f"{one.pull / KN:.1f}",
            hawsers,
            f"{one.lines.tension.max() / KN:.1f}",
        )
    return table


def _lines_table(one, allowable):
    table = _table(f"lines at {bow(one):.1f}°", "line", "tension kN", "on the bed m", "used %")
    lines = one.lines.lines
    rows = zip(one.point.system.line_names, one.lines.tension / KN, lines.grounded_length, 100 * lines.utilisation,
               strict=True)  # fmt: skip
    for name, tension, lying, used in rows:
        style = "red" if used > 100 * allowable else None
        table.add_row(
            name, f"{tension:.1f}", f"{lying:.0f}", "unknown" if np.isnan(used) else f"{used:.1f}", style=style
        )
    return table
