"""Flexible bodies: shapes beyond the six rigid motions, their mass and their stiffness."""
