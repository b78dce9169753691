"""The flags of `hakobune export` and `hakobune import`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

FORMATS = "wamit, nemoh, hams, bemio (of WEC-Sim), hydrochrono (the same), capytaine or orcaflex"
Size = Annotated[float | None, Parameter(allow_leading_hyphen=True)]


def export(
    database: Annotated[Path, Parameter(help="database of hakobune, .h5")],
    /,
    *,
    to: Annotated[str, Parameter(help=FORMATS)],
    output: Annotated[Path | None, Parameter(help="file or folder [beside the database]")] = None,
    fresh: Annotated[bool, Parameter(help="replace an existing file", negative="")] = False,
):
    """Write a database as files of another program.

    hakobune export box.h5 --to wamit
    """
    from .command import export

    return export(database, to, output, fresh)


def import_(
    place: Annotated[Path, Parameter(help="file or folder of another program")],
    /,
    *,
    from_: Annotated[str, Parameter(name="--from", help=f"{FORMATS}, aqwa, diodore or hydrostar")],
    mesh: Annotated[
        Path | None, Parameter(help="mesh of the hull; for several bodies a,b,… [beside the results]")
    ] = None,
    depth: Annotated[float | None, Parameter(help="water depth, m or inf, if the files do not contain it")] = None,
    density: Annotated[float, Parameter(help="density of the water, kg/m³, if the files do not contain it")] = 1025.0,
    gravity: Annotated[float, Parameter(help="gravity, m/s², if the files do not contain it")] = 9.80665,
    length_unit: Annotated[
        float | None, Parameter(help="length unit of the files, m; ULEN of WAMIT [of the .gdf beside it]")
    ] = None,
    about: Annotated[
        str | None,
        Parameter(help="reference point of moments, x,y,z in m [as in the files]", allow_leading_hyphen=True),
    ] = None,
    body: Annotated[
        int | None,
        Parameter(help="number of the body, from 1, if the files have several; the others are held fixed"),
    ] = None,
    bodies: Annotated[
        str | None, Parameter(help="names of all bodies in the files, all of which move, such as float,spar")
    ] = None,
    frequencies: Annotated[str | None, Parameter(help="frequencies to import, from:to in rad/s [all]")] = None,
    mass: Annotated[float | None, Parameter(help="mass, kg [as in the files, else displaced mass]")] = None,
    center_of_gravity: Annotated[
        str | None,
        Parameter(
            help="centre of gravity, x,y,z in m [as in the files, else 0,0,0]; for several bodies x,y,z;x,y,z",
            allow_leading_hyphen=True,
        ),
    ] = None,
    gyration: Annotated[
        str | None,
        Parameter(help="radii of gyration, kxx,kyy,kzz in m, needed for motions; for several bodies separated by ;"),
    ] = None,
    output: Annotated[Path | None, Parameter(help="database to write [beside the files, .h5]")] = None,
    correct: Annotated[
        bool,
        Parameter(
            help="correct units, points, phases or headings that disagree with our own solution of the hull",
            negative="",
        ),
    ] = False,
    uncoupled: Annotated[
        bool,
        Parameter(
            help="for several bodies: leave out the coupling between them, as WEC-Sim does by default", negative=""
        ),
    ] = False,
    fresh: Annotated[bool, Parameter(help="replace an existing file", negative="")] = False,
):
    """Read results of another program into a database: a file, or the folder of Nemoh, HAMS or HydroStar.

    hakobune import barge.1 --from wamit --depth 20 --gyration 6,12,13 --center-of-gravity 0,0,1
    """
    from hakobune.bem.formats.afloat import Weight

    from .importing import import_

    about = _three("--about", about)
    known = {"water_depth": depth, "density": density, "gravity": gravity}
    known |= {"length_unit": length_unit, "rotation_center": about, "body": body}
    known["frequencies"] = _from_to(frequencies)
    points = {"--center-of-gravity": center_of_gravity, "--gyration": gyration}
    if bodies is not None:
        others = (about, body, mass, correct or None)
        return _of_several(place, from_, bodies, mesh, known, others, points, output, fresh, uncoupled)
    if uncoupled:
        raise ValueError("--uncoupled is given without --bodies; give --bodies with the names of all bodies")
    center, radii = (_three(flag, text) for flag, text in points.items())
    return import_(place, from_, mesh, known, Weight(mass, center, radii), output, fresh, correct)


def _of_several(place, kind, names, mesh, known, others, points, output, fresh, uncoupled):
    """`import_` of all bodies of a set; others : flags of one body; points : {flag: text} of each"""
    from hakobune.bem.formats.afloat import Weight

    from .several import import_several

    if any(one is not None for one in others):
        raise ValueError(
            "--bodies is given with --about, --body, --mass or --correct; several bodies are read exactly as the "
            "files describe them; leave these flags out"
        )
    names, each = names.split(","), []
    meshes = [None] * len(names) if mesh is None else [Path(part.strip()) for part in str(mesh).split(",")]
    if len(meshes) != len(names):
        raise ValueError(f"--mesh is {mesh}; allowed: a file for each of {', '.join(names)}, separated by commas")
    for flag, text in points.items():
        parts = [None] * len(names) if text is None else text.split(";")
        if len(parts) != len(names):
            raise ValueError(
                f"{flag} is {text!r}; allowed: three numbers for each of {', '.join(names)}, separated by ;"
            )
        each.append([_three(flag, part) for part in parts])
    weights = [Weight(None, *pair) for pair in zip(*each, strict=True)]
    names = [name.strip() for name in names]
    return import_several(place, kind, names, meshes, known, weights, output, fresh, uncoupled)


def body_(
    database: Annotated[Path, Parameter(help="imported, .h5")],
    /,
    *,
    mass: Annotated[float | None, Parameter(help="mass, kg [as stored, else displaced mass]")] = None,
    center_of_gravity: Annotated[
        str | None, Parameter(help="centre of gravity, x,y,z in m [as stored]", allow_leading_hyphen=True)
    ] = None,
    gyration: Annotated[str | None, Parameter(help="radii of gyration, kxx,kyy,kzz in m, needed for motions")] = None,
    frequencies: Annotated[str | None, Parameter(help="frequencies to keep, from:to in rad/s [all]")] = None,
    output: Annotated[Path | None, Parameter(help="database to write [the same file]")] = None,
):
    """Give an imported database mass, centre of gravity and radii of gyration, so that all studies can read it.

    hakobune body barge_imported.h5 --gyration 6,12,13 --center-of-gravity 0,0,1
    """
    from hakobune.bem.formats.afloat import Weight

    from .weighing import weigh

    center, radii = _three("--center-of-gravity", center_of_gravity), _three("--gyration", gyration)
    return weigh(database, Weight(mass, center, radii), _from_to(frequencies), output)


def _from_to(text):
    """Return (low, high), rad/s, from a text such as "0.2:1.5"; an omitted bound is None.  Raises ValueError."""
    low, colon, high = (text or ":").partition(":")
    try:
        found = float(low or 0.0), float(high or "inf")
    except ValueError:
        found = (1.0, 0.0)
    if not colon or not 0 <= found[0] < found[1]:
        raise ValueError(f"--frequencies is {text!r}; allowed: from:to in rad/s, such as 0.2:1.5, 0.2: or :1.5")
    return found


def _three(flag, text):
    """Finite numbers of a flag; shape (3,); or None.  Raises ValueError."""
    from math import isfinite

    from ..scene.scene import numbers

    if text is None:
        return None
    values = numbers(flag, text)
    if not isinstance(values, list) or len(values) != 3 or not all(map(isfinite, values)):
        raise ValueError(f"{flag} is {text!r}; allowed: three numbers in m, such as 0,0,1")
    return tuple(values)
