"""Findings on a single-point study, and its failures."""

import numpy as np

from hakobune.mooring.criteria.overuse import overused
from hakobune.mooring.loads.turning import FITTED
from hakobune.mooring.motion.simulation.trial import TOO_LARGE
from hakobune.mooring.single_point.equilibria import bow
from hakobune.mooring.single_point.history import moves_in_waves
from hakobune.mooring.single_point.in_time import pulls, used_in

from ..common.quantities import force

BALANCED = 0.05  # change of a buoy's draft by its lines, over its draft, that is not told
HELP = "give a stronger type or more lines"
SNAPS = (
    "left out: inertia and drag of the chains, so that {}; hakobune simulate takes hull and buoy as two bodies, with "
    'the hawser between them and dynamic_lines = "auto"'
)
STEADY = (
    "left out: pulls by waves and gusts; tensions are those of steady loads and smaller than the largest ones in the "
    "sea: [slewing] runs the body in time, with the waves where --database is given"
)


def findings(found):
    """Findings of a `result.Found`, one line each"""
    best, water = found.best, found.point.loads.water
    if found.run is None:
        yield from [STEADY] if found.study.waves is not None else []
    elif moves_in_waves(found.run):
        yield SNAPS.format(TOO_LARGE)
    if water.turning and water.speed > 0:
        drift = np.abs(np.arctan(np.tan(water.direction - best.heading)))
        if drift > FITTED * (1 + 1e-9):
            yield (
                f"the current meets the hull at {np.degrees(drift):.0f}°, {np.degrees(drift - FITTED):.0f}° beyond "
                "the range of the turning tests (60°); beyond it the coefficients are extrapolated by the symmetry of "
                "a box; give current coefficients"
            )
    stable = [one for one in found.rest if one.slewing.stable]
    if not stable:
        yield "no heading is stable: the body slews; [[maps]] shows the growth over hawser length and attachment"
    if len(stable) > 1:
        headings = ", ".join(f"{bow(one):.0f}°" for one in stable)
        yield (
            f"{len(stable)} headings are stable ({headings}): the body comes to rest at the first of them that it "
            f"reaches"
        )


def drafts_of(buoy, system, best):
    """Draft of a buoy with mass, m: without lines, and with its lines and the hull at an Equilibrium"""
    alone = 1e3 * buoy.mass / (system.density * 0.25 * np.pi * buoy.diameter**2)
    return alone, alone + system.bodies[0].position[2] - best.lines.position[0, 2]


def pulled_down(buoy, system, best):
    """A finding on a buoy that its lines pull down by more than `BALANCED` of its draft, since [buoy] z is given
    without lines
    """
    if buoy.mass is None:
        return
    area = 0.25 * np.pi * buoy.diameter**2
    draft, sunk = drafts_of(buoy, system, best)
    sunk -= draft
    if abs(sunk) > BALANCED * draft:
        carried = buoy.mass - 1e-3 * system.density * area * sunk
        yield (
            f"buoy: {buoy.mass:.4g} t alone float with a draft of {draft:.3g} m, and the lines pull it down with "
            f"{1e-3 * system.density * system.gravity * area * sunk:.4g} kN to {draft + sunk:.3g} m; buoy.z is the "
            f"height without lines; if {draft:.3g} m is meant as the draft with lines, give "
            f"buoy.mass = {carried:.4g}, and raise buoy.z by {sunk:.2g} m"
        )


def overloads(study, best, cycle, run):
    """Failures of hawsers and lines at rest in the Equilibrium `best`, in its LimitCycle and in a Run; the last two may
    be None"""
    count = 0 if study.hawser is None else len(best.hawser)
    names = [*(f"hawser {i + 1}" for i in range(count)), *best.point.system.line_names]
    for where, shares in used(study, best, cycle, run).items():
        yield from overused(names, shares, study.allowable, where, HELP)


def used(study, best, cycle, run):
    """{where: (k + n,) tension over breaking load of hawsers, if they have a table, and lines}, nan if unknown"""
    load = None
    if study.hawser is not None:
        given = force("hawser", study.hawser, "breaking_load")
        load = np.nan if given is None else given
    return used_in(pulls(best, cycle, run, study.waves is not None), best, load)
