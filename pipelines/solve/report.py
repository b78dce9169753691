"""Tables at the end of a run and of `hakobune check`, on the terminal."""

import tomllib
from dataclasses import dataclass

import numpy as np

from hakobune.bem.bodies.one_of_several import each_body
from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.database.natural_periods import natural_periods
from hakobune.bem.database.resonances import resonances
from hakobune.bem.formats.judging.laws import energy_defects
from hakobune.bem.formats.values import Values
from hakobune.bem.stored_laws import SUMS, damping_errors, reciprocity_defects, unequal_drift
from hakobune.mooring.criteria.failing import fails

from ..common.resonances import resonance_lines
from ..printing.verdict import tell

CHECKED = {
    "reciprocity": "A and B symmetric",
    "Haskind": "forces by radiation",
    "energy": "waves carried away",
    "residual": "linear system",
    "estimated_error": "two resolutions",
    "damping": "by its own size",
}
ESTIMATED = ("estimated_error", "damping")  # checks that are errors, not laws
# Largest defect of a law where a number of panels is given, for which no tolerance holds.  Of 900 frequencies of random
# boxes and buoys on 24 to 80 panels, in waves longer than two panels, with half a draft and more under the keel, the
# worst defect is 0.16; with a tenth of a draft it is 0.39, and the results are unusable; the mesh findings warn of it.
BROKEN = 0.25
RESIDUAL = 1e-6  # residual of a linear system; four digits below the finest useful tolerance


@dataclass(frozen=True)
class Check:
    """Largest value of one check, its place, and its limit; NaN if it did not apply."""

    name: str
    largest: float
    omega: float
    limit: float
    exceeding: int

    @property
    def passed(self):
        """False if a frequency exceeds the limit"""
        return self.exceeding == 0


def checked(db):
    """[Check] of a database against its own tolerance: stored checks, those that an imported set tells by itself, and
    damping relative to its own size"""
    told = laws_of_imported(db)
    stored = [
        _check(one.name, told[one.name], db.omega, one.limit) if one.name in told else one for one in stored_checks(db)
    ]
    return [*stored, _check("damping", damping_errors(db), db.omega, _tolerance(db))]


def laws_of_imported(db):
    """{check: (n,) violation} of laws that A, B and X of an imported set can tell by themselves, else {}"""
    if "imported" not in db.attributes or not {"added_mass", "radiation_damping"} <= set(db.names):
        return {}
    found = {"reciprocity": reciprocity_defects(db)}
    if "excitation_force" in db.names and not (db.bodies or db.modes):
        names = "added_mass", "radiation_damping", "excitation_force"
        values = Values(db.omega, db.wave_direction, db.water_depth, db.density, db.gravity, {n: db[n] for n in names},
                        {"hydrostatic_stiffness": db.hydrostatic_stiffness})  # fmt: skip
        found["energy"] = energy_defects(values)
    return found


def stored_checks(db):
    """[Check] of the stored checks of all frequencies"""
    return [
        _check(name, values, db.omega, RESIDUAL if name == "residual" else _tolerance(db))
        for name, values in db.checks().items()
    ]


def _tolerance(db):
    return float(db.attributes.get("tolerance", 0.01))


def failed_laws(db, own_panels):
    """One line on the laws that the results of a run violate, "" if none.

    own_panels : panels were given, as a number or a mesh file, so that no tolerance applies
    """
    laws = [check for check in stored_checks(db) if check.name not in ESTIMATED]
    failed = [check for check in laws if check.largest > max(check.limit, own_panels * BROKEN)]
    said = ", ".join(
        f"{check.name} is broken by {check.largest:.2g} at ω = {check.omega:.4g} rad/s, limit "
        f"{max(check.limit, own_panels * BROKEN):.2g}"
        for check in failed
    )
    return f"checks failed: {said}; either the mesh or the method does not suit this body; check both" if said else ""


def missed_tolerance(db):
    """One line on the estimated error of a database with a requested tolerance, "" if the error is within the
    tolerance"""
    (error,) = [check for check in stored_checks(db) if check.name == "estimated_error"] or [None]
    if error is None or error.passed:
        return ""
    return (
        f"the estimated error is {error.largest:.2g} at ω = {error.omega:.4g} rad/s, above the tolerance "
        f"{error.limit:g} at {error.exceeding} of {len(db.omega)} frequencies; give --panels, another --method or a "
        f"coarser --tolerance{_of_gaps(db)}"
    )


def _of_gaps(db):
    """What else helps a body before a wall or among others, whose water between may resonate"""
    scene = tomllib.loads(db.header.scene)
    if "damping_lids" in scene or not ("wall" in scene or len(scene.get("bodies", ())) > 1):
        return ""
    return "; where the water of a gap resonates there, [[damping_lids]] in the scene damps it"


def way_out(law):
    """What helps against a violated law of stored numbers"""
    if law.endswith(SUMS):
        return "the drift of each body, by pressure, is too uncertain there; solve with more panels"
    return "solve it again with --fresh"


def uncertain_drift(db):
    """One line on drift forces of each body that do not sum up to those of the far field, "" if they do"""
    said = ", ".join(
        f"{law} is broken by {worst:.2g} at ω = {omega:.4g} rad/s" for law, worst, omega, _ in unequal_drift(db)
    )
    return f"checks failed: {said}; {way_out(SUMS)}" if said else ""


def gives_panels(scene):
    """Whether a scene gives panels, as a number or a mesh file, so that no tolerance applies"""
    return scene.panels is not None or any(body.shape == "mesh" for body in scene.bodies)


def given_panels(db):
    """Whether the scene of a database gave panels, as a number or a mesh file, so that no tolerance applies"""
    scene = tomllib.loads(str(db.attributes.get("scene", "")))
    return "panels" in scene or any(body.get("shape") == "mesh" for body in scene.get("bodies", ()))


def doubts(db):
    """Lines on a database that is incomplete, or breaks laws of physics, for the studies that use it"""
    if not db.complete:
        yield (
            f"{db.path} is incomplete: {len(db.omega)} of {len(db.rows)} frequencies are solved; repeat the command "
            "that made it before you use these results"
        )
    failed = failed_laws(db, given_panels(db))
    if failed:
        yield f"{db.path}: {failed}; hakobune check {db.path} shows all of it"


def failures(outcome, db, own_panels):
    """Failures of a run: frequencies without a result, laws, the requested tolerance, and drift of several bodies

    outcome : `run.Outcome`; own_panels : from `gives_panels`
    """
    for where, reason in outcome.failures:
        name = where if isinstance(where, str) else f"ω = {where:.6g} rad/s"
        yield fails(f"{name} is not solved: {reason}")
    if outcome.stored:
        said = (failed_laws(db, own_panels), "" if own_panels else missed_tolerance(db), uncertain_drift(db))
        yield from (fails(text) for text in said if text)


def body_table(db):
    """rich table of the floating body at rest, or of several in a column each"""
    bodies = each_body(db)
    table = _table("bodies at rest" if db.bodies else "body at rest")
    table.add_column("quantity")
    for body in bodies:
        table.add_column(body.name if db.bodies else "value", justify="right")
    table.add_column("unit")
    for rows in zip(*map(_body_rows, bodies), strict=True):
        table.add_row(rows[0][0], *(value for _, value, _ in rows), rows[0][2])
    return table


def checks_table(checks):
    """rich table of physics checks"""
    table = _table("checks")
    for column, side in (("check", "left"), ("what", "left"), ("largest", "right"), ("at ω rad/s", "right")):
        table.add_column(column, justify=side)
    table.add_column("limit", justify="right")
    table.add_column("")
    for check in checks:
        done = np.isfinite(check.largest)
        verdict = ("[green]ok" if check.passed else f"[red]{check.exceeding} above") if done else "not applied"
        shown = (f"{check.largest:.1e}", f"{check.omega:.4g}") if done else ("", "")
        verdict = verdict if done else "not applied"
        table.add_row(check.name, CHECKED[check.name], *shown, f"{check.limit:.0e}", verdict)
    return table


def not_applied(checks, db):
    """A line on why checks were not applied to an imported set, () if there is nothing to say"""
    names = [check.name for check in checks if not np.isfinite(check.largest)]
    if not names or "imported" not in db.attributes:
        return ()
    return (
        f"note: not applied: {', '.join(names)}: hakobune stores these while it solves, but this database is "
        "imported; `hakobune import` compared it with an own solution of the hull, with the hull, and with "
        "laws between its numbers, and reported what was wrong",
    )


def resonances_of(db):
    """A line for each resonance of the freely floating body of a database"""
    if db.bodies or db.modes or "rao" not in db.names or not len(db.omega):
        return []
    try:
        body = db.reader
    except BetweenError:  # some frequencies have unknown numbers
        return []
    return resonance_lines(resonances(body), db.omega, db["rao"])


def print_outcome(console, outcome, db, own_panels):
    """The end of a run: body, checks, remarks, resonances, failures, and stored data; returns the exit status.

    own_panels : from `gives_panels`
    """
    console.print(body_table(db))
    if outcome.stored:
        console.print(checks_table(checked(db)))
    status = tell(
        [*outcome.remarks, *beyond_gap_water(db), *resonances_of(db), *failures(outcome, db, own_panels)],
        console,
        "note: ",
    )
    stored = f"{outcome.stored} of {outcome.total} frequencies stored in {outcome.path}"
    go_on = "" if outcome.exit_status == 0 else "; run the same command to continue"
    by = f"{outcome.solved} by this run" if outcome.jobs else "nothing was left to compute"
    console.print(f"{stored}, {by}{go_on}", highlight=False, markup=False, soft_wrap=True)
    return outcome.exit_status or status


def _check(name, values, omega, limit):
    if not np.isfinite(values).any():
        return Check(name, float("nan"), float("nan"), limit, 0)
    worst = int(np.nanargmax(values))
    return Check(name, float(values[worst]), float(omega[worst]), limit, int(np.sum(values > limit)))


def _body_rows(db):
    for key, value in db.dimensions.items():
        yield key, f"{value:g}", "m"
    yield "water depth", f"{db.water_depth:g}", "m"
    yield "displaced mass", f"{db.density * db.displaced_volume / 1000:.6g}", "t"
    yield "mass", f"{db.mass / 1000:.6g}", "t"
    yield "center of gravity", _point(db.center_of_mass), "m"
    yield "center of buoyancy", _point(db.center_of_buoyancy), "m"
    if db.bodies:
        body = db.database.bodies[db.number]
        yield "rotation center", _point(body.rotation_center), "m"
        yield "heading", f"{np.degrees(body.heading):.6g}", "°"
        yield "moves", "no, fixed" if body.fixed else "yes", ""
    else:
        yield "rotation center", _point(db.rotation_center), "m"
    yield "waterplane", f"{db.waterplane_area:.6g}", "m²"
    fixed = bool(db.bodies) and db.database.bodies[db.number].fixed
    for way in ("transverse", "longitudinal"):
        yield f"GM {way}", "–" if fixed else f"{getattr(db, f'{way}_metacentric_height'):.4g}", "m"
    yield from _free_periods(db)


def _free_periods(db):
    """Heave, roll and pitch of the free body; ~ marks a period outside the stored band, where A is constant"""
    if db.bodies or db.modes or "added_mass" not in db.names or not len(db.omega):
        return
    try:
        if db.reader.inertia is None:
            return
        periods = natural_periods(db.reader)
    except (BetweenError, np.linalg.LinAlgError):  # too few frequencies to interpolate, or no positive inertia
        return
    for mode in (2, 3, 4):
        period, known = periods.period[mode], periods.inside[mode]
        if np.isfinite(period):
            yield f"natural period, {periods.names[mode].lower()}", f"{'' if known else '~'}{period:.4g}", "s"


def beyond_gap_water(db):
    """A line on natural periods of heave, roll and pitch that lie beyond the resonance of water in a gap or moonpool"""
    try:
        if db.bodies or db.modes or db.reader.inertia is None:
            return ()
        found = natural_periods(db.reader)
    except (BetweenError, np.linalg.LinAlgError, ValueError):
        return ()
    beyond = [m for m in (2, 3, 4) if np.isfinite(found.period[m]) and 2 * np.pi / found.period[m] > found.water[m]]
    said = ", ".join(f"{found.names[m].lower()} {found.period[m]:.4g} s" for m in beyond)
    return () if not said else (
        f"natural periods of {said} lie beyond the resonance of the water in a gap, which makes their added "
            f"mass negative from {found.water[beyond].min():.3g} rad/s on: at longer periods this water moves with "
            "the body and adds so much mass that these motions have no natural period there; in open water their "
            "natural periods are different",
    )  # fmt: skip


def _point(point):
    return ", ".join(f"{x + 0.0:.4g}" for x in np.round(point, 9))


def _table(title):
    from rich import box
    from rich.table import Table

    return Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
