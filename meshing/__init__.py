"""Geometry of floating bodies as flat panels, without waves.

Lengths in metres, z up, z = 0 at the undisturbed water surface, normals out of the body into the water.
"""
