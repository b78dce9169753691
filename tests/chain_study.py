"""A hull on chains, as mooring studies of tests begin."""


def chain_study(corner_headings):
    """Text of a study: water, hull and chains at the corners' headings, degrees; conditions are to be added"""
    return f"""
[water]
depth = 20.0
[hull]
freeboard = 10.0
[types.chain]
weight_kg_per_m = 406.0
axial_stiffness_tonf = 221700.0
breaking_load_tonf = 1700.0
[[spreads]]
type = "chain"
length = 260.0
corner_headings_deg = {corner_headings}
pretension_tonf = 40.0
"""
