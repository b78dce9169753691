"""`hakobune single-point`: a body on a buoy or turret, where it lies, whether it slews, what it pulls."""
