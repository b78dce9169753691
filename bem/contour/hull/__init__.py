"""First-order flow of the contour method at points of the hull, from which forces of pairs of waves are computed."""
