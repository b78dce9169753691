"""Origin of a result: its input, the seal of its database, the version of the program."""

import hashlib
from pathlib import Path

from hakobune.bem import __version__


def provenance(text="", database=None, **more):
    """{name: text}; text : text of the study; database : an open database or the path of a database, or None"""
    made = {"software_version": __version__, "study": text, **more}
    if database is not None:
        path = Path(getattr(database, "path", database))
        made |= {"database": str(path), "database_sha256": hashlib.sha256(path.read_bytes()).hexdigest()}
    return {name: value for name, value in made.items() if value}
