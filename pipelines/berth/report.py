"""What is printed, drawn and written of a berthing."""

from __future__ import annotations

import math

import numpy as np

from hakobune.mooring.berthing.field import compared, contacts
from hakobune.mooring.berthing.two_springs import TwoSprings
from hakobune.mooring.criteria.failing import fails

from ..common.fender_tables import (
    BATCH,
    beyond_batch,
    causes_of,
    fender_of,
    on_dolphin,
    own_strain,
    softest_and_stiffest,
)
from ..common.units import TONF

KILO = 1e3
MARK = "# course of a berthing"
BUCKLING = ("cell", "v", "h", "cone")  # families with a plateau
LINEAR_TO = 0.15  # strain up to which Ueda (1981) takes a fender as a spring


def show(study, approach, fender, bands):
    """Print ship, energies by each method, and what the fender that is met first does with them."""
    from rich.table import Table

    from ..printing.console import new_console

    console, ship = new_console(), approach.ship
    print(
        f"{ship.mass / KILO:.0f} t, C_B {ship.block:.3f}; {approach.speed:.3g} m/s, contact {approach.offset:.1f} m "
        f"from the centre of gravity: C_e {approach.eccentricity:.3f}"
    )
    table = Table(
        title=f"{fender.name}: rated {fender.rated_energy / KILO:.0f} kJ, {fender.rated_reaction / KILO:.0f} kN"
    )
    behind = on_dolphin(fender)
    columns = ("virtual mass", "C_M", "energy kJ", "tonf m", "fender %", *(["dolphin m"] * behind), "reaction kN")
    for name in columns:
        table.add_column(name, justify="left" if name == "virtual mass" else "right", no_wrap=True)
    for method, (mass, energy) in approach.energies.items():
        at = _deflection(fender, energy)
        met = ["beyond", *(["the"] * behind), "table"]
        if at is not None:
            own = fender.own(at)
            met = [f"{100 * own / fender.height:.1f}", *([f"{at - own:.3f}"] * behind)]
            met.append(f"{fender.largest_reaction(at) / KILO:.0f}")
        table.add_row(method, f"{mass:.3f}", f"{energy / KILO:.1f}", f"{energy / TONF:.1f}", *met)
    console.print(table)
    for line in _verdict(study, approach, fender, bands):
        print(line)
    line = _two_springs(study.fender[approach.first], approach, fender)
    if line:
        print(line)


def _deflection(fender, energy):
    if fender.overload is None and energy > fender.energy(fender.limit):
        return None
    return fender.deflection_at_energy(energy)


def _verdict(study, approach, fender, bands):
    energy, (soft, stiff), (low, high) = approach.energy, *_batch(study.fender[approach.first])
    enough = "NOT enough" if any(_too_much(study, approach)) else "enough"
    yield (
        f"C_M {approach.virtual_mass:.3f}, {energy / KILO:.0f} kJ: {100 * energy / fender.rated_energy:.0f} % of the "
        f"rated energy, {100 * energy / soft.rated_energy:.0f} % of that at {low:g} of the reaction, {enough}"
    )
    at = _deflection(stiff, energy)
    if at is not None:
        yield f"at {high:g} of the reaction it pushes with {stiff.largest_reaction(at) / KILO:.0f} kN"
    words = []
    for name, one in zip(("softest", "stiffest"), bands, strict=True):
        at = _deflection(one, energy)
        words.append(
            f"the {name} does not take it up" if at is None else
            f"the {name} at {own_strain(one, at)} with {one.largest_reaction(at) / KILO:.0f} kN"
        )  # fmt: skip
    yield f"by {', '.join(causes_of(study.fender[approach.first]))}: {'; '.join(words)}"


def _batch(table):
    return softest_and_stiffest(table, fender_of(table), BATCH)


def _too_much(study, approach):
    """What fails of the fender that is met first, by the kinetic-energy method, as Ueda (1981) judges, section 6"""
    table = study.fender[approach.first]
    yield from beyond_batch("energy of the berthing", approach.energy, table, fender_of(table))


def failures(study, approach, course):
    """What fails of fenders and dolphins: by the kinetic-energy method, and in the course in time, None without one"""
    found = list(_too_much(study, approach))
    yield from found
    table, (_, stiff), (_, high) = study.fender[approach.first], *_batch(study.fender[approach.first])
    at = _deflection(stiff, approach.energy)
    if table.dolphin_yield is not None and at is not None:
        reaction = stiff.largest_reaction(at) / KILO
        if reaction > table.dolphin_yield:
            yield fails(
                f"at {high:g} of its reaction the fender pushes the dolphin with {reaction:.4g} kN, which yields at "
                f"{table.dolphin_yield:.4g} kN; give a softer fender or a stronger dolphin"
            )
    given = study.approach
    factors = given.softness * given.configuration * given.abnormal  # that the course in time knows nothing of
    for k, (fender, x, _) in enumerate(approach.meetings if course is not None else ()):
        if not (found and k == approach.first):
            taken = factors * float(fender.energy(course.deflection[:, k].max()))
            table = study.fender[k]
            yield from beyond_batch(f"energy in time of the fender at x = {x:g} m", taken, table, fender_of(table))


def _two_springs(table, approach, fender):
    """Ueda's closed form, for a buckling fender: a spring up to LINEAR_TO, then its rated reaction"""
    if table.family not in BUCKLING:
        return None
    mass = approach.eccentricity * approach.virtual_mass * approach.ship.mass
    plateau = fender.rated_reaction
    dolphin = math.inf if table.dolphin is None else KILO * table.dolphin
    made = TwoSprings(mass, approach.speed, dolphin, plateau / (LINEAR_TO * table.height), plateau)
    y1, y2 = (float(y) for y in made.deflections(made.rest_time))
    behind = "" if table.dolphin is None else f", dolphin {y1:.3f} m"
    return (
        f"Ueda's two springs: {made.energy / KILO:.1f} kJ, {made.reaction / KILO:.0f} kN, fender {y2:.3f} m{behind}, "
        f"rest after {made.rest_time:.2f} s"
    )


def show_course(approach, course, database):
    """Print what the course in time came to."""
    water = f"the memory of {database}" if database else f"constant virtual mass, C_M {approach.virtual_mass:.3f}"
    peak = course.reaction.max(axis=0)
    when = course.time[course.reaction.sum(axis=1).argmax()]
    print(
        f"in time, {water}: {course.energy / KILO:.1f} kJ into the fenders, C_M {course.virtual_mass:.3f}; largest "
        f"force {course.reaction.sum(axis=1).max() / KILO:.0f} kN at {when:.2f} s; "
        f"{course.lost[-1] / KILO:.1f} kJ into waves; energy closes to {course.ledger:.0e}"
    )
    if len(peak) > 1:
        for k, (fender, x, _) in enumerate(approach.meetings):
            deep = course.deflection[:, k].max()
            print(f"  {fender.name} at x = {x:g} m: {deep:.3f} m ({own_strain(fender, deep)}), {peak[k] / KILO:.0f} kN")


def write_course(path, course):
    """CSV of the course in time, written whole"""
    from hakobune.meshing.whole_files import write_whole

    k = course.reaction.shape[1]
    names = ["t", "sway", "yaw", "sway_velocity", "yaw_velocity"]
    names += [f"deflection_{i + 1}" for i in range(k)] + [f"reaction_{i + 1}" for i in range(k)]
    names += ["energy_fenders", "energy_waves"]
    columns = [course.time, *course.position.T, *course.velocity.T, *course.deflection.T, *course.reaction.T]
    rows = np.stack([*columns, course.taken, course.lost], axis=1)
    lines = [MARK, "# s, m, rad, N, J; sway towards the berth", ",".join(names)]
    lines += [",".join(f"{value:.8g}" for value in row) for row in rows]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def draw(approach, course, path):
    """Forces and deflections of the fenders, energies, over time"""
    from matplotlib.figure import Figure

    from ..common.picture import save

    figure = Figure(figsize=(8.0, 8.0), layout="constrained")
    force, deep, energy = figure.subplots(3, sharex=True)
    for k, (fender, x, _) in enumerate(approach.meetings):
        label = f"{fender.name}, x = {x:g} m"
        force.plot(course.time, course.reaction[:, k] / KILO, label=label)
        deep.plot(course.time, course.deflection[:, k], label=label)
    energy.plot(course.time, course.taken / KILO, label="in fenders and lost in them")
    energy.plot(course.time, course.lost / KILO, label="in waves")
    energy.axhline(approach.energy / KILO, linewidth=0.8, linestyle=":", color="grey", label="kinetic-energy method")
    force.set(ylabel="reaction, kN", title=f"C_M {course.virtual_mass:.3f}")
    deep.set(ylabel="deflection, m")
    energy.set(ylabel="energy, kJ", xlabel="time from contact, s")
    force.legend(fontsize=8)
    energy.legend(fontsize=8, loc="center right")
    save(figure, path, 110)


def measured_lines():
    """Ratios of absorbed to effective energy of the fifty berthings"""
    table = contacts()
    lines = [f"{len({c.ship for c in table})} ships, {len(table)} contacts (Ueda 1981, tables 2.1 to 2.5)"]
    for method in ("older", "Ueda 1981"):
        c = compared(method, table)
        lines.append(
            f"absorbed over effective energy, C_M {method}: median {c.median:.2f}, quartiles {c.low:.2f} and "
            f"{c.high:.2f}, {c.contacts} contacts; {100 * c.bounded:.0f} % within what speeds cut to whole cm/s allow"
        )
    return lines
