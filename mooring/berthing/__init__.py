"""Ships that berth: the energy a fender has to take up, and the course of a berthing in time.

energy        the kinetic-energy method with the coefficients of the literature
two_springs   Ueda's closed form: dolphin and fender as springs, the fender with a plateau
speeds        approach speeds: Weibull, return periods
memory        sway and yaw with the added mass and the memory of a database
field         fifty berthings of tankers measured by Ueda (1981)
"""
