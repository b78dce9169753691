"""Design values of a site: extremes of yearly maxima with the scatter of extremes, water levels, seismic coefficients.

extremes  Gumbel, Weibull and generalised extreme value fits, return values and their intervals
seismic   coefficients of the rules quoted by the SR179 report
"""
