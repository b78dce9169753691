"""`hakobune site`: design values of a site for a mooring, from measurements to a file that studies read."""
