"""Results of a load case, stored beside the other files of the case, so that a second run need not compute or draw
them again.

A stored file names its inputs (texts, databases, results, versions of the libraries, the code version) and has a
checksum.  If inputs or code have changed, or the file is damaged, the result is computed again.
"""

import base64
import hashlib
import json
from contextlib import suppress
from pathlib import Path

import numpy as np

from hakobune.meshing.whole_files import write_whole

from .numbers import Numbers
from .versions import code, versions

ARRAYS = tuple(name for name, kind in Numbers.__annotations__.items() if "ndarray" in str(kind))
PNG = "data:image/png;base64,"


def key_of(*parts):
    """Digest of texts, and of the bytes of files (Path; None for a missing one)"""
    key = hashlib.sha256(json.dumps([versions(), code()]).encode())
    for part in parts:
        content = b"" if part is None else part.read_bytes() if isinstance(part, Path) else part.encode()
        key.update(hashlib.sha256(content).digest())
    return key.hexdigest()


def kept(place, key, made):
    """JSON values of the file `place` if it has this key and is undamaged; otherwise the values of `made()`, which
    are then stored

    key : () → a digest, or OSError where one of its inputs does not exist yet; called again after `made`
    """
    with suppress(OSError, ValueError, KeyError, TypeError):
        stored = json.loads(place.read_text(encoding="utf-8"))
        if stored["of"] == key() and stored["seal"] == _seal(stored["values"]):
            return stored["values"]
    values = made()
    write_whole(place, json.dumps({"of": key(), "seal": _seal(values), "values": values}, indent=1))
    return values


def numbers_of(path, text, database, made):
    """`Numbers` of the study `text` with the result file `path`, from NAME_numbers.json; or from `made()`, then
    stored
    """
    place = path.with_name(f"{path.stem}_numbers.json")
    base = None if database is None else Path(database)
    return read_numbers(kept(place, lambda: key_of(text, base, path), lambda: plain(made())))


def plain(numbers):
    """Values of JSON of `Numbers`"""
    return {name: _listed(value) for name, value in numbers._asdict().items()}


def picture(place, key, draw):
    """Address of a picture (PNG) in `place`; it is drawn if the file is missing, damaged or has a different key

    place : .png; key : from `key_of`; draw : writes the picture to a path
    """
    place.parent.mkdir(parents=True, exist_ok=True)

    def made():
        draw(place)
        return hashlib.sha256(place.read_bytes()).hexdigest()

    note = place.with_suffix(".json")
    seal, content = kept(note, lambda: key, made), place.read_bytes() if place.is_file() else b""
    if hashlib.sha256(content).hexdigest() != seal:
        note.unlink()
        return picture(place, key, draw)
    return PNG + base64.b64encode(content).decode()


def _listed(value):
    return value.tolist() if isinstance(value, np.ndarray) else value


def _seal(values):
    return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()


def read_numbers(words):
    """`Numbers` of values of JSON"""
    found = {name: np.array(value, float) if name in ARRAYS else value for name, value in words.items()}
    for name in ("fairlead", "anchor"):
        found[name] = found[name].reshape(-1, 3)
    types = tuple(tuple(one) for one in found.pop("types"))
    flat = {name: tuple(found.pop(name)) for name in ("names", "hawsers", "warnings", "bodies")}
    return Numbers(types=types, **flat, **found)
