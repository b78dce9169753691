"""`hakobune downtime`: hours at a berth that cannot be used, and windows of weather, from a record of years."""
