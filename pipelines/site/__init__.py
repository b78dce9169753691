"""`hakobune site`: design values of a site for a mooring, from its measurements to the values that studies read."""
