"""The mooring of a turbine in windIO (WISDEM, WEIS), as the table `mooring` of a RAFT design.

    components.mooring             nodes: fixed, vessel or connection, by location or joint; lines: node1, node2,
                                   unstretched_length, line_type; line_types
    components.floating_platform   joints: location [x, y, z], or [r, θ, z] where cylindrical; members: joint1, joint2,
                                   axial_joints, each at a share `grid` of the way

θ is in degrees in version 2 and in radians in version 1, but files of version 1 may be called version 2. Angles are
therefore taken as radians if none of them is above 2π.

For a chain given only by its diameter d, mass and stiffness follow WISDEM, and a warning says so. d is the diameter
of the bar, as in the turbines of IEA Wind (0.185 and 0.225 m). windIO's turbine schema, version 2, asks instead for
the diameter of equal volume, 1.8 d. No bar is thicker than `THICKEST`.

    m = 19.9e3 d² kg/m,    EA = 8.54e10 d² N        studless chain, `wisdem/floatingse/mooring.py`
"""

import math
import warnings

from .fault import FormatError

CHAIN_MASS, CHAIN_STIFFNESS = 19.9e3, 8.54e10  # kg/m and N over d²
SAME_VOLUME = 1.8  # diameter of a rod of the same volume, over that of the bar
TURN = 2 * math.pi + 1e-6  # rad, largest angle of joints in radians
THICKEST = 0.25  # m, diameter of a bar; the largest that are made have 0.22


def is_windio(data):
    """Whether nested dictionaries are a turbine with a mooring"""
    parts = data.get("components")
    return isinstance(parts, dict) and isinstance(parts.get("mooring"), dict)


def raft_of_windio(data, path):
    """Nested dictionaries in the form of a RAFT design. Raises FormatError naming the part."""
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
    places = {joint["name"]: [float(value) for value in joint["location"]] for joint in platform.get("joints", ())}
    round_ = [joint["name"] for joint in platform.get("joints", ()) if joint.get("cylindrical")]
    radians = max((abs(places[name][1]) for name in round_), default=0.0) <= TURN
    for name in round_:
        r, angle, z = places[name]
        angle = angle if radians else math.radians(angle)
        places[name] = [r * math.cos(angle), r * math.sin(angle), z]
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
        row = _chain(row, missing, path)
    return {key: value for key, value in row.items() if key != "type"}


def _chain(row, missing, path):
    """A line type with mass and stiffness of a studless chain by the diameter of its bar.  Raises FormatError."""
    kind, d = str(row.get("type", "diameter")), row.get("diameter")
    if kind.lower() != "chain" or len(missing) == 1 or not isinstance(d, int | float) or not 0 < d <= THICKEST:
        raise FormatError(
            f"{path}: line type {row['name']} of windIO has no {' and no '.join(missing)}, and its {kind} of "
            f"{d} m is too large for the bar of a chain (up to {THICKEST:g} m); give both, in kg/m and N"
        )
    made = {"diameter": SAME_VOLUME * d, "mass_density": CHAIN_MASS * d**2, "stiffness": CHAIN_STIFFNESS * d**2}
    warnings.warn(
        f"{path}: line type {row['name']} is taken as studless chain with a bar diameter of {d:g} m, as WISDEM "
        f"does: {made['mass_density']:.4g} kg/m, EA {made['stiffness']:.4g} N; if {d:g} m is the diameter of a "
        f"rod of the same volume, the chain is {SAME_VOLUME**2:.2f} times lighter: give mass_density and stiffness",
        stacklevel=4,
    )
    return row | made
