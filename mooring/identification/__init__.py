"""Damping from records of model tests.

forced   B₁, B₂ and added mass of a body that is moved
decay    a, b of a body that is let go, and B₁, B₂ over its virtual mass
record   evenly spaced columns, the sine of a motion
"""
