"""What a study has that can break, and the quantities that judge it.

A mooring whose criteria speak of none of them would pass with its lines, fenders or anchors never looked at.
"""

from __future__ import annotations

from typing import NamedTuple

from hakobune.mooring.criteria.verdict import HAWSER, HOLDING, OF_TENSIONS, PRETENSION, SHARE

TOTAL, SLOW = "fender strain, total", "fender strain, steady"
OF_ALLOWABLE, OF_ENERGY = "fender strain / allowable strain", "fender energy / rated energy"
OF_FENDERS = OF_ALLOWABLE, OF_ENERGY, TOTAL, SLOW
DOLPHIN = "design load of a dolphin / fender reaction"
SCOPE = "line length / (5 depths + tidal range)"
COEFFICIENT = "horizontal seismic coefficient"
LOADS = tuple(quantity for quantity in OF_TENSIONS if quantity not in (PRETENSION, HOLDING))


class Need(NamedTuple):
    """what : with the name of its table; quantities : of which one has to be limited, the first as an example

    hawser : whether the limit has to be of hawsers, or of what is none; None where it is the same
    """

    what: str
    quantities: tuple
    hawser: bool | None = None

    def judged(self, criteria):
        """Whether one of the criteria limits it"""
        return any(one.quantity in self.quantities and self.hawser in (None, one.subject == HAWSER) for one in criteria)


def of_lines(what, hawser=None):
    """The Need of lines, ropes or hawsers"""
    return Need(what, (SHARE, *LOADS), hawser)
