"""A scene as TOML text."""

from __future__ import annotations

import msgspec


def to_toml(scene):
    """The scene as TOML text from which the same scene is read."""
    import tomli_w

    return tomli_w.dumps(_given(msgspec.to_builtins(scene)))


def _given(value):
    """The tables without None, which TOML cannot represent"""
    if isinstance(value, dict):
        return {key: _given(part) for key, part in value.items() if part is not None}
    return [_given(part) for part in value] if isinstance(value, list | tuple) else value
