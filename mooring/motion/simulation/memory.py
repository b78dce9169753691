"""The fluid memory of a run, fitted with the smallest tolerance that the allowed number of states makes possible."""

import numpy as np

from hakobune.bem.time_domain.memory import goal_of_database, memory_of_database

TOLERANCES = (3e-4, 1e-3, 3e-3, 1e-2, 3e-2)
COUPLED, ONE_PLANE = 1e-6, 12  # share of added mass, and how many entries beside the diagonal a body with one plane of
# symmetry has; with more the fit takes a minute and a half to 1e-3, and 15 s to 3e-3
WANTED = 1e-3  # fit error accepted without a finding


def fitted_memory(body, motions=None):
    """The `Memory` of a Reader, fitted to the smallest possible tolerance of TOLERANCES; and findings if it is not
    WANTED.

    motions : numbers of its motions, None for all
    raises : ValueError if no tolerance is met.
    A frequency band with contradictory values has no close fit. Tolerances far below the best fit tried are then
    skipped.
    """
    A = body.held_added_mass(0.0)[0]
    A = A if motions is None else A[np.ix_(motions, motions)]
    size = np.sqrt(np.diag(A))
    coupled = np.count_nonzero(np.abs(A) > COUPLED * np.outer(size, size)) - len(A)
    goal, within = goal_of_database(body, motions), 0.0
    for tolerance in TOLERANCES[2 * (coupled > ONE_PLANE) :]:
        if tolerance < within:
            continue
        try:
            memory = memory_of_database(body, tolerance, motions, goal)
        except ValueError as error:
            refused, within = error, getattr(error, "within", 0.0)
            continue
        if tolerance <= WANTED:
            return memory, ()
        return memory, (
            f"the memory of the water is fitted to {memory.error.max():.2g} of its largest value, required "
            f"{WANTED:g}; store more frequencies over a wider band",
        )
    raise refused
