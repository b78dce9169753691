"""Floating breakwaters moored taut, in two dimensions, per metre of length: transmission, tensions, anchors.

y points to leeward, z up, and rotation is from y to z; the time factor is exp(−iωt), with unit wave amplitude at the
origin. F is the seaward line, B the leeward line. Kihara, Kitatani & Todoroki (1975), "A Study on the Function and
Mooring Force of Floating Breakwaters with Circular Cross Section", Reports of the PHRI 14(2), 79-110. Their time
factor is exp(+iσt). Tensions here are amplitudes of forces per metre.
"""
