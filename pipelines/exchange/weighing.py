"""`hakobune body`: mass, centre of gravity and radii of gyration added to an imported database, or replaced.

Stiffness by weight, and motions of the free body, are recomputed. Drift of the free body and forces of wave pairs are
removed, since they depend on the old motions.
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
    values, lost = values_of(db), []
    if weight.given:
        gone = [name for name in NEEDS_MOTION if name in values.quantities]
        values = replace(values, quantities={n: v for n, v in values.quantities.items() if n not in gone})
        lost = [name for name in gone if name != "rao"]
    values, remarks = on_hull(between(values, *frequencies), db.mesh, weight)
    lost += _pairs(db)
    if lost:
        remarks = [*remarks, f"{', '.join(lost)} depends on the former mass and is removed"]
    source = db.attributes["imported"]
    with made_beside(output) as partial:
        store(values, db.mesh, partial, source)
    print(_line(open_database(output)))
    return tell(remarks, new_console(stderr=True))


def _pairs(db):
    from hakobune.bem.second_order.stored import GROUPS

    return [name for name in GROUPS.values() if read_group(db, name) is not None]


def _line(db):
    body = db.header.body
    said = [f"{db.path}: {len(db.omega)} frequencies"]
    if body.get("mass") is not None:
        said.append(f"mass {float(body['mass']):.6g} kg")
    if body.get("center_of_mass") is not None:
        said.append("centre of gravity " + ", ".join(f"{x:g}" for x in body["center_of_mass"]) + " m")
    said.append("motions" if "rao" in db.names else "no motions: give --gyration kxx,kyy,kzz")
    return ", ".join(said)
