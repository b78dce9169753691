"""Bodies far from each other: the answers of each shape to partial waves, coupled by what the bodies send."""
