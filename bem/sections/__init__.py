"""Two-dimensional sections in water of any depth: rectangles, tables of them, any outline by panels; strips, a quay."""
