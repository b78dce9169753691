"""`hakobune fender`: the result as tables, and a picture."""

from ..common.picture import PLOTS, check_picture
from ..results.tables import printed
from .result import fender as found


def fender(table, strain, deflection, energy, plot):
    """Print the fender of a FenderTable, draw it to `plot`; energy : kJ.  Returns the exit status.

    raises : ValueError, one line
    """
    check_picture(plot, PLOTS)
    result = found(table, strain=strain, deflection=deflection, energy=None if energy is None else 1e3 * energy)
    if plot is not None:
        from .picture import draw

        draw(result.detail, plot)
    status = printed(result)
    if plot is not None:
        print(plot)
    return status
