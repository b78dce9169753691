"""Fenders: their reaction, and the energy that they absorb and return, alone or in series with a dolphin.

curves       a reaction over a deflection as piecewise cubics
fender       a fender as a value: reaction, energy, unloading, marks, size and grade
hysteresis   unloading with inner loops that never give energy back; the table a simulation takes
families     generic characteristics by family; tables of makers
pneumatic    the gas law
dolphin      a spring in series
inclined     under a face that is inclined
variability  bands of manufacture, ageing, temperature, …; softest and stiffest
"""
