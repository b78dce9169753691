"""Green functions of a source under a free surface in any depth, their tables, and flat Rankine panels."""
