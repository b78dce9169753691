"""`hakobune check`: whether the physics of a database and its mesh are correct."""

import tomllib
from functools import partial

import numpy as np

from hakobune.bem.database import open_database
from hakobune.bem.database.file import opened
from hakobune.bem.database.integrity import DamagedError, repair
from hakobune.bem.database.schema import LIMITS
from hakobune.bem.database.widening import read_group
from hakobune.bem.second_order.kinds import DIFFERENCE
from hakobune.bem.second_order.stored import GROUPS, USABLE, failed_gap, read_forces
from hakobune.bem.stored_laws import OF_MOTIONS, broken_laws, worst_damping
from hakobune.meshing.hydrostatics import stands
from hakobune.meshing.quality import Finding, findings
from hakobune.meshing.whole_files import keep_room
from hakobune.mooring.criteria.failing import fails

from ..common.gaps import gaps_of
from ..common.typed import typed
from ..printing.verdict import tell
from ..scene.methods import METHODS
from ..scene.scene import Scene, SceneError
from .report import CHECKED, checked, checks_table, laws_of_imported, not_applied, resonances_of, way_out


def check(path, console, repair=False):
    """Print checks and findings of a database; 0 if nothing fails, else 1.

    repair : mark damaged parts of a database as unsolved first
    raises : ValueError for a file of another kind; damage, also of identifying data, is reported as a finding
    """
    say = partial(console.print, highlight=False, markup=False, soft_wrap=True)
    try:
        if repair:
            say(_repaired(path))
        db = open_database(path)
        found, checks = [*_findings(db), *_scene_findings(db)], checked(db) if len(db.omega) else []
        broken, unknown = _broken(db), [*gaps_of(db).not_known(), *_of_pairs(db)]
    except DamagedError as damage:
        return tell([fails(str(damage))], console)
    if checks:
        console.print(checks_table(checks))
    lines = [fails(f"{f.text}") if f.severity == "error" else f"{f.severity}: {f.text}" for f in (*found, *broken)]
    lines += [*map(fails, unknown), *not_applied(checks, db), *(f"note: {line}" for line in resonances_of(db))]
    way = "solve with more panels, or a coarser --tolerance"
    if "imported" in db.attributes:
        way = "solve a finer mesh in the program of the files, and import it"
    lines += [
        fails(
            f"{one.name}, {CHECKED[one.name]}, is {_beyond(one.largest, one.limit)} at ω = {one.omega:.4g} rad/s, "
            f"{one.exceeding} of {len(db.omega)} frequencies above {one.limit:g}{_weak(one, db)}; "
            f"{_unfit(one, db)}{way}"
        )
        for one in checks
        if not one.passed
    ]
    if not db.complete:
        lines.append(
            fails(f"{int(db.rows.sum())} of {len(db.rows)} frequencies are stored; run the command again to continue")
        )
    return tell(lines, console, "")


def _of_pairs(db):
    """What is wrong with the stored forces of wave pairs"""
    if read_group(db, GROUPS[DIFFERENCE]) is not None and (failed := failed_gap(read_forces(db).forces)) is not None:
        yield f'wave pairs: {failed[0]}; qtf = "auto" {"warns of them" if failed[1] <= USABLE else "leaves them out"}'


def _unfit(one, db):
    """What the energy of an imported set compares"""
    if one.name != "energy" or "imported" not in db.attributes:
        return ""
    return "its damping does not follow from its forces: check the depth, the units and the heading of the files, or "


def _beyond(value, limit):
    """A number above a limit with the digits that show it: 0.019, but 0.01003 for a limit of 0.01"""
    texts = [f"{value:.{digits}g}" for digits in (2, 3, 4, 6, 17)]
    return next((text for text in texts if float(text) > limit), texts[0])


def _weak(one, db):
    """Which damping it is, of a `Check` of damping"""
    if one.name != "damping":
        return ""
    force, motion = worst_damping(db)
    which = motion if force == motion else f"{motion} on {force}"
    return f": that of {which}, which makes few waves there"


def _broken(db):
    """Findings on laws that the stored numbers violate"""
    if not len(db.omega):
        return []
    for name in db.names:
        if name not in LIMITS or db.complete:
            db[name]  # every number against its checksum
    told = laws_of_imported(db)  # these are checks of their own
    laws = [one for one in broken_laws(db, float(db.attributes.get("tolerance", 0.01))) if one[0] not in told]
    return [
        Finding(
            "error",
            f"stored numbers: {law} is broken by {worst:.2g} at ω = {omega:.4g} rad/s; allowed: {limit:.2g}; "
            f"{_way_out(db, law)}",
        )
        for law, worst, omega, limit in laws
    ]


def _way_out(db, law):
    """What to do about stored numbers that break a law; those of other programs cannot be solved again"""
    if "imported" not in db.attributes:
        return way_out(law)
    if law == OF_MOTIONS:
        return f"'hakobune body {db.path.name} --gyration KXX,KYY,KZZ' computes the motions of its mass"
    return f"leave out such frequencies by 'hakobune body {db.path.name} --frequencies FROM:TO'"


def _repaired(path):
    """Mark damaged parts as unsolved; prints them."""
    keep_room(path)
    with opened(path, "r+") as file:
        found = repair(file)
    if not found:
        return f"{path}: nothing is damaged"
    what = ", ".join(f"{name} ({count})" for name, count in found.items())
    return (
        f"{path}: these frequencies are now marked as unsolved: {what}; repeat the command that made it to solve them"
    )


def _findings(db):
    if not _on_panels(db):
        return findings(db.mesh, db.water_depth if stands(db.mesh, db.water_depth) else np.inf)
    if not len(db.omega):
        return findings(db.mesh, db.water_depth, lid=db.lid)
    wave = 2 * np.pi / float(db["wavenumber"].max())
    return findings(db.mesh, db.water_depth, wave, db.lid)


def _scene_findings(db):
    """Whether the scene in a database is that of its water: of a file without checksums nothing else says so"""
    if not db.header.scene:
        return
    try:
        scene = typed(tomllib.loads(db.header.scene), Scene, SceneError)
    except ValueError as error:
        yield Finding("error", f"the text of its scene cannot be read: {error}; solve it again with --fresh")
        return
    said = {"depth": db.water_depth, "density": db.density, "gravity": db.gravity}
    for name, stored in said.items():
        if getattr(scene.water, name) != stored:
            yield Finding(
                "error",
                f"water.{name} is {getattr(scene.water, name):g} in its scene, but its results are for {stored:g}; "
                "solve it again with --fresh",
            )


def _on_panels(db):
    """Whether any result used the mesh; for other methods it is only drawn"""
    method = METHODS.get(db.attributes.get("method"))
    return method is None or method.panels or "pressure" in db.names
