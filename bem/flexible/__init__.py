"""Bodies that bend: shapes beyond the six rigid motions, what they weigh, and what holds them."""
