"""Bodies far from each other: each responds to partial waves, and waves that the bodies send couple them."""
