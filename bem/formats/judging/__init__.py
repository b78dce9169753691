"""Checks of the results of other programs against the hull, the water and the laws that such results obey."""
