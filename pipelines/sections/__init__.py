"""`hakobune sections`."""
