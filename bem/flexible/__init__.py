"""Flexible bodies: shapes beyond the six rigid motions, and the mass and stiffness of shapes."""
