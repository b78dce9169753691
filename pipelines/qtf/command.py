"""`hakobune qtf`: difference-frequency forces of pairs of waves of a database's body, stored in it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

FREQUENCIES = 41, 48  # of the stored band, where none are asked for
SHARE = 0.4  # of the mean of the band: largest difference, where none is asked for
EVEN = 1e-6  # of the step between frequencies
LEVELS = ("body", "full", "auto")
MOST_WAVES = 1500  # frequencies times headings: their flow on the hull of a thousand panels takes 2 GB


def qtf(
    database: Annotated[Path, Parameter(help="database of a body, with its inertia where it floats")],
    /,
    *,
    omega: Annotated[str | None, Parameter(help="rad/s at even steps, start:stop:count, in the stored band")] = None,
    heading: Annotated[str | None, Parameter(help="degrees the waves travel to; all pairs of them")] = None,
    difference: Annotated[float | None, Parameter(help="rad/s, the largest", allow_leading_hyphen=True)] = None,
    fixed: Annotated[bool, Parameter(negative=(), help="of the body held, instead of floating")] = False,
    moored: Annotated[Path | None, Parameter(help="mooring study whose lines hold the floating body")] = None,
    level: Annotated[str, Parameter(help="body, full (with the surface's forcing) or auto")] = "body",
    method: Annotated[str, Parameter(help="panel, contour (vertical cylinders) or auto")] = "auto",
    fresh: Annotated[bool, Parameter(negative=(), help="again, though they are stored")] = False,
    plot: Annotated[Path | None, Parameter(help="picture: .png, .svg or .pdf")] = None,
):
    """Slow forces of pairs of waves: squares of the first order, bound long waves, the moving hull and, with
    --level full, the forcing of the surface around it, whose size is estimated where it is left out.

    They go into the database as differences are done, from the smallest on, for qtf = "body" or "full" of response
    studies and simulations.  A run that was ended goes on from them when it is given again, and a larger --difference
    adds to them.  The body is solved on its panels, a vertical cylinder by the contour method.  What is stored there
    already is told and drawn again.
    """
    from bem.database import DatabaseError, open_database
    from bem.second_order.stored import (
        read_forces,
        stored_errors,
        stored_method,
        stored_mooring,
        stored_share,
        unfinished,
    )

    from ..common.picture import PLOTS, check_picture
    from .problem import METHODS
    from .report import told
    from .running import adds_surface, solve

    if plot is not None:
        check_picture(plot, PLOTS)
    if level not in LEVELS:
        raise ValueError(f"--level is {level!r}; allowed: {', '.join(LEVELS)}")
    if method not in METHODS:
        raise ValueError(f"--method is {method!r}; allowed: {', '.join(METHODS)}")
    if fixed and moored is not None:
        raise ValueError("--fixed and --moored are both given; allowed: one of them")
    db = open_database(database)
    waves = _waves(db, omega, heading, difference)
    forces, holder = None, "" if moored is None else str(moored)
    if not fresh:
        try:
            stored, floats = read_forces(db)
            asked = any(value is not None for value in (omega, heading, difference)) or fixed == floats
            if not asked and unfinished(db) is not None:
                waves = stored.omega, stored.headings, unfinished(db)
                level = level if stored.surface is None else "full"
                method = stored_method(db) if method == "auto" else method
            lacks = stored.surface is None and adds_surface(level, stored_share(db))
            lacks = lacks or (moored is not None and stored_mooring(db) != holder)
            lacks = lacks or method not in ("auto", stored_method(db)) or unfinished(db) is not None
            forces = None if lacks or (asked and not _covers(stored, floats, waves, fixed)) else stored
        except DatabaseError:
            pass
    if forces is None:
        moving = not fixed if moored is None else _stiffness(moored, db)
        solve(db, waves, moving, level, method, holder, fresh)
        print(f"{database}: group qtf")
        db = open_database(database)
        forces, floats = read_forces(db)
    for line in told(forces, db, floats, stored_share(db), stored_mooring(db), stored_errors(db), stored_method(db)):
        print(line)
    if plot is not None:
        from .plot import draw

        draw(forces, db, floats, plot)
        print(plot)
    return 0


def _stiffness(study, db):
    """(6, 6) of the lines of a mooring study about the rotation centre, where they hold the body in its steady loads"""
    from mooring.studies.multi_point import multi_point

    from ..moor.study import read_study

    read, _ = read_study(study)
    hull = read.without_berth("qtf --moored").hull_of(db.dimensions)
    system = read.system(hull, db.rotation_center, db.density, db.gravity)
    return multi_point(db, system, hull, read.conditions(), read.allowable).equilibrium.stiffness


def _waves(db, omega, heading, difference):
    """Frequencies (n,) rad/s, headings (m,) rad and the largest difference that are asked for.  Raises ValueError."""
    import numpy as np

    from ..scene.scene import numbers

    low, high = float(db.omega[0]), float(db.omega[-1]) if len(db.omega) else 0.0
    if len(db.omega) < 2:
        raise ValueError(f"{db.path} has {len(db.omega)} solved frequencies; allowed: two or more")
    if omega is None:
        frequencies = multiples(low, high)
    else:
        given = numbers("--omega", omega)
        given = np.linspace(given["from"], given["to"], given["count"]) if isinstance(given, dict) else np.array(given)
        if len(given) < 2 or not np.all(np.diff(given) > 0) or np.ptp(np.diff(given)) > EVEN * np.diff(given).mean():
            raise ValueError(f"--omega is {omega}; allowed: two or more frequencies at equal steps, rising, rad/s")
        if not (np.all(np.isfinite(given)) and given.min() >= low * (1 - 1e-9) and given.max() <= high * (1 + 1e-9)):
            raise ValueError(f"--omega is {omega}; allowed: within the stored {low:.4g} to {high:.4g} rad/s")
        frequencies = given
    if heading is None:
        headings = db.wave_direction
    else:
        given = numbers("--heading", heading)
        given = np.linspace(given["from"], given["to"], given["count"]) if isinstance(given, dict) else given
        headings = np.radians(np.asarray(given, float))
        if not len(headings) or not np.all(np.isfinite(headings)):
            raise ValueError(f"--heading is {heading}; allowed: one or more, finite, degrees")
        headings = _once(headings)
    if difference is not None and not 0 < difference < math.inf:
        raise ValueError(f"--difference is {difference:g}; allowed: above 0, finite, rad/s")
    step = frequencies[1] - frequencies[0]
    if difference is not None and difference < step * (1 - EVEN):
        raise ValueError(
            f"--difference is {difference:g}; allowed: {step:.4g} rad/s, the step of the frequencies, or above; "
            "more of them by --omega"
        )
    if len(frequencies) * len(headings) > MOST_WAVES:
        raise ValueError(
            f"{len(frequencies)} frequencies and {len(headings)} headings are asked for; allowed: {MOST_WAVES} waves "
            "in all, choose with --omega and --heading"
        )
    widest = float(np.ptp(frequencies))
    return frequencies, np.unique(headings), min(difference or SHARE * float(frequencies.mean()), widest)


def _once(headings):
    """Those that no other turned by full circles comes before"""
    import numpy as np

    turned = np.exp(1j * headings)
    return headings[[np.abs(turned[:n] - turned[n]).min(initial=1.0) > 1e-9 for n in range(len(headings))]]


def multiples(low, high):
    """(n,) multiples of a step, which their differences are too, that end at `high` and begin closest to `low`, rad/s

    A frequency that is also a difference is solved once.
    """
    import numpy as np

    def first_of(steps):
        return int(np.ceil(low / high * steps * (1 - 1e-12)))

    least, most = (int(count / (1 - low / high)) for count in FREQUENCIES)
    fitting = [steps for steps in range(least, most + 1) if FREQUENCIES[0] <= steps - first_of(steps) + 1]
    steps = min(fitting, key=lambda steps: (round(first_of(steps) / steps - low / high, 9), steps))
    return high / steps * np.arange(first_of(steps), steps + 1)


def _covers(stored, floats, waves, fixed):
    """Whether what is stored holds what is asked for"""
    import numpy as np

    omega, headings, difference = waves
    step = stored.omega[1] - stored.omega[0]
    return (
        floats != fixed
        and stored.omega[0] <= omega[0] + 1e-9
        and stored.omega[-1] >= omega[-1] - 1e-9
        and step <= (omega[1] - omega[0]) * (1 + 1e-9)
        and stored.difference[-1] > difference - step
        and all(np.abs(np.exp(1j * stored.headings) - np.exp(1j * h)).min() < 1e-9 for h in headings)
    )
