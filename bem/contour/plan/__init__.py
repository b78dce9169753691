"""Plane problems, one for each depth mode, on the contour of a waterplane that is a circle or a rectangle."""
