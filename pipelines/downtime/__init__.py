"""`hakobune downtime`: unusable hours at a berth, and weather windows, from a multi-year record."""
