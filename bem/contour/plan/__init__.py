"""Plane problems on the contour of a waterplane, circle or rectangle, one for each depth mode."""
