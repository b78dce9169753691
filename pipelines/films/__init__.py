"""Films: of a run in time, and of a body in regular waves."""
