"""Loads of wind and current on a hull or a member. Boxes use the tables of the SR179 report (1982), hulls use user
coefficients, a slowly turning box uses turning tests, and members use drag and inertia.

A stream's direction is the one travelled to, 0 → +x.  Between tabulated angles, depths and proportions, coefficients
follow monotone cubics. These pass through every tabulated value, without overshoot and with a continuous slope.
"""
