"""`hakobune body`: mass, centre of gravity and radii of gyration added to an imported database, or replaced.

Stiffness by weight, and motions of the free body, are recomputed. Drift of the free body depends on the old motions
and is removed. If no mass was known, motions and drift are those of the files, and are kept. Forces of pairs of
waves are removed.
"""

from dataclasses import replace

from hakobune.bem.database import open_database
from hakobune.bem.database.file import check_place
from hakobune.bem.database.schema import NEEDS_MOTION
from hakobune.bem.database.widening import read_group
from hakobune.bem.formats.afloat import on_hull
from hakobune.bem.formats.values import values_of
from hakobune.meshing.whole_files import made_beside

from ..common.outputs import DATABASE, check_ending
from ..printing.console import new_console
from ..printing.verdict import tell
from .importing import between, store


def weigh(database, weight, frequencies, output):
    """Write the database with the weight of `weight` and the frequencies (from, to) in rad/s.  Raises ValueError.

    weight : `bem.formats.afloat.Weight`, with None for values of the database; output : path, or None for the same
    """
    db = open_database(database)
    if "imported" not in db.attributes:
        raise ValueError(
            f"{database} was solved by hakobune; give --gyration, --center-of-gravity and --mass to the command "
            f"that made it"
        )
    if not weight.given and frequencies == (0.0, float("inf")):
        print(_line(db))
        return 0
    output = database if output is None else output
    check_place(output)
    check_ending(output, DATABASE)
    if output.exists() and output.resolve() != database.resolve():
        raise ValueError(f"{output} exists already; give another name by --output")
    values = values_of(db)
    before = values.body.get("inertia_matrix") is not None
    held = [name for name in NEEDS_MOTION if name in values.quantities]
    if weight.given and before:
        values = replace(values, quantities={n: v for n, v in values.quantities.items() if n not in held})
    values, remarks = on_hull(between(values, *frequencies), db.mesh, weight)
    remarks = [*remarks, *_of_motions(held, weight.given, before), *_of_pairs(db)]
    source = db.attributes["imported"]
    with made_beside(output) as partial:
        store(values, db.mesh, partial, source)
    print(_line(open_database(output)))
    return tell(remarks, new_console(stderr=True))


def _of_motions(held, given, before):
    """A remark on drift and other quantities `held` that depend on motions; before : whether a mass was known"""
    names = ", ".join(name for name in held if name != "rao")
    if names and given and before:
        yield f"{names} depends on the former mass and is removed"
    elif names and given:
        yield f"{names} is kept: it belongs to the motions in the files, not to the motions with this mass"


def _of_pairs(db):
    from hakobune.bem.second_order.stored import GROUPS

    names = [name for name in GROUPS.values() if read_group(db, name) is not None]
    if names:
        flags = "--mass, --center-of-gravity and --gyration"
        yield f"{', '.join(names)} is not carried over; to keep it, give {flags} to `hakobune import`"


def _line(db):
    body = db.header.body
    said = [f"{db.path}: {len(db.omega)} frequencies"]
    if body.get("mass") is not None:
        said.append(f"mass {float(body['mass']):.6g} kg")
    if body.get("center_of_mass") is not None:
        said.append("centre of gravity " + ", ".join(f"{x:g}" for x in body["center_of_mass"]) + " m")
    said.append("motions" if "rao" in db.names else "no motions: give --gyration kxx,kyy,kzz")
    return ", ".join(said)
