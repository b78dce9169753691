"""Mooring of a floating body: lines, equilibrium, natural periods and studies on a stored wave database.

Conventions are those of `bem`.  Directions of wind, current and waves are directions of travel, 0 → +x.
A line pulls its fairlead towards the anchor with H ≥ 0 and down with V; it pulls its anchor towards the
fairlead and, where `vertical_anchor` is positive, up.
"""
