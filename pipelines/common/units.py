"""Units of studies, in SI."""

KNOT = 1852 / 3600  # m/s
TONF = 9806.65  # N
KN = 1e3  # N
KGF = 9.80665  # N
