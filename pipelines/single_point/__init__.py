"""`hakobune single-point`: a body on a buoy or turret, its equilibrium, its slewing and its mooring loads."""
