"""Natural periods of a body on its mooring, and at a berth."""

import numpy as np

from hakobune.bem.database.natural_periods import natural_periods
from hakobune.bem.database.resonances import by_motion, natural_modes

from ..lines.system.equilibrium import SystemEquilibrium
from .system_at_rest import about_body_axes, body_number, mooring_stiffness


def moored_periods(state: SystemEquilibrium, body, db):
    """NaturalPeriods of one body of the system, with hydrodynamics from an open database of this body.

    The axes of the body are those of the database; the stiffness is converted to these axes and to its rotation centre.
    raises : ValueError where the database lacks added mass, inertia or hydrostatics
    """
    i = body_number(state.system, body)
    pull = state.system.load(state.pose).force[6 * i : 6 * i + 3]
    K = about_body_axes(mooring_stiffness(state, body), pull, state.pose.turn[i], np.asarray(db.rotation_center, float))
    return natural_periods(db.reader.restrained(stiffness=K))


def periods_at_berth(moored):
    """Periods of small coupled motions of surge, sway and yaw about rest, s, each named by its largest part; shape
    (3,).

    nan where there is none.

    moored : `mooring.motion.simulation.Moored`.  Friction of fenders, which prevents small motions, is neglected.
    """
    place = np.ix_((0, 1, 5), (0, 1, 5))
    mass, stiffness = (moored.reader.inertia + moored.slow_added_mass)[place], moored.stiffness[place]
    mass, stiffness = 0.5 * (mass + mass.T), 0.5 * (stiffness + stiffness.T)
    squared, shapes = natural_modes(mass, stiffness)
    squared = squared[by_motion(np.abs(shapes.T * (mass @ shapes).T))]
    return np.where(squared > 0, 2 * np.pi / np.sqrt(np.where(squared > 0, squared, 1.0)), np.nan)
