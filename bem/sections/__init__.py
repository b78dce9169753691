"""Two-dimensional sections in water of any depth: rectangles and their tables, any outline by panels, strips, a
quay."""
