"""The mooring of windIO: joints in cylindrical coordinates and along members; a chain by the diameter of its bar."""

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


@pytest.mark.parametrize(("angles", "turned"), [
    ((math.pi, math.pi / 3, -math.pi / 3), (180.0, 60.0, -60.0)), ((180.0, 60.0, -60.0), (180.0, 60.0, -60.0)),
    ((0.0, 2 * math.pi / 3, 4 * math.pi / 3), (0.0, 120.0, 240.0)), ((0.0, 0.0, 6.3), (0.0, 0.0, 6.3)),
])  # fmt: skip
@pytest.mark.parametrize("version", [2.0, None])
def test_angles_that_never_pass_a_turn_are_radians(angles, turned, version):
    """Files of version 1, and such files that are called version 2, have radians; 6.3 is above 2π"""
    turbine = copy.deepcopy(TURBINE)
    turbine["windIO_version"] = version
    parts = turbine["components"]
    parts["floating_platform"] = {
        "joints": [{"name": f"j{i}", "location": [30.0, angle, -20.0], "cylindrical": True}
                   for i, angle in enumerate(angles)] + [{"name": "far", "location": [-700.0, 40.0, -150.0]}]
    }  # fmt: skip
    nodes = parts["mooring"]["nodes"]
    nodes[1:] = [{"name": f"n{i}", "node_type": "vessel", "joint": f"j{i}"} for i in range(3)]
    parts["mooring"]["lines"] = [
        {"name": f"l{i}", "line_type": "main", "unstretched_length": 760.0, "node1": "a", "node2": f"n{i}"}
        for i in range(3)
    ]
    points = system_of_moorpy(turbine).points[1:]
    for point, angle in zip(points, turned, strict=True):
        across = 30 * math.cos(math.radians(angle)), 30 * math.sin(math.radians(angle))
        assert point.position == pytest.approx((*across, -20.0), abs=1e-9)


def test_a_chain_by_its_bar_weighs_what_steel_of_its_volume_does():
    """IEA's 22 MW turbine: bar of 0.225 m, 1007.4 kg/m and 4.3234e9 N in its own MoorDyn file; steel of 7 850 kg/m³ in
    sea water weighs 1 − 1025/7850 of that"""
    turbine = copy.deepcopy(TURBINE)
    turbine["components"]["mooring"]["line_types"] = [{"name": "main", "type": "chain", "diameter": 0.225}]
    with pytest.warns(
        UserWarning, match="bar diameter of 0.225 m, as WISDEM does: 1007 kg/m, .* is 3.24 times lighter"
    ):
        (line,) = system_of_moorpy(turbine, "t.yaml").lines
    assert line.type.mass == pytest.approx(1007.4375) and line.type.axial_stiffness == pytest.approx(4.3234e9, rel=1e-4)
    assert line.type.weight == pytest.approx(1007.4375 * 9.80665 * (1 - 1025 / 7850), rel=2e-3)


@pytest.mark.parametrize("row", [
    {"type": "chain", "diameter": 0.333}, {"type": "polyester", "diameter": 0.2}, {"type": "chain", "diameter": "?"},
    {"type": "chain", "diameter": 0.2, "stiffness": 1e9}, {"type": "chain", "diameter": 0.0},
])  # fmt: skip
def test_what_is_no_bar_of_a_chain_is_refused(row):
    turbine = copy.deepcopy(TURBINE)
    turbine["components"]["mooring"]["line_types"] = [{"name": "main", **row}]
    with pytest.raises(FormatError, match=r"no mass_density.* is too large for the bar of a chain"):
        system_of_moorpy(turbine, "t.yaml")


def test_a_turbine_on_land_has_no_mooring():
    with pytest.raises(FormatError, match="has no mooring"):
        system_of_moorpy({"windIO_version": 2.0, "components": {"tower": {}}}, "t.yaml")
