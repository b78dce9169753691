"""Hours of a multi-year record in which a berth or an operation is unusable, and the weather windows between them."""
