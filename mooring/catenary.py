"""Static mooring lines, many in one call: the public door to `mooring.lines.catenary`."""

from .lines.catenary.solve import LineSolution, solve_lines, span_at_tension
from .lines.catenary.state import LineError, State

__all__ = ["LineError", "LineSolution", "State", "solve_lines", "span_at_tension"]
