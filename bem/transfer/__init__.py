"""Bodies far from each other: the response of each shape to partial waves, coupled by the waves that the bodies
send."""
