"""A floating body between dolphins in an earthquake, by each available method, side by side."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..criteria.failing import fails
from ..fenders.fender import FenderError
from ..site.seismic import seismic_force
from .earthquake import Fenders, Floater, by_spectrum, course, natural, normalised_reaction, response_spectrum

GRAVITY = 9.80665
SHORT = 1e-3  # relative step of a deflection


@dataclass(frozen=True, eq=False)
class Quake:
    """A body in one motion, its fenders, and the known data of the ground motion

    ground, spectrum : None where not given; spectrum : function of the period; ratio : damping ratio of the spectrum
    coefficient : coefficient of the rule, or None
    """

    motion: str
    floater: Floater
    fenders: Fenders
    ground: object
    spectrum: object
    ratio: float
    coefficient: float | None

    def normalised(self, periods, stiffness):
        """Reaction over the reaction by the seismic coefficient; shape (q,); stiffness : N/m of springs; periods : (q,)
        s of the ground"""
        omega = 2 * np.pi / np.asarray(periods, float)
        return normalised_reaction(omega, self.floater.mass, *self.floater.water(omega), stiffness)


class Method(NamedTuple):
    """Results of a method: period s, damping ratio, acceleration m/s², reaction N, deflection m; nan where undefined

    reason : reason for a failure of the fenders
    """

    name: str
    period: float = np.nan
    ratio: float = np.nan
    acceleration: float = np.nan
    reaction: float = np.nan
    deflection: float = np.nan
    reason: str = ""


def methods(quake):
    """[`Method`] of a Quake, and the `earthquake.Course` or None"""
    rows, run = [], None
    if quake.coefficient is not None:
        rows.append(_by_coefficient(quake))
    if quake.spectrum is not None:
        rows.append(_by_spectrum(quake, "response spectrum", quake.spectrum, quake.ratio))
    if quake.ground is not None:
        of_record = lambda T: float(response_spectrum(quake.ground, [T])[0])  # noqa: E731
        rows.append(_by_spectrum(quake, "spectrum of the record", of_record, 0.05))
        largest = Method("record in time", acceleration=float(np.abs(quake.ground.acceleration).max()))
        try:
            run = course(quake.ground, quake.floater, quake.fenders)
            reaction, deflection = float(np.abs(run.reaction).max()), float(run.deflection.max())
            rows.append(largest._replace(reaction=reaction, deflection=deflection))
        except FenderError as error:
            rows.append(largest._replace(reason=str(error)))
    return rows, run


def failures(quake, rows):
    """Failures of fenders by each `Method`"""
    fender = quake.fenders.fender
    for row in rows:
        if row.reason:
            yield fails(f"{row.name}: {row.reason}")
        elif (strain := fender.own(row.deflection) / fender.height) > fender.own_allowable * (1 + 1e-9):
            yield fails(
                f"{row.name}: the fenders are compressed by {100 * strain:.4g} % of their height; allowable "
                f"{100 * fender.own_allowable:.4g} %; use more or larger fenders"
            )


def untouched(quake, rows):
    """A finding that names those of the `Method`s by which no fender is touched"""
    free = [row.name for row in rows if row.reaction == 0]
    if free:
        yield f"{', '.join(free)}: no fender is touched; the clearance is {quake.fenders.clearance:g} m on each side"


def stiffnesses(quake, rows):
    """{name: (stiffness N/m, natural period s)} of all fenders on a side: from the initial slope, and from the
    largest deflection
    """
    fender, count = quake.fenders.fender, quake.fenders.count
    short = SHORT * fender.limit
    found = {"first slope": count * float(fender.loading.slope(short))}
    most = max((row.deflection for row in rows if row.deflection > short), default=0.0)
    if most:
        found[f"{most:.3g} m"] = count * float(fender.loading(most)) / most
    return {name: (k, 2 * np.pi / natural(quake.floater, k)) for name, k in found.items()}


def _by_coefficient(quake):
    fenders, coefficient = quake.fenders, quake.coefficient
    force = seismic_force(coefficient, quake.floater.mass * GRAVITY)
    found = Method(f"seismic coefficient {coefficient:g}", acceleration=coefficient * GRAVITY, reaction=force)
    return _tried(found, lambda: found._replace(deflection=_deflection(fenders.fender, force / fenders.count)))


def _by_spectrum(quake, name, spectrum, ratio):
    def found():
        s = by_spectrum(quake.floater, quake.fenders, spectrum, ratio)
        return Method(name, s.period, s.ratio, s.acceleration, s.reaction, s.deflection)

    return _tried(Method(name), found)


def _tried(method, found):
    """Result of `found`, or the method with the reason why it fails"""
    try:
        return found()
    except ValueError as error:
        return method._replace(reason=str(error))


def _deflection(fender, force):
    """m, smallest deflection at which a fender reacts with a force, N.  Raises FenderError if it never does."""
    grid = np.linspace(0.0, fender.limit, 4001)
    above = np.flatnonzero(fender.loading(grid) >= force)
    if not len(above):
        raise FenderError(
            f"{fender.name}: {force / 1e3:.4g} kN act on it, but its table ends at "
            f"{fender.largest_reaction(fender.limit) / 1e3:.4g} kN; use more or larger fenders"
        )
    return float(np.interp(force, fender.loading(grid[: above[0] + 1]), grid[: above[0] + 1]))
