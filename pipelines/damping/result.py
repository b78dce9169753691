"""`hakobune.damping`: linear and quadratic damping from a record of a forced oscillation or of a free decay."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from hakobune.bem.database.natural_periods import GIVE_GYRATION
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.identification.coupled import coupled
from hakobune.mooring.identification.decay import decay
from hakobune.mooring.identification.forced import forced

from ..printing.number import significant
from ..results.given import File, database_of
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels

if TYPE_CHECKING:
    from hakobune.bem.database import Database

ANGLES = {"deg": 1.0, "degrees": 1.0, "°": 1.0, "rad": 180 / np.pi}  # units of a column, in degrees
LEFT = 0.25  # largest part of a record that a fit may leave unexplained
ANOTHER = 2.0  # ratio of a given mass and that of the database, above which the unit or the body is another
NEAR = 0.1  # relative difference of masses and periods below which nothing is said
COLUMNS = ("time_s", "motion_m", "force_kN", "motion_deg", "moment_kNm")
TURNED = {
    "m": "rad",
    "kg": "kg m2",
    "N s/m": "N m s",
    "N s2/m2": "N m s2",
    "N s3/m3": "N m s3",
    "s/m2": "s",
    "1/m": "1/rad",
    "N": "N m",
}  # units


def damping(
    record: File | dict[str, np.ndarray | Sequence[float]],
    *,
    mass: float | None = None,
    database: File | Database | None = None,
    motion: str | None = None,
) -> Result:
    """Linear and quadratic damping of a body from a record of its motion: forced oscillation, or free decay.

    record : path of a CSV file, or {column: values}, with the columns time_s and motion_m, for a rotation motion_deg.
    A forced oscillation also has force_kN of the water, for a rotation moment_kNm.
    A decay may have other column names with units, such as "t (s), roll (deg)"
    mass : mass with added mass of a free decay, kg, of a rotation kg m²; compared with the database where there is one
    database : path of the body's database, or None. Its radiation damping is subtracted from B1 in the keys.
    For a forced oscillation this is the radiation damping of the recorded motion alone.
    For a decay it is the radiation damping of the recorded motion coupled with all other free motions.
    The mass of a decay is then the mass of the database
    motion : name of the recorded motion, "roll"; with several bodies "barge roll"; needed with a database
    returns : Result, in SI
    raises : ValueError, with a message of one line
    """
    if mass is not None and not 0 < mass < np.inf:
        raise ValueError(f"mass is {mass:g} kg; allowed: above 0, finite")
    columns = record if isinstance(record, dict) else read_record(record)
    turned = "motion_deg" in columns
    names = ("motion_deg", "moment_kNm") if turned else ("motion_m", "force_kN")
    try:
        _check_columns(columns, names)
        time, moved, *force = (np.asarray(columns[name], float) for name in ("time_s", *names) if name in columns)
        if force and mass is not None:
            raise ValueError(f"mass is given and the record has {names[1]}; mass is needed for a decay only")
        moved = np.radians(moved) if turned else moved
        body = None if database is None else database_of(database).bodies_reader
        given = None if body is None else (body, _mode(body, motion, turned))
        found, findings, notes = (
            _forced(time, moved, 1e3 * force[0], given)
            if force
            else _decay(time, moved, mass, "rad" if turned else "m", given)
        )
    except ValueError as error:
        raise ValueError(str(error) if isinstance(record, dict) else f"{record}: {error}") from None
    if turned:
        found = {name: replace(one, unit=TURNED.get(str(one.unit), one.unit)) for name, one in found.items()}
    notes += _to_paste(found, motion or ("roll" if turned else "heave"))
    source = {} if isinstance(record, dict) else {"record": str(record)}
    return Result("damping", found, labels("time", time, "s"), findings, notes, provenance=provenance(**source))


def read_record(path: File) -> dict[str, np.ndarray]:
    """{column: (n,) array} of a CSV.  Raises ValueError."""
    from hakobune.mooring.environment.logger_files import read_table
    from hakobune.mooring.environment.tables import check_even, without_rounding
    from hakobune.mooring.identification.record import UNEVEN

    names, values, lines = read_table(path)
    if (decay := _decay_by_units(path, names, values)) is not None:
        names, values = decay
    wrong = [name for name in names or () if name not in COLUMNS]
    if names is None or wrong or "time_s" not in names or not {"motion_m", "motion_deg"} & set(names):
        shown = "no column names in its first row" if names is None else f"the columns {', '.join(names)}"
        raise ValueError(
            f"{path} has {shown}; allowed: the columns time_s, motion_m, and force_kN of a forced motion, "
            "or motion_deg and moment_kNm; rename them"
        )
    columns = dict(zip(names, values.T, strict=True))
    columns["time_s"] = without_rounding(columns["time_s"])
    check_even(path, columns["time_s"], UNEVEN, lines)
    return columns


def _decay_by_units(path, names, values):
    """Names and values (n, 2) of a table of time and one motion that say their units, "t (s), roll (deg)"; else None"""
    from hakobune.mooring.environment.tables import UNITS, unit_of

    if names is None or len(names) != 2 or not names[0].lower().startswith("t"):
        return None
    clock, unit = (re.search(r"[(\[_ ]\s*([A-Za-z°]+)\s*[)\]]?\s*$", name) for name in names)
    if clock is None or clock[1] not in UNITS["time"] or unit is None:
        return None
    if unit[1] in ANGLES:
        name, size = "motion_deg", ANGLES[unit[1]]
    elif unit[1] in UNITS["length"]:
        name, size = "motion_m", unit_of(path, names[1], "length")
    else:
        return None
    return ["time_s", name], values * [unit_of(path, names[0], "time"), size]


def _check_columns(columns, names):
    """Raises ValueError for columns that are no record of the motion and force (moment) in `names`"""
    strange = [name for name in columns if name not in ("time_s", *names)]
    if strange or names[0] not in columns:
        raise ValueError(
            f"the columns are {', '.join(columns)}; allowed: time_s, motion_m and force_kN, or time_s, motion_deg and "
            "moment_kNm"
        )


def _mode(body, motion, turned):
    """Index of the recorded motion of a `Reader`.  Raises ValueError for a motion that it does not have."""
    allowed = [word for word, turns in zip(body.words, body.turning, strict=True) if turns == turned]
    if motion not in allowed:
        given = "missing" if motion is None else repr(motion)
        raise ValueError(f"motion is {given}; allowed with a database and this record: {', '.join(allowed)}")
    return list(body.words).index(motion)


def _of_waves(waves, rest, what):
    rows = {
        "B1.waves": (waves, "N s/m", f"radiation damping of {what} in the database, at this period"),
        "B1.rest": (max(0.0, rest), "N s/m", "B1 less radiation damping"),
    }
    return quantities("damping without waves", rows)


def _of_database(made, mass, body, mode):
    """`Coupled` of a `Decay`, and notes on its mass and period.  Raises ValueError for another body's mass."""
    motion = body.words[mode]
    if body.inertia is None or body.stiffness is None:
        raise ValueError(f"the database has no inertia of the body; {GIVE_GYRATION}")
    water = coupled(body, mode, made.omega, made.linear)
    unit, notes = "t m²" if body.turning[mode] else "t", []
    if body.viscous and body.names[mode] in body.viscous.laws:
        notes.append(
            f"the scene of the database already has [viscous] {motion}, and a study adds it to these keys; "
            "keep only one of the two"
        )
    if mass is not None and not 1 / ANOTHER < mass / water.mass < ANOTHER:
        thousand = " (kg given as t?)" if 300 < mass / water.mass < 3000 else ""
        raise ValueError(
            f"mass is {significant(mass / 1e3)} {unit}{thousand}; {motion} of this database has "
            f"{significant(water.mass / 1e3)} {unit} with added mass, allowed: {1 / ANOTHER:g} to {ANOTHER:g} times "
            "this; leave the mass out to use the mass of the database"
        )
    if mass is not None and abs(mass / water.mass - 1) > NEAR:
        notes.append(
            f"the given mass is {significant(mass / 1e3)} {unit}, but {motion} in the database has "
            f"{significant(water.mass / 1e3)} {unit}; the limit of the difference is {100 * NEAR:g} %; B1 and "
            "B2 are computed with the mass of the database, which a study uses too"
        )
    if abs(made.omega / water.natural - 1) > NEAR:
        notes.append(
            f"{motion} of the free body in the database has a period of about "
            f"{significant(2 * np.pi / water.natural)} s, but the record has one of "
            f"{significant(2 * np.pi / made.omega)} s; the limit of the difference is {100 * NEAR:g} %; the "
            "damping is given at the period of the record: check centre of gravity, gyration, and the scale "
            "of the record, unless lines held the body"
        )
    return water, notes


def _to_paste(found, motion):
    """Lines with the damping in the form of a study and a scene, () if unknown; the user names the motion"""
    if "B1" not in found:
        return ()
    B1, B2 = (float(found[name].values) for name in ("B1", "B2"))
    if "B1.rest" not in found:
        which = f"{motion} or whichever motion was recorded"
        said = "B1 contains the damping by the waves that the body makes, which a study takes from its database too: "
        said += "give --database and --motion to subtract it, else the study counts it twice"
    else:
        B1, waves, which = float(found["B1.rest"].values), float(found["B1.waves"].values), motion
        said = f"linear_damping is B1 less the radiation damping of the database, {waves / 1e3:.4g}, which a study adds"
        if B1 == 0.0:
            said += "; the waves alone damp more than the record, so that 0 is left: check the water's depth"
    return (
        f"as keys, for {which}: [simulation] linear_damping = "
        f"{{ {motion} = {B1 / 1e3:.4g} }}, quadratic_damping = {{ {motion} = {B2 / 1e3:.4g} }}; in a scene "
        f"[viscous] {motion} = {{ drag = {B2:.4g} }}",
        said,
    )


def _forced(time, motion, force, given):
    """given : (`Reader`, index of the motion), or None"""
    made = forced(time, motion, force)
    by_paper, error = made.by_harmonics, made.error
    found = quantities("forced oscillation", {
        "amplitude": (made.motion.amplitude, "m", "amplitude"),
        "period": (2 * np.pi / made.motion.omega, "s", "period"),
        "added_mass": (made.added_mass, "kg", "added mass"),
        "B1": (made.linear, "N s/m", "B1"),
        "B1.by_harmonics": (by_paper[0], "N s/m", "B1 by harmonics"),
        "B1.error": (error[0], "N s/m", "standard error of B1"),
        "B2": (made.quadratic, "N s2/m2", "B2"),
        "B2.by_harmonics": (by_paper[1], "N s2/m2", "B2 by harmonics"),
        "B2.error": (error[1], "N s2/m2", "standard error of B2"),
        "linear.same_energy": (made.same_energy, "N s/m", "equivalent linear damping by energy"),
        "linear.same_force": (made.same_force, "N s/m", "equivalent linear damping by largest force"),
        "left": (made.off, "%", "force not explained"),
        "cubic.B1": (float(made.with_cubic[0]), "N s/m", "B1 beside a cube"),
        "cubic.B3": (float(made.with_cubic[1]), "N s3/m3", "B3"),
        "cubic.left": (made.with_cubic[2], "%", "force not explained even with a cubic term"),
    })  # fmt: skip
    findings = [*_rest(made.off, "force", "a sine that moves a body with added mass and damping")]
    if made.same_energy < 0:
        findings.append(
            fails(
                f"the equivalent damping by energy is negative, {significant(made.same_energy / 1e3)} kN s/m, "
                "limit 0: the record needs the force that moves the body; the reaction of the water has the opposite "
                "sign"
            )
        )
    records = {
        "record.force": (force - force.mean(), "N", "reaction"),
        "fitted.force": (made.fitted(time), "N", "reaction"),
    }
    if given:
        body, mode = given
        waves = float(body.coefficients(made.motion.omega)[1][0, mode, mode])
        found |= _of_waves(waves, made.linear - waves, f"{body.words[mode]} alone")
    return found | quantities("", records, "time", record=True), tuple(findings), ()


def _decay(time, motion, mass, unit, given):
    """given : (`Reader`, index of the motion), or None"""
    made = decay(time, motion)
    water, notes = (None, []) if given is None else _of_database(made, mass, *given)
    mass = water.mass if water else mass
    rows = {
        "period": (2 * np.pi / made.omega, "s", "natural period"),
        "a": (made.a, "", "a by half cycles"),
        "b": (made.b, "1/m", "b by half cycles"),
        "a.alone": (made.linear_only, "", "a of a fit to half cycles with b = 0"),
        "B1_over_M": (made.linear, "1/s", "B1/M"),
        "B2_over_M": (made.quadratic, "1/m", "B2/M"),
        "critical": (made.linear / (2 * made.omega), "%", "B1 over critical damping"),
    }
    if mass is not None:
        rows |= {
            "B1": (made.linear * mass, "N s/m", "B1"),
            "B2": (made.quadratic * mass, "N s2/m2", "B2"),
        }
    rows |= {
        "left": (made.off, "%", "motion not explained"),
        "cubic.B1_over_M": (made.with_cubic[0], "1/s", "B1/M with a cubic term"),
        "cubic.B3_over_M": (made.with_cubic[1], "s/m2", "B3/M"),
        "cubic.left": (made.with_cubic[2], "%", "motion not explained even with a cubic term"),
    }
    found = quantities("free decay", rows)
    if water and given is not None:
        body, mode = given
        mass_row = {"mass": (mass, "kg", f"M, mass with added mass of {body.words[mode]} in the database")}
        waves = _of_waves(water.waves, water.rest, f"{body.words[mode]} with the other motions free")
        found |= quantities("free decay", mass_row) | waves
    records = {"record.motion": (motion, "m", "motion"), "fitted.motion": (made.fitted, "m", "motion")}
    found |= quantities("", records, "time", record=True)
    note = f"{len(made.extremes)} extremes from {significant(made.extremes[0])} {unit}; M with added mass"
    return found, tuple(_rest(made.off, "motion", "the free decay of one motion")), (note, *notes)


def _rest(off, what, kind):
    """Failure of a fit with a residual that is too large"""
    if off > LEFT:
        yield fails(
            f"{100 * off:.3g} % of the {what} is not explained, limit {100 * LEFT:g} %; this is not a record of "
            f"{kind}; check it with --plot"
        )
