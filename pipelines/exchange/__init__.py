"""`hakobune export` and `hakobune import`."""
