"""`hakobune moor`: a moored body by the simplified method."""
