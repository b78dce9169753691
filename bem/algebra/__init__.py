"""Dense algebra that several methods share: interpolation by rows, poles, systems of symmetry classes, convex hulls."""
