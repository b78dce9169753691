"""The mooring of windIO: joints in cylindrical coordinates and along members; a chain by its diameter alone is none."""

import copy
import math

import pytest

from hakobune.mooring.formats.fault import FormatError
from hakobune.mooring.formats.moorpy import system_of_moorpy
from hakobune.mooring.lines.system.parts import Anchor, Fairlead

TURBINE = {
    "windIO_version": 2.0,
    "environment": {"water_depth": 150.0},
    "components": {
        "floating_platform": {
            "joints": [
                {"name": "keel", "location": [30.0, 60.0, -20.0], "cylindrical": True},
                {"name": "deck", "location": [30.0, 60.0, 10.0], "cylindrical": True},
                {"name": "far", "location": [-700.0, 40.0, -150.0]},
            ],
            "members": [{"name": "column", "joint1": "keel", "joint2": "deck",
                         "axial_joints": [{"name": "fairlead", "grid": 0.2}]}],
        },
        "mooring": {
            "nodes": [
                {"name": "a", "node_type": "fixed", "joint": "far", "anchor_type": "drag"},
                {"name": "b", "node_type": "vessel", "joint": "fairlead"},
            ],
            "lines": [{"name": "one", "line_type": "main", "unstretched_length": 760.0, "node1": "a", "node2": "b"}],
            "line_types": [{"name": "main", "type": "custom", "diameter": 0.2, "mass_density": 150.0, "stiffness": 6e8,
                            "transverse_drag": 2.0}],
            "anchor_types": [{"name": "drag"}],
        },
    },
}  # fmt: skip


def test_lines_run_between_joints_of_a_platform():
    """r = 30 m at 60°; the fairlead a fifth of the way from −20 to 10 m; (m − ρ π d²/4) g a metre"""
    system = system_of_moorpy(copy.deepcopy(TURBINE))
    anchor, fairlead = system.points
    assert system.depth == 150.0 and isinstance(anchor, Anchor) and isinstance(fairlead, Fairlead)
    assert anchor.position == (-700.0, 40.0, -150.0)
    assert fairlead.position == pytest.approx((15.0, 30.0 * math.sqrt(0.75), -14.0))
    (line,) = system.lines
    assert (line.a, line.b, line.length) == ("a", "b", 760.0)
    assert line.type.weight == pytest.approx((150.0 - 1025.0 * math.pi * 0.01) * 9.80665)
    assert line.type.axial_stiffness == 6e8


@pytest.mark.parametrize(("change", "said"), [
    (lambda m: m["line_types"][0].pop("mass_density"), "type main of windIO has no mass_density, and its custom of"),
    (lambda m: [m["line_types"][0].pop(k) for k in ("mass_density", "stiffness")], "no mass_density and no stiffness"),
    (lambda m: m["nodes"][1].update(joint="nowhere"), "joint nowhere of node b is not among the joints of "
        "floating_platform"),
    (lambda m: m["lines"][0].pop("unstretched_length"), "components.mooring of windIO lacks or misplaces 'unstretched"),
])  # fmt: skip
def test_what_windio_leaves_open_is_named(change, said):
    turbine = copy.deepcopy(TURBINE)
    change(turbine["components"]["mooring"])
    with pytest.raises(FormatError, match=said):
        system_of_moorpy(turbine, "t.yaml")


def test_a_turbine_on_land_has_no_mooring():
    with pytest.raises(FormatError, match="has no mooring"):
        system_of_moorpy({"windIO_version": 2.0, "components": {"tower": {}}}, "t.yaml")
