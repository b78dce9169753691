"""First-order flow of the contour method at points of the hull, for forces of pairs of waves."""
