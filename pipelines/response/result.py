"""`hakobune.response`: a body of a database in a sea or a climate, and its stored results."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from hakobune.bem.database.resonances import resonances
from hakobune.bem.hinges import driven
from hakobune.mooring.response.long_term import YEAR
from hakobune.mooring.response.sea_state import TINY

from ..common.quantities import StudyError
from ..common.quay_tables import linked
from ..common.resonances import resonance_lines, underdamped
from ..results.given import File, Tables, database_of, given
from ..results.heard import heard
from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result, labels
from .effort import check_effort
from .findings import air_gaps, failures, keel_gaps, notes, turned
from .places import places_of
from .solved import FRACTILE, solved_in_climate, solved_in_sea, solved_moored
from .study import ResponseStudy, make_response_study, read_response_study

if TYPE_CHECKING:
    from hakobune.bem.database import Database
    from hakobune.bem.database.reader import Reader
    from hakobune.mooring.response.climate import Climate
    from hakobune.mooring.response.sea_state import SeaState
    from hakobune.mooring.studies.slow_motion import SlowMotion

KIND = "response"
MOTIONS, DRIFT, AIR, KEEL = "responses, amplitudes", "drift of the waves", "air gap", "water under the keel"
ALL = "drift of the waves on all bodies together, about the origin of the scene"
DAMPING, EACH = "wave drift damping", "drift of each body, about its own point in its own axes"
MOORED, PLANE = "moored, mean and slow motion", ("surge", "sway", "yaw")
FORCE, MOVED = ("N", "N", "N m"), ("m", "m", "rad")
FAR_FROM_DEPTH = 0.2  # change of the gap under the keel, over that of the database, above which a message is printed


def response(study: File | Tables | ResponseStudy, database: File | Database, moored: File | None = None) -> Result:
    """Motions, accelerations, air gap and drift of a body in a sea state, or their extremes in a climate.

    study : path of a response study, its tables as a dictionary, or a `ResponseStudy`
    database : path of the body's database, or an open one
    moored : path of a mooring study whose lines, wind and current act on the body; None for a freely floating body
    returns : Result, in SI; its `detail` is a `SeaState` or a `Climate` of `mooring.response`
    raises : ValueError, with a message of one line
    """
    read, text = given(study, ResponseStudy, read_response_study, make_response_study)
    place = Path("study" if isinstance(study, dict | ResponseStudy) else study)  # files lie beside it
    for table, name in ((read.current, "[current]"), (moored, "--moored")):
        if table is not None and read.climate:
            raise StudyError(f"{name} is given with [climate], but it is for [sea] only; leave it out")
    if read.sea:
        check_effort(read)
    db = database_of(database)
    points, body = places_of(read, db), db.bodies_reader.floating()
    if moored is None:
        body = driven(linked(read.restrained(body), read.hinges, db))
    with heard() as caught:
        try:
            solved = _solved(read, body, db, points, place, moored)
        except TypeError as error:
            raise StudyError(f"{study}: {error}") from None
    found, body, years = solved.found, solved.body, read.climate and read.climate.years
    about = body.radius, body.bodies
    quantities, axes = of_sea(found, *about) if read.sea else of_climate(found, years, *about)
    if solved.slow is not None:
        several = [f"{one.name} {motion}" for one in db.bodies if not one.fixed for motion in PLANE]
        axis = "horizontal" if several else "plane"
        quantities |= of_moored(solved.slow, axis)
        axes |= labels("moored_omega", solved.slow.omega, "rad/s")
        axes |= labels(axis, several or PLANE) | labels(f"with_{axis}", several or PLANE)
    peaks = resonances(body)
    warned = (
        *caught,
        *solved.warnings,
        *_of_depth(read, db),
        *resonance_lines([one for one in peaks if underdamped(one)]),
        *solved.failures,
        *failures(found, solved.stiffness, years, body.words),
        *turned(quantities, axes),
    )
    noted = (
        *notes(found, years),
        *resonance_lines([one for one in peaks if not underdamped(one)]),
        *solved.notes,
    )
    return Result(KIND, quantities, axes, tuple(dict.fromkeys(warned)), noted, (), provenance(text, db), found)


class Solved(NamedTuple):
    """found : SeaState or Climate; body : Reader of the moving bodies; stiffness : stiffness of water and lines, (n,
    n), SI;
    warnings, failures, notes : one line each; slow : `SlowMotion` on lines; None without lines
    """

    found: SeaState | Climate
    body: Reader
    stiffness: np.ndarray | None
    warnings: tuple[str, ...]
    failures: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    slow: SlowMotion | None = None


def _solved(read, body, db, points, place, moored):
    if moored is None:
        found, body = (solved_in_sea if read.sea else solved_in_climate)(read, body, db, points, place)
        return Solved(found, body, body.stiffness, found.warnings)
    held = solved_moored(read, db, points, moored)
    motion = held.motion
    return Solved(motion.fast, held.body or body, held.stiffness, motion.warnings, held.failures, held.notes, motion)


def _of_depth(read, db):
    """A message if water level and draft differ much from those of the database"""
    if read.keel is None:
        return []
    gap = db.water_depth + float(db.mesh.whole().points[:, 2].min())
    more = read.keel.tide - read.keel.extra_draft
    if abs(more) <= FAR_FROM_DEPTH * gap:
        return []
    return [
        f"tide and extra draft change the water under the keel by {more:.3g} of {gap:.3g} m, but the motions are "
        "those at the depth of the database; solve the body again at the changed depth"
    ]


def of_sea(found, radius, bodies=()):
    """Quantities of a SeaState and the labels of their axes; radius : radius of the hull, m; bodies : names of the
    bodies where there are several
    """
    excited = np.flatnonzero(~(found.sigma <= 0))  # an unknown value is not zero
    units, axis = tuple(found.units[i] for i in excited), ("response",)
    columns = {
        "sigma": (found.sigma, units, "σ"),
        "significant": (found.significant, units, "highest third"),
        "expected_maximum": (found.expected_maximum, units, f"largest in {found.duration / 3600:.3g} h"),
        "not_exceeded": (found.not_exceeded(FRACTILE), units, f"not exceeded with {100 * FRACTILE:.0f} %"),
        "zero_crossing_period": (found.zero_period, "s", "T zero"),
        "period_between_peaks": (found.peak_period, "s", "T peaks"),
        "bandwidth": (found.bandwidth, "", "ε"),
    }
    made = {
        f"response.{k}": Quantity(v[excited], axis, unit, words, MOTIONS) for k, (v, unit, words) in columns.items()
    }
    made["spectrum"] = Quantity(
        found.spectrum[:, excited], ("omega", "response"), "unit2 s/rad", "spectrum of the response", record=True
    )
    axes = labels("response", [found.names[i] for i in excited]) | labels("omega", found.omega, "rad/s")
    if found.slow is not None:
        made |= _of_slow(found.slow, radius, ALL if bodies else DRIFT)
        axes |= labels("plane", PLANE) | labels("velocity", ("surge", "sway"))
        axes |= labels("difference", found.slow.difference, "rad/s")
        if found.slow.of_each is not None:
            axes |= labels("body", [body.name for body in bodies])
    return _with_gaps(made, axes, found, None)


def of_climate(found, years, radius, bodies=()):
    """Quantities of a Climate and the labels of their axes; years : the return period; radius, bodies : as `of_sea`"""
    excited = np.flatnonzero(found.excited)
    units, terms = tuple(found.units[i] for i in excited), [found.long_term(found.names[i]) for i in excited]
    columns = {
        "once_in_1_year": (YEAR, "once in 1 year"),
        "once_in_return_period": (years * YEAR, f"once in {years:g} years"),
        "not_exceeded": (
            years * YEAR / -np.log(FRACTILE),
            f"not exceeded in {years:g} years with {100 * FRACTILE:.0f} %",
        ),
    }
    made = {
        f"response.{name}": Quantity([term.level(T) for term in terms], ("response",), units, words, MOTIONS)
        for name, (T, words) in columns.items()
    }
    made["return_period"] = Quantity(years, (), "years", "return period")
    for name, value, unit in (
        ("height", found.height, "m"), ("period", found.period, "s"), ("direction", found.direction, "rad"),
        ("probability", found.probability, ""),
    ):  # fmt: skip
        made[f"state.{name}"] = Quantity(value, ("state",), unit, f"{name} of the sea state", record=True)
    for name, unit in (("m0", "unit2"), ("m2", "unit2 rad2/s2")):
        values = getattr(found, name)[:, excited]
        made[f"moment.{name}"] = Quantity(values, ("state", "response"), unit, "moment of its spectrum", record=True)
    axes = labels("response", [found.names[i] for i in excited]) | labels("state", np.arange(len(found.height)))
    if found.mean_drift is not None:
        made["drift.mean"] = Quantity(
            without_rounding(found.mean_drift, radius, found.drift),
            ("plane",),
            FORCE,
            "mean over all time",
            ALL if bodies else DRIFT,
        )
        made["state.drift"] = Quantity(found.drift, ("state", "plane"), "N, N, N m", "mean drift", record=True)
        axes |= labels("plane", PLANE)
    return _with_gaps(made, axes, found, years)


def without_rounding(force, radius, among=None):
    """Fx, Fy and Mz, shape (3,), with zeros for components that are only rounding error.

    A component is compared with the largest force of `among` (n, 3), and with the largest component.

    A moment is compared with a force times the radius in m.
    """
    largest = np.fmax.reduce(np.abs(force if among is None else among)[..., :2], axis=None, initial=0.0)
    return np.where(np.abs(force) <= TINY * largest * np.array([1.0, 1.0, radius]), 0.0, force)


def _of_slow(slow, radius, title):
    made = {
        "drift.mean": Quantity(without_rounding(slow.drift, radius), ("plane",), FORCE, "mean", title),
        "drift.sigma": Quantity(slow.sigma, ("plane",), FORCE, "σ of its beats", title),
        "drift.spectrum": Quantity(
            slow.spectrum,
            ("difference", "plane"),
            "N2 s/rad; of moments N2 m2 s/rad",
            "spectrum of its beats",
            record=True,
        ),
    }
    if slow.of_each is not None:
        for k, (name, unit) in enumerate(zip(PLANE, FORCE, strict=True)):
            made[f"drift.of_each.{name}"] = Quantity(slow.of_each[:, k], ("body",), unit, f"mean, {name}", EACH)
    if slow.by_current is not None:
        made["drift.by_current"] = Quantity(slow.by_current, ("plane",), FORCE, "of the mean by the current", title)
    if slow.of_pairs is not None:
        pairs = slow.sigma_of_pairs[[0, 1, 5]]
        made["drift.sigma_of_pairs"] = Quantity(pairs, ("plane",), FORCE, f'σ, qtf = "{slow.level}"', title)
    if slow.damping is not None:
        made["drift.damping"] = Quantity(
            slow.damping, ("plane", "velocity"), ("N s/m", "N s/m", "N s"), "velocity of", DAMPING
        )
    return made


def _with_gaps(made, axes, found, years):
    """The same with the air gap of points and the water under the keel"""
    for axis, title, gaps, head in (
        ("point", AIR, air_gaps(found, years), "air_gap"), ("keel_point", KEEL, keel_gaps(found, years), "keel")
    ):  # fmt: skip
        if not gaps:
            continue
        columns = [np.array(column, float) for column in zip(*gaps.values(), strict=True)]
        words = ("at rest", "left", "probability" if years is None else "once in years")
        for name, unit, word, values in zip(
            ("at_rest", "left", "reached"), ("m", "m", ""), words, columns, strict=True
        ):
            made[f"{head}.{name}"] = Quantity(values, (axis,), unit, word, title)
        axes |= labels(axis, list(gaps))
    return made, axes


def of_moored(motion, axis="plane"):
    """Quantities of a SlowMotion; axis : name of the axis of the slow motions"""
    moved = MOVED * (len(motion.offset) // 3)
    columns = {
        "offset": (motion.offset, moved, "mean"),
        "natural_period": (motion.period, "s", "natural period"),
        "damping": (motion.ratio, "", "of critical damping"),
        "slow": (motion.slow, moved, "σ slow"),
        "drift_share": (motion.drift_share, "", "of it by drift"),
        "wave": (motion.fast_sigma, moved, "σ of the waves"),
        "flat_spectrum": (motion.estimates[:, 0], moved, "√(πS/2NC)"),
        "beating_force": (motion.estimates[:, 1], moved, "x_s/2ν"),
        "largest": (motion.largest, moved, "largest"),
        "largest_by_rule": (motion.rule, moved, "by rule"),
    }
    share = ("damping", "drift_share")
    made = {
        f"moored.{name}": Quantity(values, (axis,), unit, words, MOORED, name in share)
        for name, (values, unit, words) in columns.items()
    }
    of = "of pairs of motions, slow motion"
    for name, unit in (("force", "N2 s/rad; of moments N m"), ("spectrum", "m2 s/rad, rad for yaw")):
        values, axes = getattr(motion, name), ("moored_omega", axis, f"with_{axis}")
        axes = axes[: np.ndim(values)]
        made[f"moored.{name}"] = Quantity(values, axes, unit, f"{name} {of}", record=True)
    return made
