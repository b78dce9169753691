"""A prepared body with other band equations than its own."""

from hakobune.bem.methods.panel_problem import PreparedPanelProblem


def with_equations(prepared, equations):
    """The same problem and geometry with given `band_equations`; the body itself stays as it is"""
    other = type("PreparedOtherwise", (PreparedPanelProblem,), {"band_equations": equations})
    return other(prepared.problem, prepared.geometry, prepared.coarse)
