"""`hakobune fender`."""
