"""Berthing of ships: the energy that a fender must absorb, and a berthing in time.

energy the kinetic-energy method with coefficients from the literature
two_springs   Ueda's closed form: dolphin and fender as springs, the fender with a plateau
speeds        approach speeds: Weibull, return periods
memory        sway and yaw with the added mass and the memory of a database
field         fifty berthings of tankers measured by Ueda (1981)
"""
