"""Commands, scenes, runs and reports; the only place where degrees, tonnes-force and knots exist."""
