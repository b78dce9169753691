"""A scene as text, and the part of it that may not change while its database grows."""

from __future__ import annotations

import hashlib
from pathlib import Path

import msgspec


def to_toml(scene):
    """The scene as TOML text that reads back as the same scene."""
    import tomli_w

    return tomli_w.dumps(_given(msgspec.to_builtins(scene)))


def fixed_part(scene):
    """{key: value} of all that may not change while a database grows; a mesh file counts by its content."""
    raw = msgspec.to_builtins(scene)
    raw = {key: value for key, value in raw.items() if key not in ("waves", "want")}
    if scene.panels is None:
        raw["tolerance"] = scene.accuracy
    for body in raw["bodies"]:
        if body["file"] is not None:
            body["file"] = "sha256 " + hashlib.sha256(Path(body["file"]).read_bytes()).hexdigest()[:16]
    return {key: repr(value) for key, value in _flat(raw) if value is not None}


def scene_hash(fixed):
    """Hash of `fixed_part`."""
    return hashlib.sha256(repr(sorted(fixed.items())).encode()).hexdigest()


def difference(old, new):
    """One phrase on the first keys in which two fixed parts differ."""
    keys = [key for key in {**old, **new} if old.get(key) != new.get(key)]
    shown = [f"{key} was {old.get(key, 'not given')}, is {new.get(key, 'not given')}" for key in keys[:2]]
    return "; ".join(shown) + (f" and {len(keys) - 2} more" if len(keys) > 2 else "")


def _given(value):
    """Without what is None, which TOML cannot say"""
    if isinstance(value, dict):
        return {key: _given(part) for key, part in value.items() if part is not None}
    return [_given(part) for part in value] if isinstance(value, list | tuple) else value


def _flat(value, path=""):
    if isinstance(value, dict):
        for key, part in value.items():
            yield from _flat(part, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for i, part in enumerate(value):
            yield from _flat(part, f"{path}[{i}]")
    else:
        yield path, value
