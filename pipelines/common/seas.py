"""Seas in words of studies and flags: families of spectra, their shape, spreading over directions."""

from __future__ import annotations

import math

from .quantities import StudyError

SPREADINGS = "cosine:N, half_cosine:S, mitsuyasu:SMAX, wrapped_normal:DEGREES"


def family_of(where, table, depth):
    """Function of `mooring.seas.families` that the table names; depth : m.  Raises StudyError."""
    from mooring.seas.families import PEAKED, families

    known = families(depth)
    if table.spectrum not in known:
        raise StudyError(f"{where}.spectrum is {table.spectrum!r}; allowed: {', '.join(known)}")
    if table.gamma is not None and table.spectrum not in PEAKED:
        raise StudyError(f"{where}.gamma is given for {table.spectrum}; allowed: with {', '.join(PEAKED)}")
    return known[table.spectrum]


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
