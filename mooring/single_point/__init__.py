"""A body moored at one point: with its bow to a buoy, through a hawser to a buoy, or by a turret.

The equilibrium of this body, its slewing (fishtailing), and its mooring loads.  SR179 report (1982), section 3.6 and
appendix 2.
"""
