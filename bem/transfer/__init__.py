"""Bodies far from each other: the response of each kind of body to partial waves, coupled by the waves that the bodies
send."""
