"""Results for a ship at a berth: natural periods of the ship and of the harbour, fenders, windows of a record."""

import json
from functools import partial

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.fenders.dolphin import led_on
from hakobune.mooring.motion.statistics import FEWEST_IN_WINDOW, PLANE

from ..printing.number import fixed
from .file import fender_names, summary_of

NEAR = 0.2  # relative distance within which a natural period is near that of a harbour


def findings_on_periods(file):
    """Resonances: natural periods at the berth near the natural periods of the harbour"""
    harbour = np.asarray(file.attrs.get("harbour_period", []), float)
    for name, T in zip(PLANE, file.attrs.get("natural_period", ()), strict=False):
        for own in harbour:
            if abs(T / own - 1) <= NEAR:
                yield (
                    f"the natural period of {name} at the berth, {T:.3g} s, is near the natural period of the "
                    f"harbour, {own:g} s, so the two resonate; change the pretension or stiffness of the ropes "
                    f"until the two periods are {100 * NEAR:g} % apart"
                )


def fender_strains(file):
    """Largest strain of each fender, without the deflection of a dolphin behind it, and the allowable strain; None for
    a file without fender heights
    """
    if "fender_strains" not in file.attrs:
        return None
    height, allowable = (np.asarray(file.attrs[f"fender_{name}"], float) for name in ("height", "allowable"))
    pressed = [summary_of(file, f"deflection {name}")["largest"] for name in fender_names(file)]
    knots = json.loads(file.attrs["fender_strains"])
    share = [led_on(y / h, *map(np.array, one)) for y, h, one in zip(pressed, height, knots, strict=True)]
    return np.array(share), allowable


def most_pressed(file):
    """The fender nearest to its allowable strain in all runs, as a note; nothing without fenders"""
    share, allowable = fender_strains(file) or ((), ())
    if len(share):
        worst = int(np.argmax(share / allowable))
        name, own, most = fender_names(file)[worst], 100 * share[worst], 100 * allowable[worst]
        yield f"largest compression of a fender: {own:.3g} % of the height of {name} (allowable {most:.4g} %)"


def findings_on_fenders(file):
    """Failures: fenders beyond their allowable strain"""
    for name, share, allowable in zip(fender_names(file), *(fender_strains(file) or ((), ())), strict=False):
        if share > allowable:
            yield fails(
                f"{name} is compressed by {100 * share:.4g} % of its height; allowed: {100 * allowable:.4g} %; "
                "choose a larger fender or more fenders"
            )


def by_design_spectrum(study, db, body, hull, fenders):
    """A line by the design spectrum method for fenders that alone hold a body; "" without a result, or with ropes or
    lines.

    study : `Study`; body : `Reader`, in front of a quay where there is one
    fenders : sequence of `QuayFender`; only those that the steady lateral loads press count
    """
    from hakobune.mooring.dolphins.at_quay import at_quay
    from hakobune.mooring.dolphins.design_spectrum import STATIC, TOTAL, DolphinError
    from hakobune.mooring.studies.steady_loads import steady_loads, with_coefficients

    from ..common.weather.seas import family_of, shape_of

    conditions = study.conditions()
    if study.rope or study.lines or study.spreads or study.simulation.record or conditions.sea is None:
        return ""
    if study.waves.swell or study.waves.file is not None:  # the limit is that of a height of one system
        return ""
    steady = with_coefficients(conditions, hull, study.water.depth)
    across = sum(load[1] for load in steady_loads(db, hull, steady, study.water.depth).values())
    family = partial(family_of("waves", study.waves, study.water.depth), **shape_of(study.waves))
    try:
        found = at_quay(body, fenders, across, conditions, family)
    except DolphinError as error:
        return f"design spectrum method: {error}"
    if found is None:
        return ""
    s = found.strains
    return (
        f"design spectrum method, {found.count} fenders: static {s.static:.3g} m ({100 * s.static_strain:.3g} %), "
        f"σ {s.sigma:.3g} m, largest {s.largest:.3g} m ({100 * s.strain:.3g} %); allowed: {100 * STATIC:g} and "
        f"{100 * TOTAL:g} %, up to a significant height of {fixed(found.limit)} m"
    )


def check_harbour(periods):
    """The periods.  Raises StudyError."""
    from ..common.quantities import positive

    return [positive(f"harbour.periods[{i}]", T) for i, T in enumerate(periods)]


def check_windows(length, plan, bodies=()):
    """Raise StudyError for windows of `length` s that are longer than the records of a `study.Plan`"""
    from ..common.quantities import StudyError

    if bodies:
        raise StudyError("--windows is given, and the database contains several bodies; --windows is for one body only")
    step, duration = plan.settings.step, plan.settings.duration
    if not FEWEST_IN_WINDOW * step <= length <= duration:
        raise StudyError(
            f"--windows is {length:g} s; allowed: {FEWEST_IN_WINDOW * step:g} s to the duration, {duration:g} s"
        )
    if plan.keep_series < 1:
        raise StudyError("--windows is given, and no record is stored; it needs keep_series of 1 or more")
