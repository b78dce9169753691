"""JSON Schema of each kind of file, from the typed table that reads the file, for completion and errors in an editor.

msgspec writes types, defaults and required keys; text, unit and example of each key are those of `reference`.
An editor with a TOML language server (taplo, Even Better TOML) reads the schema that the first line of a file names:

    #:schema schemas/study.schema.json
"""

import json
from pathlib import Path

import msgspec

from .kinds import KINDS, kind_named, struct_of
from .reference import reference, tables_of

DRAFT = "https://json-schema.org/draft/2020-12/schema"


def schema(kind):
    """JSON Schema of a kind of file as nested dictionaries.  Raises ValueError for a kind that does not exist."""
    made = msgspec.json.schema(struct_of(kind))
    for table, told in zip(tables_of(kind), reference(kind), strict=True):
        long = f"{table.__module__}.{table.__qualname__}"  # msgspec's name for two tables with the same name
        body = made["$defs"][table.__name__ if table.__name__ in made["$defs"] else long]
        body["description"] = told.meaning
        for key in told.keys:
            body["properties"][key.name]["description"] = described(key)
    return {"$schema": DRAFT, "title": f"hakobune {kind}: {kind_named(kind).meaning}", **made}


def described(key):
    """Unit, meaning and example of a `Key` in one line"""
    told = ", ".join(part for part in (key.unit, key.meaning) if part) or key.name.replace("_", " ")
    return f"{told}; e.g. {key.example}" if key.example else told


def write_schemas(folder):
    """Write NAME.schema.json of every kind into a folder, which is made.  Returns the paths."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for kind in KINDS:
        path = folder / f"{kind}.schema.json"
        path.write_text(as_text(schema(kind)) + "\n", encoding="utf-8")
        written.append(path)
    return written


def as_text(made):
    return json.dumps(made, ensure_ascii=False, indent=1)
