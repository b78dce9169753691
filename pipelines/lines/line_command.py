"""`hakobune line`: one uniform line, its forces on the terminal, its profile and tension–offset curve as a picture."""

import numpy as np

from hakobune.mooring.lines.one_line import tension_curve

from ..common.picture import PLOTS, check_picture, save
from ..common.units import KN
from ..results.output import check_result, finish, write_result
from .line_result import line


def line_command(output, plot, **words):
    """Print, draw or write a line; returns the exit status.  Raises ValueError.

    words : from `line_result.line`
    """
    check_result(output, "line")
    check_picture(plot, PLOTS)
    return finish(line(**words), (output, write_result), (plot, draw))


def draw(result, path):
    """Draw the profile of a `OneLine` at a span (m), from its `LineSolution`, and its tension over a range of spans"""
    from matplotlib.figure import Figure

    one, span, found = result.detail
    figure = Figure(figsize=(12, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    shape = one.shape(span, 400)
    left.plot(*shape.T, color="C0", lw=2)
    reach = np.array([min(0.0, shape[:, 0].min()), max(1.02 * span, shape[:, 0].max())])
    left.plot(reach, reach * np.tan(one.slope), color="0.5", lw=4, zorder=0)
    if one.floats:
        left.plot(reach, [one.depth, one.depth], color="C0", lw=0.8)
    left.plot([0], [0], "k^")
    left.plot([span], [one.height], "ko")
    left.set(xlabel="x from the anchor, m", ylabel="height, m", aspect="equal" if one.height > 0.1 * span else "auto")
    left.set_title(f"{one.type.name}: {one.state(found)}")
    spans, curve = tension_curve(one, span=span)
    right.plot(spans, curve.horizontal_fairlead / KN, label="horizontal at the fairlead")
    right.plot(spans, curve.tension_fairlead / KN, label="tension at the fairlead")
    right.plot([span], [found.tension_fairlead / KN], "ko", ms=5)
    right.set(xlabel="span, m", ylabel="kN", ylim=(0, None), title="tension and offset")
    right.legend(frameon=False)
    right.grid(alpha=0.3)
    save(figure, path, 130)
