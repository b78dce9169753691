"""From a scene to its database: hull, plan of the run, frequencies, report, checks."""
