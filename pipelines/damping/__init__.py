"""`hakobune damping`."""
