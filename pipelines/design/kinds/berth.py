"""Results in time at a berth: strain, energy and reaction of fenders in addition to tensions of ropes and lines.

strain, total    largest of all runs, over the height; on a dolphin, of the fender without the dolphin strain, steady
largest mean of ten minutes in the kept records (the report's limit is of "periods of 10 min and
                 longer", SR179 1982, chapter 4, 3.2.5)
"""

import numpy as np

from hakobune.mooring.fenders.fender import FenderError

from .in_time import at_place, make_study_of
from .needs import DOLPHIN, OF_ALLOWABLE, OF_ENERGY, OF_REACTION, REACTION, SLOW, TOTAL
from .numbers import Numbers, types_of

STEADY = 600.0  # s
PLANE = ("surge", "sway", "yaw")


def berth_numbers(study, database, path, runs):
    """`Numbers` of a load case, from the file of its runs; runs : as `in_time.simulated` gives them"""
    from hakobune.bem.database import open_database
    from hakobune.mooring.motion.contacts import contact_forces

    from ...simulate.berth import findings_on_fenders, findings_on_periods
    from ...simulate.file import bodies_of, opened

    db, made = open_database(database), make_study_of(path.with_name(path.name.replace("_runs.h5", ".toml")))
    hull = made.hulls_of(db)
    berth = made.berth_of(db, hull)
    with opened(path) as file:
        names = tuple(file["line"].asstr()[()])
        anchor, fairlead = file["anchor"][()], file["fairlead"][()]
        start, place = file.attrs["place_at_rest"], _mean_place(file)
        parts, bodies = _of_fenders(file, made, berth) | runs["parts"], bodies_of(file)
        warnings = (*runs["findings"], *_periods(file), *_steady_of_few(file), *findings_on_periods(file),
                    *findings_on_fenders(file),
                    *filter(None, [str(file.attrs.get("design_spectrum", ""))]))  # fmt: skip
    at_rest = contact_forces(berth, start)[len(berth.fenders) :]
    held = _at_rest(made, db, hull, start)
    length = [*(one.length for one in held.system.lines)] if held is not None else []
    return Numbers(
        names=names,
        types=(*(types_of(table) for table in study["lines"]), *(("rope",) for _ in berth.ropes)),
        fairlead=fairlead,
        anchor=anchor,
        length=np.array([*length, *(one.length for one in berth.ropes)]),
        pretension=np.array([*(held.lines.tension_b if held is not None else ()), *at_rest]),
        static=runs["mean"],
        largest=runs["largest"][1.0],
        breaking=runs["breaking"],
        horizontal=runs["horizontal"],
        uplift=runs["uplift"],
        place=place,
        motions=runs["motions"],
        parts=parts,
        warnings=tuple(dict.fromkeys(warnings)),
        bodies=bodies,
    )


def _periods(file):
    """Remark on the natural periods at a berth, which are known for one body"""
    if "natural_period" not in file.attrs:
        return
    known = [(n, T) for n, T in zip(PLANE, file.attrs["natural_period"], strict=True) if np.isfinite(T)]
    words = ", ".join(f"{name} {T:.3g} s" for name, T in known)
    yield f"natural periods of small motions at the berth: {words or 'none, since nothing holds the body at rest'}"


def _steady_of_few(file):
    """Remark that steady strains are those of the kept records, if other runs exist"""
    kept, runs = len(file["deflection"]), len(file["seed"])
    if kept < runs:
        yield (
            f"steady strains come from {kept} of {runs} runs, those with stored records; other runs may have "
            f"larger strains; give simulation.keep_series = {runs}"
        )


def _at_rest(made, db, hull, start):
    """SystemEquilibrium of the lines with the bodies at rest at the berth, None without lines

    start : (6N,) displacements in space
    """
    system = made.system_of(db, hull)
    if system is None:
        return None
    return at_place(system, np.array([one.position for one in system.bodies]) + np.reshape(start, (-1, 6)))


def _mean_place(file):
    """Mean of surge, sway and yaw over all runs, m, m, rad; shape (3,); of several bodies (N, 3)"""
    from ...simulate.file import bodies_of, summary_of

    of_each = [
        [summary_of(file, f"{body} {name}".strip())["mean"] for name in PLANE] for body in bodies_of(file) or [""]
    ]
    return np.array(of_each if bodies_of(file) else of_each[0])


def _of_fenders(file, made, berth):
    """{quantity: {fender: value}} of all fenders"""
    from ...common.fender_tables import fender_of
    from ...simulate.file import summary_of

    step = float(np.diff(file["time"][:2])[0])
    dolphins = {one.name: one for one in made.dolphin}
    out = {REACTION: {}, OF_REACTION: {}, TOTAL: {}, SLOW: {}, OF_ALLOWABLE: {}, OF_ENERGY: {}, DOLPHIN: {}}
    for i, (table, one) in enumerate(zip(made.fender, berth.fenders, strict=True)):
        largest = max(float(summary_of(file, f"deflection {one.name}")["largest"]), 0.0)
        steady = _longest_mean(file["deflection"][()][..., i].astype(float), step)
        fender, yields = fender_of(table), dolphin_of(table, dolphins)
        alone = [one.fender.own(y) for y in (largest, steady)]
        out[TOTAL][one.name], out[SLOW][one.name] = (y / fender.height for y in alone)
        out[OF_ALLOWABLE][one.name] = alone[0] / (fender.height * fender.allowable)
        try:
            out[OF_ENERGY][one.name] = float(fender.energy(alone[0])) / fender.rated_energy
            reaction = one.fender.largest_reaction(largest)
        except FenderError:  # deflection beyond the table
            out[OF_ENERGY][one.name], reaction = np.inf, np.inf
        out[REACTION][one.name], out[OF_REACTION][one.name] = reaction / 1e3, reaction / fender.rated_reaction
        if yields and np.isfinite(yields[1]) and reaction > 0:
            out[DOLPHIN][one.name] = yields[1] / reaction
    return {quantity: values for quantity, values in out.items() if values}


def dolphin_of(table, dolphins):
    """Stiffness, yield force, and stiffness beyond yield of the dolphin in a fender's table, SI; () without a
    dolphin"""
    if getattr(table, "on", None) is not None:
        one = dolphins[table.on]
        values = one.stiffness, one.yield_force, one.stiffness_beyond
    else:
        values = table.dolphin, table.dolphin_yield, table.dolphin_beyond
    if values[0] is None:
        return ()
    stiffness, force, beyond = (None if value is None else 1e3 * value for value in values)
    return stiffness, np.inf if force is None else force, beyond


def _longest_mean(records, step):
    """Largest mean of STEADY s, or of the whole record where it is shorter, of records (runs, t)"""
    width = min(round(STEADY / step), records.shape[1])
    sums = np.cumsum(np.pad(records, ((0, 0), (1, 0))), axis=1)
    return float(((sums[:, width:] - sums[:, :-width]) / width).max())
