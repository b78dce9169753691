"""By which equations a frequency is solved, and at which of many finer panels are taken: each limit from both sides."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.methods import panel_problem
from hakobune.bem.methods.panel_problem import PreparedPanelProblem


def prepared(nodes=9, sectors=None, **more):
    given = {"zero_draft": False, "damping_lids": (), "band": None, "gravity": 10.0, "nodes_per_panel": 4} | more
    body, asked = object.__new__(PreparedPanelProblem), []
    geometry = SimpleNamespace(
        elements=SimpleNamespace(nodes=range(nodes)), classes=[(1, 1)], without_lid=SimpleNamespace(sectors=sectors),
        at=lambda K: asked.append(K) or SimpleNamespace(sectors=sectors),
    )  # fmt: skip
    for name, value in (
        ("problem", SimpleNamespace(**given)),
        ("geometry", geometry),
        ("axisymmetric_geometry", geometry),
    ):
        vars(body)[name] = value
    return body, asked


MANY = panel_problem.WORTH_COMPRESSING


@pytest.mark.parametrize("more, kind", [
    ({"zero_draft": True, "damping_lids": ("one",), "band": (0.1, 2.0)}, "ZeroDraftRun"),
    ({"damping_lids": ("one",), "band": (0.1, 2.0)}, "DampedRun"), ({"band": (0.1, 2.0), "sectors": "some"}, "BandRun"),
    ({"band": (1.1, 2.0), "sectors": "some"}, "AxisymmetricRun"), ({}, "PanelRun"), ({"nodes": MANY}, "PanelRun"),
    ({"nodes": MANY + 1}, "CompressedRun"), ({"nodes": MANY + 1, "nodes_per_panel": 1}, "PanelRun"),
    ({"nodes": MANY + 1, "sectors": "some"}, "AxisymmetricRun"),
])  # fmt: skip
def test_equations_are_those_of_the_first_kind_that_suits(more, kind):
    body, asked = prepared(**more)
    assert body._kind(0.8).__name__ == kind
    assert asked == ([pytest.approx(0.064)] if kind in ("AxisymmetricRun", "PanelRun", "CompressedRun") else [])


@pytest.mark.parametrize("omega, inside", [
    (0.5 * (1 - 0.9e-9), True), (0.5 * (1 - 1.1e-9), False), (2 * (1 + 0.9e-9), True), (2 * (1 + 1.1e-9), False),
])  # fmt: skip
def test_a_band_has_its_ends_to_rounding(omega, inside):
    assert prepared(band=(0.5, 2.0))[0].in_band(omega) is inside
    assert not prepared()[0].in_band(omega)


def test_limits_are_of_the_surface_at_zero_draft_and_compressed_without_sectors(monkeypatch):
    from hakobune.bem.panels import frequency_limits, zero_draft
    from hakobune.bem.panels.compressed import one_frequency

    for module, name in ((frequency_limits, "added_mass_limit"), (one_frequency, "added_mass_limit"),
                         (zero_draft, "rigid_surface_limit")):  # fmt: skip
        monkeypatch.setattr(module, name, lambda body, which, module=module: (module, which))
    assert prepared()[0].added_mass_limit("zero") == (frequency_limits, "zero")
    assert prepared(nodes=MANY + 1)[0].added_mass_limit("infinity") == (one_frequency, "infinity")
    assert prepared(nodes=MANY + 1, sectors="some")[0].added_mass_limit("zero") == (frequency_limits, "zero")
    assert prepared(zero_draft=True)[0].added_mass_limit("zero") == (zero_draft, "zero")


@pytest.mark.parametrize("coarse, extrapolated, found", [
    ([], [], []), ([3], [3], [*range(9, 16)]), ([0, 1], [0, 1, 2], [*range(8)]), ([4], [4], [*range(13, 17)]),
    ([1, 2, 3], [3, 4], [*range(9, 16)]),
])  # fmt: skip
def test_frequencies_beyond_the_tolerance_lie_between_probes_that_keep_it(coarse, extrapolated, found, monkeypatch):
    """Five probes among 17; those count that miss it extrapolated too"""
    monkeypatch.setattr(panel_problem, "PROBES", 5)
    omegas = np.arange(17.0)

    def run(omega, *question):
        n = int(omega) // 4
        after = SimpleNamespace(tolerances=1.1 if n in extrapolated else 0.9)
        return SimpleNamespace(tolerances=1.1 if n in coarse else 0.9, extrapolated=after)

    body = SimpleNamespace(problem=SimpleNamespace(finer=SimpleNamespace(omegas=omegas)), run=run)
    assert PreparedPanelProblem._beyond_tolerance.fget(body).tolist() == found
    body.problem.finer.omegas = omegas[:9]  # less than two for each probe
    assert PreparedPanelProblem._beyond_tolerance.fget(body).tolist() == []


def test_the_contour_method_alone_has_a_sharper_run_up_to_its_last():
    from hakobune.bem.methods.shape_run import ShapeRun

    for method, sharper, there in (("contour", "sharper", True), ("contour", None, False), ("strip", "sharper", False)):
        run = SimpleNamespace(problem=SimpleNamespace(method=method), solver=SimpleNamespace(sharper=sharper),
                              prepared="prepared", question=(1, 2))  # fmt: skip
        found = ShapeRun.sharper.fget(run)
        assert (found is not None) is there
        assert found is None or (found.func is ShapeRun and found.args == ("prepared", 1, 2, "sharper"))


@pytest.mark.parametrize("classes, nodes", [(1, MANY), (2, int(MANY / np.sqrt(2))), (4, MANY // 2)])
def test_nodes_of_a_symmetric_part_count_by_the_root_of_the_number_of_its_classes(classes, nodes):
    """Work of as many systems of a part of the nodes"""
    for more, taken in ((0, False), (1, True)):
        body, _ = prepared(nodes=nodes + more)
        body.geometry.classes = [(1, 1)] * classes
        assert body.compressed is taken
    body.problem.zero_draft = True
    assert not body.compressed
