"""A picture of the bending of a beam: the rise of its axis along it, in waves of a few frequencies."""

import numpy as np

from hakobune.bem.database import DatabaseError
from hakobune.bem.flexible.beams import Beam

from ..common.picture import save

PLACES, MOST = 201, 6  # along a beam, frequencies shown


def beams_of(db):
    """{number of a body: its Beams} with vertical bending in a database with motions"""
    out = {}
    for mode in db.modes if "rao" in db.names and len(db.omega) else ():
        if isinstance(mode.shape, Beam) and mode.shape.kind == "vertical bending":
            out.setdefault(mode.body, []).append(mode)
    return out


def axis_rise(db, number, x):
    """Complex vertical displacement of the beam axis of a body at x (…,), m, in its own coordinates, m per m; shape (n,
    m, x)"""
    rao, words = db["rao"], db.bodies_reader.names
    body = db.bodies[number] if db.bodies else None
    center = np.asarray(db.rotation_center if body is None else body.own_center)
    column = {name: rao[..., i] for i, name in enumerate(words)}
    before = "" if body is None else f"{body.name}__"
    out = column[f"{before}Heave"][..., None] - column[f"{before}Pitch"][..., None] * (x - center[0])
    out = out - column[f"{before}Roll"][..., None] * center[1]
    for mode in beams_of(db)[number]:
        out = out + column[before + mode.name][..., None] * mode.shape.along(x)
    return out


def deflections(db, output):
    """Draw every beam of a database to `output`, a picture; returns the matplotlib figure.  Raises DatabaseError."""
    from matplotlib.figure import Figure

    found = beams_of(db)
    if not found:
        raise DatabaseError(f"{db.path} contains no beam with motions; give [[modes]] and gyration, and solve again")
    figure = Figure(figsize=(9.0, 3.2 * len(found)), layout="constrained")
    shown = np.unique(np.linspace(0, len(db.omega) - 1, MOST).astype(int))
    for axis, (number, modes) in zip(figure.subplots(len(found), squeeze=False)[:, 0], found.items(), strict=True):
        x = np.linspace(modes[0].shape.start, modes[0].shape.end, PLACES)
        rise = np.abs(axis_rise(db, number, x))
        for i in shown:
            axis.plot(x, rise[i, 0], label=f"{2 * np.pi / db.omega[i]:.3g} s")
        name = f"{db.bodies[number].name}: " if db.bodies else ""
        towards = np.degrees(db.wave_direction[0])
        axis.set(
            title=f"{name}rise of the axis, waves towards {towards:g}°", xlabel="x  m", ylabel="m/m", ylim=(0, None)
        )
        axis.legend(frameon=False, ncols=2)
    save(figure, output, 130)
    return figure
