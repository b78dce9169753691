"""Hours of a multi-year record in which a berth or an operation cannot be used, and the weather windows between these
hours."""
