"""Findings on a single-point study, and its failures."""

import numpy as np

from hakobune.mooring.criteria.overuse import overused
from hakobune.mooring.loads.turning import FITTED
from hakobune.mooring.motion.simulation.trial import TOO_LARGE
from hakobune.mooring.single_point.equilibria import bow, buoy_periods
from hakobune.mooring.single_point.history import moves_in_waves
from hakobune.mooring.single_point.in_time import pulls, used_in

from ..common.quantities import force
from ..common.weather.seas import PERIODS, spectrum_of
from .study import mass_of

BALANCED = 0.05  # change of a buoy's draft by its lines, over its draft, that is not told
NEAR = 0.2  # distance of a natural period from the waves' peak, over the peak, that is told
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
    yield from _resonant(found.study, found.point.system, best)
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
        how = "slews" if best.slews else f"surges on hawser and lines, with a period of {best.slewing.period:.3g} s"
        yield f"no heading is stable: the body {how}; [[maps]] shows the growth over hawser length and attachment"
    if len(stable) > 1:
        headings = ", ".join(f"{bow(one):.0f}°" for one in stable)
        yield (
            f"{len(stable)} headings are stable ({headings}): the body comes to rest at the first of them that it "
            f"reaches"
        )


def drafts_of(buoy, system, best):
    """Draft of a buoy with mass, m: without lines, and with its lines and the hull at an Equilibrium"""
    alone = mass_of(buoy, system) / (system.density * 0.25 * np.pi * buoy.diameter**2)
    return alone, alone + system.bodies[0].position[2] - best.lines.position[0, 2]


def periods_of_buoy(buoy, system, best):
    """s, `buoy_periods` of a BuoyTable with a diameter"""
    displaced = system.density * 0.25 * np.pi * buoy.diameter**2 * drafts_of(buoy, system, best)[1]
    return buoy_periods(best, mass_of(buoy, system), displaced)


def _resonant(study, system, best):
    """Natural periods of the buoy near the peak of the waves"""
    waves = study.waves
    if waves is None or study.buoy.diameter is None or all(getattr(waves, kind) is None for kind in PERIODS):
        return
    peak = spectrum_of("waves", waves, study.water.depth).Tp
    near = {
        f"{period:.3g} s ({name})"
        for name, period in zip(
            ("sideways", "sideways", "heave"), periods_of_buoy(study.buoy, system, best), strict=True
        )
        if abs(period / peak - 1) < NEAR
    }
    if near:
        yield (
            f"the buoy with a slack hawser has natural periods of {' and '.join(sorted(near))}, within "
            f"{100 * NEAR:g} % of the waves' peak at {peak:.3g} s: the chains then carry a resonance that only "
            "the drag of the buoy damps; change the pretension, the length of the chains or the mass of the "
            "buoy"
        )


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
        yield (
            f"buoy: {buoy.mass:.4g} t alone float with a draft of {draft:.3g} m, and the lines pull it down with "
            f"{1e-3 * system.density * system.gravity * area * sunk:.4g} kN to {draft + sunk:.3g} m; buoy.z is the "
            f"height without lines; if {draft:.3g} m is the draft with lines, give buoy.draft = {draft:.3g} instead "
            "of buoy.mass: buoy.z is then the height with lines too"
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
