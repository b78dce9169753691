"""The mooring of a turbine in windIO (WISDEM, WEIS), as the table `mooring` of a RAFT design.

    components.mooring             nodes: fixed, vessel or connection, by location or joint; lines: node1, node2,
                                   unstretched_length, line_type; line_types
    components.floating_platform   joints: location [x, y, z], or [r, θ in degrees, z] where cylindrical; members:
                                   joint1, joint2 and axial_joints, each at a share `grid` of the way

A type that has the word chain and a diameter alone is refused: files have the diameter of the bar there, or that of a
bar of the same volume, twice as large.  windIO's schema of turbines, version 2.
"""

import math

from .fault import FormatError


def is_windio(data):
    """Whether nested dictionaries are a turbine with a mooring"""
    parts = data.get("components")
    return isinstance(parts, dict) and isinstance(parts.get("mooring"), dict)


def raft_of_windio(data, path):
    """Nested dictionaries as a RAFT design has them.  Raises FormatError naming the part."""
    mooring, platform = data["components"]["mooring"], data["components"].get("floating_platform")
    try:
        places = _joints(platform if isinstance(platform, dict) else {})
        points = [_point(node, places, path) for node in mooring["nodes"]]
        lines = [
            {"name": line["name"], "endA": line["node1"], "endB": line["node2"], "type": line["line_type"],
             "length": line["unstretched_length"]}
            for line in mooring["lines"]
        ]  # fmt: skip
        types = [_type(row, path) for row in mooring["line_types"]]
    except FormatError:
        raise
    except (KeyError, TypeError, ValueError) as error:
        raise FormatError(f"{path}: components.mooring of windIO lacks or misplaces {error}") from None
    made = {"points": points, "lines": lines, "line_types": types}
    water = data.get("environment")
    site = {key: water[key] for key in ("water_depth", "water_density") if key in (water or ())}
    return {"site": site, "mooring": made} if site else {"mooring": made}


def _joints(platform):
    """{name: [x, y, z]} m of joints, and of those along members"""
    places = {}
    for joint in platform.get("joints", ()):
        a, b, z = map(float, joint["location"])
        turned = [a * math.cos(math.radians(b)), a * math.sin(math.radians(b)), z]
        places[joint["name"]] = turned if joint.get("cylindrical") else [a, b, z]
    for member in platform.get("members", ()):
        for joint in member.get("axial_joints", ()):
            start, end, share = places[member["joint1"]], places[member["joint2"]], float(joint["grid"])
            places[joint["name"]] = [(1 - share) * one + share * other for one, other in zip(start, end, strict=True)]
    return places


def _point(node, places, path):
    place = node["location"] if "location" in node else places.get(node["joint"])
    if place is None:
        raise FormatError(
            f"{path}: joint {node['joint']} of node {node['name']} is not among the joints of floating_platform"
        )
    return {"name": node["name"], "type": node["node_type"], "location": [float(value) for value in place]}


def _type(row, path):
    missing = [key for key in ("mass_density", "stiffness") if key not in row]
    if missing:
        raise FormatError(
            f"{path}: line type {row['name']} of windIO has no {' and no '.join(missing)}, and its "
            f"{row.get('type', 'diameter')} of {row.get('diameter')} m may be the nominal or the volume-equivalent "
            f"diameter; give both, in kg/m and N"
        )
    return {key: value for key, value in row.items() if key != "type"}
