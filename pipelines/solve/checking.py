"""`hakobune check`: does the physics of a database hold, and is its mesh sound."""

from __future__ import annotations

import numpy as np

from bem.database import DatabaseError, open_database
from meshing.quality import findings

from ..scene.methods import METHODS
from .report import checked, checks_table

OTHERS = {  # attribute `schema` of what other commands write: the command, and the one that reads it
    "hakobune mooring study 1": ("moor", None),
    "hakobune response study 1": ("response", None),
    "hakobune sections 1": ("sections", None),
    "hakobune channels 1": ("lines or line-dynamics", "lines"),
}


def check(path, console):
    """Print checks and findings of a database; returns 0 if all is there and holds, else 1."""
    db = _opened(path)
    found = _findings(db)
    checks = checked(db) if len(db.omega) else []
    if checks:
        console.print(checks_table(checks))
    for finding in found:
        console.print(f"{finding.severity}: {finding.text}", highlight=False, markup=False, soft_wrap=True)
    if not db.complete:
        stored = f"{int(db.rows.sum())} of {len(db.rows)} frequencies are stored"
        console.print(f"incomplete: {stored}; run its command again to go on", highlight=False, soft_wrap=True)
    sound = all(part.passed for part in checks) and not any(f.severity == "error" for f in found)
    return 0 if sound and db.complete else 1


def _opened(path):
    """The database of a file.  Raises DatabaseError, which names what another command wrote."""
    try:
        return open_database(path)
    except DatabaseError:
        attributes = _attributes(path)
        if attributes.get("schema") not in OTHERS:
            raise
    raise DatabaseError(f"{path} is {_named(path, attributes)}")


def _attributes(path):
    """Of an HDF5 file; none of any other"""
    import h5py

    try:
        with h5py.File(path) as file:
            return dict(file.attrs)
    except OSError:
        return {}


def _named(path, attributes):
    """What a file of OTHERS is, what reads it, and which database can be checked in its place"""
    writer, reader = OTHERS[attributes["schema"]]
    reads = f"hakobune {reader} {path} draws it" if reader else "no command reads it, h5py does"
    source = attributes.get("database")
    checked = f"check the database it was made with, {source}" if source else "check takes a database"
    return f"a result of hakobune {writer}, not a database; {reads}; {checked}"


def _findings(db):
    if not _on_panels(db):
        return findings(db.mesh)
    if not len(db.omega):
        return findings(db.mesh, db.water_depth, lid=db.lid)
    wave = 2 * np.pi / float(db["wavenumber"].max())
    return findings(db.mesh, db.water_depth, wave, db.lid)


def _on_panels(db):
    """Whether anything was computed with the mesh; other methods have one to be looked at"""
    method = METHODS.get(db.attributes.get("method"))
    return method is None or method.panels or "pressure" in db.names
