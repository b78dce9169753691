"""Static mooring lines, many in one call: the public door to `mooring.lines.catenary`."""

from .lines.catenary.solve import LineError, LineSolution, State, solve_lines, span_at_tension

__all__ = ["LineError", "LineSolution", "State", "solve_lines", "span_at_tension"]
