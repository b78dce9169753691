"""`hakobune site`: what a site asks of a mooring, from its measurements to the values that studies read."""
