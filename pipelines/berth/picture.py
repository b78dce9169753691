"""Picture of a berthing in time: forces and deflections of the fenders, energies."""

from ..common.picture import save
from ..common.units import KN


def draw(approach, course, path):
    """approach : `study.Approach`; course : `mooring.berthing.memory.Berthing`"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 8.0), layout="constrained")
    force, deep, energy = figure.subplots(3, sharex=True)
    for k, (fender, x, _) in enumerate(approach.meetings):
        label = f"{fender.name}, x = {x:g} m"
        force.plot(course.time, course.reaction[:, k] / KN, label=label)
        deep.plot(course.time, course.deflection[:, k], label=label)
    energy.plot(course.time, course.taken / KN, label="stored and dissipated in fenders")
    energy.plot(course.time, course.lost / KN, label="in waves")
    energy.axhline(approach.energy / KN, linewidth=0.8, linestyle=":", color="grey", label="kinetic-energy method")
    force.set(ylabel="reaction, kN", title=f"C_M {course.virtual_mass:.3f}")
    deep.set(ylabel="deflection, m")
    energy.set(ylabel="energy, kJ", xlabel="time from contact, s")
    force.legend(fontsize=8)
    energy.legend(fontsize=8, loc="center right")
    save(figure, path, 110)
