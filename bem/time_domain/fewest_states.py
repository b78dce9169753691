"""The fewest states of coupled motions whose passive system is within tolerance of a transform.

Poles are found by `rational`. States are selected by balancing, and outputs follow from `passive_fit`. At frequencies
of the band where the body is sensitive to errors of the fit (`sensitivity`), the fit is more accurate than the
tolerance.
"""

import numpy as np

from .kept_fits import NoFit, kept_fit
from .passive_fit import MOVABLE, MOVED, passive_fit
from .rational import balanced, fitted

POLES = (32, 48, 64)  # numbers of poles, per input, from which states are selected
MOST = (76, 4)  # states of coupled motions, and for each of them
ANSWERED, NEARER = 2.0, 8.0  # times sensitivity and number of coupled motions: the factor by which memory is nearer,
# and the largest one.  Free decay of boxes and a buoy is then within 8e-5 of its start for a tolerance of 3e-4
LESS = (1.0, 0.5, 0.0)  # powers of that factor, tried one after the other
PATIENCE = 6  # passive fits in a row that are no nearer than one before; then more states of a system do not help
COARSER = 2.0  # error of the best system over the smallest tolerance that can be met, where no modes are moved


class FitError(ValueError):
    """A tolerance is not met; within : limit below which all tolerances are missed too"""

    def __init__(self, message, within):
        super().__init__(message)
        self.within = within


def fewest_states(omega, wanted, size, group, tolerance, answered, words):
    """`Passive` of coupled motions, in units of `size`, with the fewest states that were found within tolerance

    omega : rad/s, (q,); wanted : transform to fit, (q, m, m); size : scale of each motion, (m,)
    group : indices of the coupled motions; answered : `sensitivity` of the motions, (q, m); words : names of all
        motions.
    The fit is computed, or kept from an earlier call.  Raises FitError.
    """
    arrays = omega, wanted, size, tolerance, answered
    try:
        return kept_fit(__file__, lambda: _fitted(omega, wanted, size, group, tolerance, answered), *arrays)
    except NoFit as fault:
        best = fault.best
    raise FitError(
        f"the memory of the water in {', '.join(words[i] for i in group)} has an error of {best:.2g} with the best "
        f"system that was tried, and the tolerance is {tolerance:g}; give a larger tolerance, or solve the database "
        "to a smaller tolerance",
        best / (MOVABLE if len(group) <= MOVED else COARSER),
    )


def _fitted(omega, wanted, size, group, tolerance, answered):
    """`fewest_states`, computed now.  Raises NoFit."""
    wanted, s = wanted.conj() / np.outer(size, size), 1j * omega
    nearer = np.sqrt(np.clip(ANSWERED * len(group) * answered, 1.0, NEARER if len(group) <= MOVED else 1.0))
    best, most = np.inf, MOST[0] + MOST[1] * len(group)
    for power in LESS if np.any(nearer > 1) else LESS[:1]:
        weight = (nearer[:, :, None] * nearer[:, None, :]) ** power
        for poles in POLES:
            system, off = fitted(s, wanted, poles, weight)
            if off > tolerance:
                best = min(best, off)
                continue
            whole = balanced(system)
            fewest = max(4, len(group) + 1, int(np.sum(whole.values > tolerance)))
            nearest, tried = np.inf, 0
            for states in range(fewest, min(most, len(whole.values)) + 1, max(1, len(group) - 1)):
                made, error = passive_fit(*whole.reduced(states)[:2], s, wanted, 0.99 * tolerance, weight)
                best = min(best, error)
                if error <= tolerance:
                    return made
                if made is not None:
                    tried = 0 if error < nearest else tried + 1
                    nearest = min(nearest, error)
                    if tried == PATIENCE:
                        break
    raise NoFit(best)
