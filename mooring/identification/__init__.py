"""Damping from records of model tests.

forced   B₁, B₂ and added mass of a body in forced motion
decay    a, b of a body in free decay, and B₁, B₂ over its virtual mass
coupled  what of it is not of waves, of a body whose other motions are free
record   evenly spaced columns, the sine of a motion
"""
