"""Solution of a scene as a function."""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from hakobune.mooring.criteria.failing import FAILS

from ..executors.choice import executor_of
from ..results.given import File, Tables
from ..scene.scene import Scene, SceneError, make_scene, read_scene

if TYPE_CHECKING:
    from rich.console import Console

    from hakobune.bem.database import Database


def solve(
    scene: File | Tables | Scene,
    output: File,
    *,
    fresh: bool = False,
    executor: str = "local",
    console: Console | None = None,
) -> Database:
    """Added mass, damping, wave forces, motions and mean drift of a floating body, frequency by frequency.

    scene : path of a scene, its tables as a dictionary, or a `pipelines.scene.scene.Scene`; angles in degrees
    output : path of the database, continued where it stopped; fresh : whether to replace an existing database
    executor : executor as in the command; console : console for the progress
    returns : Database, open for reading, in SI, angles in rad
    warns : with the remarks of the command: violated laws, a tolerance that was not reached
    raises : ValueError, with a message of one line, also for a frequency that fails (solved frequencies are kept);
        KeyboardInterrupt
    """
    from hakobune.bem.database import open_database

    from .report import failures, gives_panels
    from .run import solve as fill

    scene, workers = _scene(scene), executor_of(executor)
    try:
        outcome = fill(scene, Path(output), fresh=fresh, executor=workers, console=console)
    finally:
        workers.shutdown(wait=False, cancel_futures=True)
    if outcome.interrupted:
        raise KeyboardInterrupt
    made = open_database(output)
    said = [line.removeprefix(FAILS) for line in failures(outcome, made, gives_panels(scene))]
    if outcome.failures:
        raise SceneError("; ".join(said[: len(outcome.failures)]))
    for line in (*outcome.remarks, *said):
        warnings.warn(line.removeprefix(FAILS), stacklevel=2)
    return made


def _scene(given: File | Tables | Scene) -> Scene:
    if isinstance(given, Scene):
        return given
    if isinstance(given, str | os.PathLike):
        return make_scene(read_scene(given))
    return make_scene(given)
