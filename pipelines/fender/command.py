"""`hakobune fender`: the result as tables, and a picture."""

from __future__ import annotations

from ..common.picture import PLOTS, check_picture
from ..results.tables import printed
from .result import fender as found


def fender(table, strain, deflection, energy, output):
    """Print the fender of a FenderTable, draw it to `output`; energy : kJ.  Returns the exit status.

    raises : ValueError, one line
    """
    check_picture(output, PLOTS)
    result = found(table, strain=strain, deflection=deflection, energy=None if energy is None else 1e3 * energy)
    if output is not None:
        from .picture import draw

        draw(result.detail, output)
    status = printed(result)
    if output is not None:
        print(output)
    return status
