"""Flags of the commands: the same keys as in a scene file, which they replace."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def _flag(text, converter=None, name=None):
    return Parameter(name=name, help=text, allow_leading_hyphen=True, converter=converter)


def _file(kind, tokens):
    """A path; an empty one would be read as the current folder."""
    token = tokens[0]
    if not token.value.strip():
        raise ValueError(f"{token.value!r} is empty; allowed: the name of a file, or leave it out")
    return Path(token.value)


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class SceneFlags:
    """Flags for all kinds of bodies."""

    depth: Annotated[float | None, _flag("water depth, m; inf for deep water")] = None
    omega: Annotated[str | None, _flag("frequencies, rad/s: a,b,c, start:stop:count or auto:from:to")] = None
    period: Annotated[str | None, _flag("wave periods, s, instead of omega")] = None
    heading: Annotated[str | None, _flag("headings, degrees the waves travel to (0: +x, 90: +y)")] = None
    tolerance: Annotated[float | None, _flag("relative error of the coefficients [0.01]")] = None
    panels: Annotated[str | None, _flag("number of panels on the complete hull, instead of tolerance")] = None
    method: Annotated[str | None, _flag("auto, panel, contour, transfer, pressure, strip or inverse-strip")] = None
    wall: Annotated[float | None, _flag("y of a wall along x that reflects all waves, m")] = None
    density: Annotated[float | None, _flag("density of the water, kg/m³ [1025]")] = None
    gravity: Annotated[float | None, _flag("acceleration of gravity, m/s² [9.80665]")] = None
    mass: Annotated[float | None, _flag("mass of the body, kg [that of the displaced water]")] = None
    center_of_gravity: Annotated[str | None, _flag("centre of gravity, x,y,z m [0,0,0]")] = None
    gm: Annotated[float | None, _flag("metacentric height, m, instead of z of the centre of gravity", name="--GM")] = (
        None
    )
    gyration: Annotated[
        str | None, _flag("radii of gyration about the centre of gravity, kxx,kyy,kzz m; required for motions")
    ] = None
    trimmed: Annotated[
        bool, Parameter(help="keep the trim of the mesh, even if the weight is off the centre of buoyancy", negative="")
    ] = False
    rotation_center: Annotated[str | None, _flag("point of rotations and moments, x,y,z m [0,0,0]")] = None
    only: Annotated[str | None, _flag("names or groups of results to compute, a,b,c [all]")] = None


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class RunFlags:
    """Output file and execution of a run."""

    output: Annotated[Path | None, _flag("the database, or the mesh file with --mesh-only", _file)] = None
    mesh_only: Annotated[bool, Parameter(help="write the mesh and stop", negative="")] = False
    fresh: Annotated[bool, Parameter(help="replace an existing database", negative="")] = False
    executor: Annotated[str, _flag("where to compute: local, processes:N, dask:N, dask://host:port, slurm:N")] = "local"


def overlaid(raw, flags, body):
    """The raw tables of a scene, with values replaced by the values of flags.

    raw : nested dictionaries, from `read_scene`; body : {key: value} of the body, without None
    Raises SceneError for unreadable lists.
    """
    from .scene import SceneError, band, numbers

    raw = dict(raw)
    water, waves = _table("water", raw.get("water", {})), _table("waves", raw.get("waves", {}))
    bodies = tables_of_bodies(raw)
    _put(water, depth=flags.depth, density=flags.density, gravity=flags.gravity)
    if flags.omega is not None and flags.period is not None:
        raise SceneError("--omega and --period are given; give only one of them")
    for key, flag, text in (("omegas", "omega", flags.omega), ("periods", "period", flags.period)):
        if text is not None:
            waves = {kept: value for kept, value in waves.items() if kept == "headings_deg"}
            if key == "omegas" and text.startswith("auto"):
                waves["band"] = band(f"--{flag}", text)
            else:
                waves[key] = numbers(f"--{flag}", text)
    if flags.heading is not None:
        waves["headings_deg"] = numbers("--heading", flags.heading)
    given = [key for key in ("mass", "center_of_gravity", "gm", "gyration") if getattr(flags, key) is not None]
    if len(bodies) > 1 and (given or body):
        key = next(iter((*given, *body))).replace("_", "-")
        raise SceneError(f"--{key} is for one body, but the scene has {len(bodies)}; give it under [[bodies]]")
    _put(bodies[0], mass=flags.mass, GM=flags.gm, trimmed=flags.trimmed or None, **body)
    for key in ("center_of_gravity", "gyration"):
        _put(bodies[0], **{key: _triple(key, getattr(flags, key))})
    _put(raw, method=flags.method, wall=flags.wall, rotation_center=_triple("rotation_center", flags.rotation_center))
    if flags.tolerance is not None or flags.panels is not None:  # beside panels a tolerance is the limit of checks
        replaced = ("panels",) if flags.tolerance is None else ("tolerance", "panels")
        raw = {key: value for key, value in raw.items() if key not in replaced}
        _put(raw, tolerance=flags.tolerance, panels=_whole_number("panels", flags.panels))
    if flags.only is not None:
        raw["want"] = [word.strip() for word in flags.only.split(",") if word.strip()]
    return {**raw, "water": water, "waves": waves, "bodies": bodies}


def tables_of_bodies(raw):
    """Copies of the tables [[bodies]], one empty table without any.  Raises SceneError."""
    from .scene import SceneError

    bodies = raw.get("bodies", [{}])
    if not isinstance(bodies, list):
        raise SceneError(f"bodies is {bodies!r}; allowed: [[bodies]] tables")
    return [_table(f"bodies[{i}]", part) for i, part in enumerate(bodies)] or [{}]


def _table(key, value):
    from .scene import SceneError

    if not isinstance(value, dict):
        raise SceneError(f"{key} is {value!r}; allowed: a table")
    return dict(value)


def _put(table, **values):
    table.update({key: value for key, value in values.items() if value is not None})


def _whole_number(key, text):
    """The command line's own conversion would truncate 2.5 to 2."""
    from .scene import SceneError

    try:
        return None if text is None else int(text)
    except ValueError:
        raise SceneError(f"--{key} is {text!r}; allowed: a whole number") from None


def _triple(key, text):
    from .scene import SceneError

    if text is None:
        return None
    try:
        first, second, third = map(float, text.split(","))
    except ValueError:
        flag = key.replace("_", "-")
        raise SceneError(f"--{flag} is {text!r}; allowed: three numbers a,b,c") from None
    return [first, second, third]
