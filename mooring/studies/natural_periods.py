"""Natural periods of a body on its mooring."""

from __future__ import annotations

import numpy as np

from hakobune.bem.database.natural_periods import natural_periods

from ..lines.system.equilibrium import SystemEquilibrium
from .system_at_rest import about_body_axes, body_number, mooring_stiffness


def moored_periods(state: SystemEquilibrium, body, db):
    """NaturalPeriods of one body of the system, its hydrodynamics from an opened database of the same body.

    The axes of the body are those of the database; the stiffness is taken to them and to its rotation centre.
    raises : ValueError where the database lacks added mass, inertia or hydrostatics
    """
    i = body_number(state.system, body)
    pull = state.system.load(state.pose).force[6 * i : 6 * i + 3]
    K = about_body_axes(mooring_stiffness(state, body), pull, state.pose.turn[i], np.asarray(db.rotation_center, float))
    return natural_periods(db.reader.restrained(stiffness=K))
