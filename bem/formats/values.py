"""Content of another program's file for a database: the solved frequencies, in the conventions of `bem`."""

import re
from dataclasses import dataclass, field, replace

import numpy as np

from hakobune.meshing.text_files import read_text

from ..database.schema import BODY, LIMITS, QUANTITIES
from ..modes import moving, reference_change

CARRIED = tuple(name for name in QUANTITIES if not name.startswith("kochin") and name != "pressure")
# largest difference, over the largest value, of two data sets for one heading; files print four digits or more
SAME_HEADING = 1e-3
NOTE = re.compile("[!#]")
LARGEST = 2000  # MB of a text file with forces of many wave pairs
EVEN = 1e-6  # tolerance relative to the step for equally spaced numbers


class FormatError(ValueError):
    """A file of another program cannot be written or read; the message gives the reason and a remedy."""


@dataclass(frozen=True, eq=False)
class Values:
    """omega : frequencies, rising, rad/s, (n,); wave_direction : headings, rising, rad, (m,); water_depth : m, may be
    inf
    quantities : {name: array}, names and axes of `schema.QUANTITIES`; body : {name of `schema.BODY`: value}
    rotation_center : rotation centre, m, (3,); mesh : PanelMesh, or None; name : name of the body
    others : fixed bodies beside the body; left_out : messages on ignored data, with the reason
    bodies : `bem.modes.Body` of each of several bodies, with motions along the axes of the scene, for formats of
        several bodies
    """

    omega: np.ndarray
    wave_direction: np.ndarray
    water_depth: float
    density: float
    gravity: float
    quantities: dict
    body: dict = field(default_factory=dict)
    rotation_center: np.ndarray = field(default_factory=lambda: np.zeros(3))
    mesh: object = None
    name: str = "body"
    others: int = 0
    bodies: tuple = ()
    left_out: tuple = ()

    def get(self, name):
        """A quantity or a value of the body; None if missing"""
        return self.quantities.get(name, self.body.get(name))

    def need(self, *names):
        """The dictionary of quantities.  Raises FormatError, which names every missing quantity."""
        missing = [name for name in names if self.get(name) is None]
        if missing:
            way = "give it by --only"
            if any(name in BODY for name in missing):
                way = "give --gyration and --center-of-gravity to the command that solves or imports the body"
            raise FormatError(f"{', '.join(missing)} is not in the database; {way}")
        return [self.get(name) for name in names]


def about(values, point):
    """The same Values with rotations and moments about another point, m, (3,), or about one point for each of N
    bodies, (N, 3).

    x_old = T x_new,  F_new = Tᵀ F_old,  A_new = Tᵀ A_old T,    T = [[1, −r×], [0, 1]],  r from the new point to the old

    Limits that are not finite everywhere, such as heave at ω = 0 in finite depth, are removed.
    """
    if values.bodies:
        return _about_each(values, point)
    r = np.asarray(values.rotation_center, float) - np.asarray(point, float)
    if not r.any():
        return values
    T, moved = reference_change(-r).T, {}
    for name, data in values.quantities.items():
        axes = QUANTITIES[name][0]
        if name in LIMITS and not np.all(np.isfinite(data)):
            continue
        if axes[-2:] == ("influenced_dof", "radiating_dof"):
            moved[name] = T.T @ data @ T
        elif axes[-1] == "influenced_dof":
            moved[name] = data @ T
        elif axes[-1] == "radiating_dof":
            moved[name] = data @ np.linalg.inv(T).T
        else:  # mean drift: surge, sway, yaw
            moved[name] = data.copy()
            moved[name][..., 2] += r[0] * data[..., 1] - r[1] * data[..., 0]
    body = dict(values.body)
    for name in ("inertia_matrix", "hydrostatic_stiffness"):
        if name in body:
            body[name] = T.T @ body[name] @ T
    return replace(values, quantities=moved, body=body, rotation_center=np.array(point, float))


def _about_each(values, points):
    """`about` of bodies that all move; their drift, about one point for all, stays as it is"""
    T = np.zeros((6 * len(values.bodies),) * 2)
    for i, (body, point) in enumerate(zip(values.bodies, np.asarray(points, float), strict=True)):
        own = slice(6 * i, 6 * i + 6)
        T[own, own] = reference_change(point - np.asarray(body.rotation_center)).T
    turn = {"influenced_dof": T, "radiating_dof": np.linalg.inv(T).T}

    def moved(axes, data):
        if axes[-2:] == ("influenced_dof", "radiating_dof"):
            return T.T @ data @ T
        return data @ turn[axes[-1]] if axes and axes[-1] in turn else data

    quantities = {name: moved(QUANTITIES[name][0], data) for name, data in values.quantities.items()}
    body = {name: moved(BODY[name][0], data) for name, data in values.body.items()}
    bodies = tuple(
        body._replace(rotation_center=tuple(map(float, point)))
        for body, point in zip(values.bodies, points, strict=True)
    )
    return replace(values, quantities=quantities, body=body, bodies=bodies)


def of_each(values):
    """[Values] of each body: the forces on this body due to the motions of all bodies, and the data of this body. For a
    single body the list contains the given Values alone"""
    if not values.bodies:
        return [values]
    return [_of_one(values, number) for number in range(len(values.bodies))]


def _of_one(values, number):
    own, body, moved = slice(6 * number, 6 * number + 6), {}, moving(values.bodies)
    columns = [moved.index(d) for d in range(own.start, own.stop) if d in moved]  # none of a fixed body
    quantities = {}
    for name, data in values.quantities.items():
        axes = QUANTITIES[name][0]
        if "influenced_dof" in axes:
            quantities[name] = np.take(data, range(own.start, own.stop), axis=axes.index("influenced_dof") - len(axes))
    for name, data in values.body.items():
        square = BODY[name][0][-2:] == ("influenced_dof", "radiating_dof")
        if not square or columns:
            body[name] = data[own][:, columns] if square else data[number]
    one = values.bodies[number]
    return replace(values, quantities=quantities, body=body, rotation_center=np.asarray(one.rotation_center, float),
                   name=one.name, bodies=(), others=len(values.bodies) - 1)  # fmt: skip


def values_of(db, several=False):
    """The Values of an opened database.  Raises DatabaseError if nothing is solved yet.

    several : whether a database of several bodies is allowed; False: DatabaseError
    """
    db.require_rigid()
    if not several:
        db.require_one_body()
    names = [name for name in CARRIED if name in db.names and (name not in LIMITS or db.complete)]
    header = db.header
    found = Values(
        np.asarray(db.omega),
        np.asarray(db.wave_direction),
        header.water_depth,
        header.density,
        header.gravity,
        {name: db[name] for name in names},
        {name: header.body[name] for name in BODY if header.body.get(name) is not None},
        np.asarray(header.rotation_center, float),
        header.mesh,
        db.path.stem,
        bodies=db.bodies,
    )
    return _along_scene(found) if db.bodies else found


def _along_scene(values):
    """Values of several bodies with the motions of each along the axes of the scene, about its own point"""
    turn = np.zeros((6 * len(values.bodies),) * 2)
    for i, body in enumerate(values.bodies):
        own = slice(6 * i, 6 * i + 6)
        turn[own, own] = np.kron(np.eye(2), body.axes.T)
    own = turn[np.ix_(moving(values.bodies), moving(values.bodies))]
    both = {"influenced_dof": turn, "radiating_dof": own}

    def turned(axes, data):
        for place, axis in enumerate(axes, -len(axes)):
            if axis in both:
                data = np.moveaxis(np.moveaxis(data, place, -1) @ both[axis], -1, place)
        return data

    finite = {n: data for n, data in values.quantities.items() if n not in LIMITS or np.all(np.isfinite(data))}
    quantities = {name: turned(QUANTITIES[name][0], data) for name, data in finite.items()}
    body = {name: turned(BODY[name][0], data) for name, data in values.body.items()}
    return replace(values, quantities=quantities, body=body)


def body_of(place, count, known):
    """Index, from 0, of the body whose number, from 1, is known["body"].  Raises FormatError.

    The coefficients of this body are those of the body moving while the other bodies are fixed.
    """
    body = (known or {}).get("body")
    if body is None and count == 1:
        return 0
    if body is None or not 1 <= body <= count:
        asked = "" if body is None else f"--body is {body}, "
        raise FormatError(
            f"{asked}{place} has {count} bod{'y' if count == 1 else 'ies'}; give one of them by --body, 1 to "
            f"{count}; the other bodies are held fixed"
        )
    return int(body) - 1


def evenly(what, numbers, unit, way_out):
    """Return (first, last, count) of equally spaced numbers.  Raises FormatError for unequal spacing, which some
    files do not support."""
    steps = np.diff(numbers)
    if len(steps) and not np.all(np.abs(steps - steps.mean()) <= EVEN * steps.mean()):
        raise FormatError(
            f"{what} are {steps.min():.4g} to {steps.max():.4g} {unit} apart; allowed in this format: evenly spaced, "
            f"{way_out}"
        )
    return float(numbers[0]), float(numbers[-1]), len(numbers)


def lines_of(path):
    """Lines of another program's text file, with undecodable bytes replaced.  Raises FormatError."""
    return read_text(path, FormatError, errors="replace", largest=LARGEST).splitlines()


def table_of(path, columns):
    """Numbers of a text file; shape (k, columns); lines that do not begin with a number, and notes after an
    exclamation mark, are ignored.  Raises FormatError.

    columns : allowed counts of numbers in a line; shorter lines are filled up with NaN
    """
    rows = []
    for number, line in enumerate(lines_of(path), 1):
        words = NOTE.split(line, maxsplit=1)[0].replace("D+", "E+").replace("D-", "E-").split()
        try:
            row = [float(word) for word in words]
        except ValueError:
            if not rows:
                continue  # a heading
            raise FormatError(
                f"{path}, line {number}: {line.strip()!r} contains something that is not a number"
            ) from None
        if row and len(row) not in columns:
            raise FormatError(
                f"{path}, line {number} has {len(row)} numbers; allowed: {' or '.join(map(str, columns))}"
            )
        if row:
            rows.append(row + [np.nan] * (max(columns) - len(row)))
    if not rows:
        raise FormatError(f"{path} has no numbers")
    return np.array(rows)


def gridded(path, coordinates, values, modes=()):
    """Rising coordinates and values on their grid.  Raises FormatError for a grid point with no value or two.

    coordinates : list of (k,); values : (k, …); returns : list of (n_i,), array (n_0, n_1, …, …)
    modes : all possible numbers of each of the last coordinates; a value missing from the table is 0, because
        programs omit values that are 0 by symmetry (WAMIT user manual, version 7.4, chapter 5)
    """
    free = len(coordinates) - len(modes)
    axes, places = zip(*(np.unique(axis, return_inverse=True) for axis in coordinates), strict=True)
    axes, places = list(axes), list(places)
    for i, allowed in enumerate(modes, free):
        allowed = np.asarray(allowed, float)
        strange = np.setdiff1d(axes[i], allowed)
        if len(strange):
            raise FormatError(
                f"{path} has mode {strange[0]:g}; allowed for one rigid body: {', '.join(f'{n:g}' for n in allowed)}"
            )
        axes[i], places[i] = allowed, np.searchsorted(allowed, axes[i])[places[i]]
    places, shape = tuple(places), tuple(map(len, axes))
    counts = np.zeros(shape, int)
    np.add.at(counts, places, 1)
    if modes:
        counts += counts.sum(axis=tuple(range(free)), keepdims=True) == 0
    grid = np.zeros(shape + values.shape[1:], values.dtype)
    grid[places] = values
    other = ((grid[places] != values) & ~np.isnan(values)).any(axis=tuple(range(1, values.ndim)))
    twice = np.zeros(shape, bool)
    twice[tuple(place[other] for place in places)] = True
    if np.any(twice | (counts == 0)):  # a place filled again with the same value counts once
        where = np.argwhere(twice | (counts == 0))[0]
        said = ", ".join(f"{axis[i]:.6g}" for axis, i in zip(axes, where, strict=True))
        raise FormatError(
            f"{path}: {counts[tuple(where)]} values for {said}; allowed: exactly one value for each combination"
        )
    return axes, grid


def omega_of(column, kind, depth, gravity, length=1.0):
    """Frequencies, rad/s, which may be 0 and infinite, from numbers of the given kind; shape (n,)

    kind : "period", s, or "wavelength", m, with 0 for ω = ∞ and −1 for ω = 0; "frequency", rad/s, "wavenumber" or
        "deep wavenumber", rad/m, with 0 for ω = 0 and −1 for ω = ∞
    length : length by which wavenumbers are multiplied, m
    """
    x = np.asarray(column, float)
    limits = {"period": (-1.0, 0.0), "wavelength": (-1.0, 0.0)}.get(kind, (0.0, -1.0))
    zero, endless = (np.isclose(x, limit, atol=1e-9) if limit <= 0 else x < 0 for limit in limits)
    y = np.where(zero | endless, 1.0, x)
    k = 2 * np.pi / y if kind == "wavelength" else y / length
    if kind in ("wavenumber", "wavelength"):
        omega = np.sqrt(gravity * k * np.tanh(np.minimum(k * depth, 50.0)))
    else:
        omega = {"period": 2 * np.pi / y, "frequency": y, "deep wavenumber": np.sqrt(gravity * k)}[kind]
    return np.where(zero, 0.0, np.where(endless, np.inf, omega))


def with_headings_once(values):
    """Values with each heading once: headings that differ by full circles are merged if they agree.

    Programs list −180 and 180, or 0 and 360.  Raises FormatError if values of one heading differ by more than
    `SAME_HEADING` of the largest value of their quantity.
    """
    turned = np.mod(values.wave_direction, 2 * np.pi)
    turned = np.where(turned > 2 * np.pi - 1e-6, 0.0, turned)
    order = np.argsort(turned, kind="stable")
    later = order[1:][np.diff(turned[order]) < 1e-6]
    if not len(later):
        return values
    kept = np.setdiff1d(np.arange(len(turned)), later)
    partner = [next(j for j in kept if abs(turned[j] - turned[i]) < 1e-6) for i in later]
    quantities = {}
    for name, data in values.quantities.items():
        if "wave_direction" in QUANTITIES[name][0]:
            off = np.abs(data[:, later] - data[:, partner]).max(initial=0.0)
            if off > SAME_HEADING * np.abs(data).max(initial=0.0):
                one, two = (np.degrees(values.wave_direction[i]) for i in (partner[0], later[0]))
                raise FormatError(
                    f"{name} differs by {off:.3g} between headings {one:g}° and {two:g}°, which are the same "
                    f"direction; allowed: {100 * SAME_HEADING:g} % of its largest value; leave out one of the two"
                )
            data = data[:, kept]
        quantities[name] = data
    return replace(values, wave_direction=values.wave_direction[kept], quantities=quantities)
