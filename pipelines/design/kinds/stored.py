"""Numbers of a load case in a file of their own, for doors whose results are not read back."""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from pathlib import Path

import numpy as np

from meshing.whole_files import write_whole

from .numbers import Numbers

ARRAYS = tuple(name for name, kind in Numbers.__annotations__.items() if "ndarray" in str(kind))


def numbers_of(path, text, database, made):
    """`Numbers` of the study `text`: of NAME_numbers.json beside `path` where it is of this study and database and
    undamaged, else as `made()` gives them, which are kept there"""
    place = path.with_name(f"{path.stem}_numbers.json")
    key = hashlib.sha256(text.encode())
    key.update(b"" if database is None else Path(database).read_bytes())
    with suppress(OSError, ValueError, KeyError, TypeError):
        stored = json.loads(place.read_text(encoding="utf-8"))
        if stored["of"] == key.hexdigest() and stored["seal"] == _seal(stored["numbers"]) and path.is_file():
            return _read(stored["numbers"])
    numbers = made()
    words = {name: _plain(value) for name, value in numbers._asdict().items()}
    write_whole(place, json.dumps({"of": key.hexdigest(), "seal": _seal(words), "numbers": words}, indent=1))
    return _read(words)


def _plain(value):
    return value.tolist() if isinstance(value, np.ndarray) else value


def _seal(words):
    return hashlib.sha256(json.dumps(words, sort_keys=True).encode()).hexdigest()


def _read(words):
    found = {name: np.array(value, float) if name in ARRAYS else value for name, value in words.items()}
    for name in ("fairlead", "anchor"):
        found[name] = found[name].reshape(-1, 3)
    types = tuple(tuple(one) for one in found.pop("types"))
    flat = {name: tuple(found.pop(name)) for name in ("names", "hawsers", "warnings")}
    return Numbers(types=types, **flat, **found)
