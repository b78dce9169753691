"""Seas in words of studies and flags: families of spectra, their shape, spreading over directions."""

from __future__ import annotations

import math

from ..quantities import StudyError, Table, direction, positive

SPREADINGS = "cosine:N, half_cosine:S, mitsuyasu:SMAX, wrapped_normal:DEGREES"


class SeaTable(Table):
    """A further sea beside [waves], as swell

    height : m, significant
    period : s, mean
    """

    height: float
    period: float
    direction_deg: float | None = None
    incidence_deg: float | None = None
    spectrum: str = "issc"
    gamma: float | None = None
    spreading: str | None = None

    def sea(self, where, depth):
        """The Sea in water of `depth` m.  Raises StudyError."""
        positive(f"{where}.height", self.height)
        positive(f"{where}.period", self.period)
        return sea_of(where, self, direction(where, self), depth)


def family_of(where, table, depth):
    """Function of `mooring.seas.families` that the table names; depth : m.  Raises StudyError."""
    from mooring.seas.families import PEAKED, families

    known = families(depth)
    if table.spectrum not in known:
        raise StudyError(f"{where}.spectrum is {table.spectrum!r}; allowed: {', '.join(known)}")
    if table.gamma is not None and table.spectrum not in PEAKED:
        raise StudyError(f"{where}.gamma is given for {table.spectrum}; allowed: with {', '.join(PEAKED)}")
    return known[table.spectrum]


def sea_of(where, waves, towards, depth):
    """The Sea of a table with the keys of a SeaTable that travels towards a direction, rad, in `depth` m.

    Raises StudyError.
    """
    from mooring.environment.sea import Sea

    spectrum = family_of(where, waves, depth)(waves.height, mean_period=waves.period, **shape_of(waves))
    return Sea(spectrum, towards, spreading_of(where, waves, spectrum))


def shape_of(table):
    """Arguments of the shape of a spectrum"""
    return {} if table.gamma is None else {"gamma": table.gamma}


def spreading_of(where, table, spectrum):
    """The Spreading of a table, or None for long crests.  Raises StudyError."""
    try:
        return spreading(table.spreading, spectrum)
    except ValueError as error:
        raise StudyError(str(error).replace("--spreading", f"{where}.spreading")) from None


def spreading(text, spectrum):
    """The Spreading in words as `SPREADINGS`, None for None.  Raises ValueError."""
    from mooring.environment.spreading import CosinePower, HalfCosinePower, Mitsuyasu, WrappedNormal

    if text is None:
        return None
    makers = {
        "cosine": CosinePower,
        "half_cosine": HalfCosinePower,
        "mitsuyasu": lambda s: Mitsuyasu(s, spectrum.peak_omega),
        "wrapped_normal": lambda degrees: WrappedNormal(math.radians(degrees)),
    }
    kind, _, number = text.partition(":")
    try:
        maker, value = makers[kind], float(number)
    except (KeyError, ValueError):
        raise ValueError(f"--spreading is {text!r}; allowed: {SPREADINGS}") from None
    return maker(value)
