"""Dense algebra for several methods: interpolation by rows, poles, linear systems of symmetry classes, convex hulls."""
