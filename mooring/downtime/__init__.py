"""Hours of a record of years in which a berth or an operation cannot be used, and the windows between them."""
