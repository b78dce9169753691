"""A body moored at one point: to a buoy at its bow, through a hawser to a buoy, or by a turret.

Where it lies, whether it slews (fishtails), and what it pulls.  SR179 report (1982), section 3.6 and appendix 2.
"""
