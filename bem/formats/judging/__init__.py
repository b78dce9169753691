"""Checks of other programs' sets against the hull, the water and laws of their own."""
