"""`hakobune.single_point`: headings at rest of a body on a buoy or turret, its slewing, and a run in time."""

from __future__ import annotations

import math
import tomllib
from typing import TYPE_CHECKING, NamedTuple

from hakobune.bem.kernels.progress import progress_callback
from hakobune.mooring.criteria.failing import failing, fails
from hakobune.mooring.single_point.body import NotFollowedError, SinglePoint, SinglePointError
from hakobune.mooring.single_point.equilibria import Equilibrium, equilibria, preferred
from hakobune.mooring.single_point.in_time import Run
from hakobune.mooring.single_point.limit_cycle import LimitCycle, limit_cycle

from ..common.bounds import told
from ..results.given import File, Tables, database_of, given
from ..results.provenance import provenance
from ..results.result import Result
from . import running
from .findings import findings, overloads
from .maps import Map, check_maps, computed
from .quantities import cycle_of, hull_of, lines_at, maps_of, natural_of, notes_of, rest_of, run_of, state_of
from .reading import read_study
from .study import check_buoy, make
from .tables import Study, make_study
from .telling import Telling

if TYPE_CHECKING:
    from hakobune.bem.database import Database


A_CYCLE = 15.0  # s, of a box on six chains
PERIODS = 6  # of slewing, in a run that is to show it fully grown


class Found(NamedTuple):
    """study : Study; point : SinglePoint; rest : every Equilibrium; best : the chosen Equilibrium; cycle :
    LimitCycle, or None where the run shows the slewing

    run : `mooring.single_point.in_time.Run` or None; maps : [Map, …]
    """

    study: Study
    point: SinglePoint
    rest: list[Equilibrium]
    best: Equilibrium
    cycle: LimitCycle | None
    run: Run | None
    maps: tuple[Map, ...]


def single_point(study: File | Tables | Study, database: File | Database | None = None) -> Result:
    """Headings at rest of a body on a buoy or turret, its slewing, its tensions, and on request a run in time.

    study : path of a study, its tables as a dictionary, or a `pipelines.single_point.tables.Study`
    database : path of the body's database, or an open one, for added masses and wave drift forces
    returns : Result, in SI; its `detail` is a Found
    raises : ValueError, with a message of one line
    """
    read, text = given(study, Study, _read, make_study)
    db = None if database is None else database_of(database)
    if db is not None:
        db.require_one_body()
    if read.slewing is not None:
        running.check(read, db)
    raw = tomllib.loads(text)
    check_maps(raw, read)
    made = make(read, db)
    rest = equilibria(made.point)
    for one in rest:
        check_buoy(made, one)
    best = preferred(rest)
    with progress_callback(Telling()):
        run = None if read.slewing is None else running.run(read, best, db)
        cycle, none = _cycle_of(best, run, _grown(read.slewing, best))
    maps = tuple(computed(raw, i, db) for i, _ in enumerate(read.maps))
    found = Found(read, made.point, rest, best, cycle, run, maps)
    lost = () if none is None else (none,)
    broken = failing(lost)
    return result_of(found, (*made.findings, *broken), () if broken else lost, text, db)


def _read(path: File) -> tuple[Study, str]:
    study, _, text = read_study(path)
    return study, text


def _grown(table, one):
    """s, length of a run that shows the slewing about an Equilibrium fully grown: `PERIODS`, and the time in which the
    start offset grows to 1 rad; inf if it turns away, or without [slewing] or offset"""
    if table is None or not (table.offset_deg and math.isfinite(one.slewing.period) and one.slewing.growth > 0):
        return math.inf
    return max(PERIODS * one.slewing.period, -math.log(math.radians(abs(table.offset_deg))) / one.slewing.growth)


def _cycle_of(one, run=None, grown=math.inf):
    """LimitCycle of an Equilibrium that is not stable, or the reason for none; None for both if it is stable

    A Run that lasts for `grown` s shows the slewing with waves and gusts, so that no cycle is computed. The cycle fails
    where the body slews beyond the range of the mooring: line tensions there are unknown.
    """
    if one.slewing.stable:
        return None, None
    if run is not None and run.record.time[-1] >= grown:
        return (
            None,
            f"limit cycle: not computed, since the run in time shows the slewing (it grows within {grown:.0f} s)",
        )
    if not one.slews:
        return (
            None,
            f"limit cycle: not computed, since surge grows, with a period of {one.slewing.period:.3g} s, and the body "
            "does not slew; [slewing] runs it in time",
        )
    told(_why(run, grown), A_CYCLE)
    try:
        return limit_cycle(one), None
    except NotFollowedError as error:
        return None, fails(f"limit cycle: {error}")
    except SinglePointError as error:
        return None, f"limit cycle: {error}; small motions grow by a factor of e in {1 / one.slewing.growth:.3g} s"


def _why(run, grown):
    """Words on a limit cycle that is computed, before its time"""
    takes = "its limit cycle takes minutes to compute if nothing damps it, otherwise"
    if run is None or not math.isfinite(grown):
        return f"the body slews; {takes}"
    return (
        f"the body slews, and a run of {run.record.time[-1]:.6g} s is too short to show it fully grown; give "
        f"slewing.duration = {100 * math.ceil(grown / 100)}, or wait: {takes}"
    )


def result_of(found, first, notes, text, db):
    """Result of a Found; first : findings printed first; notes : lines; text : text of its study"""
    quantities, axes = {}, {}
    for part in (rest_of, state_of, natural_of, lines_at, cycle_of, run_of, maps_of, hull_of):
        made, labels = part(found)
        quantities, axes = quantities | made, axes | labels
    said = (
        *first, *findings(found), *overloads(found.study, found.best, found.cycle, found.run),
        *(_lost(one) for one in found.maps if one.failed),
    )  # fmt: skip
    notes = (*notes_of(found), *notes)
    return Result("single-point", quantities, axes, said, notes, provenance=provenance(text, db), detail=found)


def _lost(found):
    return (
        f"map over {' and '.join(found.keys)}: {found.failed} of {found.growth.size} points could not be computed: "
        f"{found.reason}"
    )
