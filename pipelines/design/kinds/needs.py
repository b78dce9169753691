"""Breakable parts of a study, and the quantities that judge these parts.

A mooring with criteria for none of them would pass without a check of its lines, fenders or anchors.
"""

from typing import NamedTuple

from hakobune.mooring.criteria.verdict import HAWSER, HOLDING, OF_TENSIONS, PRETENSION, SHARE

TOTAL, SLOW = "fender strain, total", "fender strain, steady"
OF_ALLOWABLE, OF_ENERGY = "fender strain / allowable strain", "fender energy / rated energy"
OF_REACTION, REACTION = "fender reaction / rated reaction", "fender reaction, kN"
OF_FENDERS = OF_ALLOWABLE, OF_ENERGY, OF_REACTION, TOTAL, SLOW
DOLPHIN = "design load of a dolphin / fender reaction"
SCOPE = "line length / (5 depths + tidal range)"
EXCURSION = "excursion"  # m, largest horizontal distance of a body, or of a buoy, from its place at rest
ANCHOR = "anchor pull x safety / capacity"  # of the study's own anchors
COEFFICIENT = "horizontal seismic coefficient"
GAP, HINGE_FORCE, HINGE_MOMENT = "gap between hulls", "hinge force", "hinge moment"  # between several bodies
LOADS = tuple(quantity for quantity in OF_TENSIONS if quantity not in (PRETENSION, HOLDING))


class Need(NamedTuple):
    """what : with the name of its table; quantities : quantities of which one must be limited, the first as an example

    hawser : True if the limit must be one for hawsers, False for other lines, None for either
    """

    what: str
    quantities: tuple
    hawser: bool | None = None

    def judged(self, criteria):
        """Whether any of the criteria limits the part"""
        return any(one.quantity in self.quantities and self.hawser in (None, one.subject == HAWSER) for one in criteria)


def of_lines(what, hawser=None):
    """The Need of lines, ropes or hawsers"""
    return Need(what, (SHARE, *LOADS), hawser)
