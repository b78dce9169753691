"""`hakobune sweep`."""
