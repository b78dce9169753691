"""Balance of the work done on a line: places in the arrays of powers and of works."""

WORK, DRAG, INERTIA, STRUCTURE, BED, FRICTION = range(6)
