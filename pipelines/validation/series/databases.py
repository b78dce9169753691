"""Databases of the series, solved where they are not there."""

from __future__ import annotations

from ...common.quantities import StudyError


def whole_database(scene, path, fresh):
    """Path of the database of a Scene.  Raises StudyError where it is not whole, KeyboardInterrupt after Ctrl-C."""
    from ...solve.run import solve

    outcome = solve(scene, path, fresh=fresh)
    if outcome.interrupted:
        raise KeyboardInterrupt
    if outcome.exit_status:
        raise StudyError(f"{path} is not whole: not all frequencies are stored; see hakobune check {path}")
    return path
