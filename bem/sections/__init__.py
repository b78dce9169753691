"""Two-dimensional sections: rectangles in water of any depth, tables of them, strip methods, a quay."""
