"""Two-dimensional sections in water of any depth: rectangles, tables of rectangles, any outline by panels; strips, a
quay."""
