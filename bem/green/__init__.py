"""Green functions: a source under a free surface in any depth with its tables, and flat Rankine panels."""
