"""Resolution of each part of the contour method that gives a relative error of 10^(−digits) in coefficients and forces.

Each part was coarsened alone on 230 random bodies (L/B 1 … 20, B/d 0.2 … 100, H/d 1.02 and up, λ/L 0.2 … 20).  In 95
% of these bodies the resulting error is less than the following numbers, with r = gap / min(draft, scale), g = gap /
scale, the scale of the plan, and `high` = max(g/4, 1):

    functions of the gap, T in each family      10^(−8 (1 + r)^(−0.7) − (T − 1)(0.8 + 1.7 / (1 + r/4)))
    evanescent modes, 15 m per length           10^(−1.5 − 1.2 m)
    table of q digits in κ                      10^(−0.8 − 1.15 q) g^1.45 high^1.5
    panels on the plan, p digits                10^(−1.2 − 1.3 p) high^3.3
    polynomials beyond those of the waves, e    10^(−2.4 − e/1.5)

The median error of each part is thirty times smaller, and the part with the largest error differs from body to body.
The error is therefore not estimated by these formulas, but from a finer body (`finer`), in which all parts are finer.
In a narrow gap one more function of the gap reduces its error by up to six digits; the errors of the other parts
remain.

The 230 bodies were a hundred waves long at most, and most of them a few waves long.  With fifty waves or more over a
low gap, panels of one digit had an error of 10^(−1), and a table of no digits 10^(−2). The least resolutions are
therefore three digits and one digit, which cost no time.
"""

from math import ceil, log10
from typing import NamedTuple

KAPPA, PLAN = 1.15, 1.3  # digits of the result per digit of the table, and of the panels
CLEAR = 1e-8  # eigenvalue of a profile that the error of the mode sums does not reach
DIGIT = 1.0  # extra digits of the finer body: its own error, on average a tenth, is then negligible


def height(gap, scale):
    """The factor `high`: growth of errors with the gap over the scale of the plan; 1 for low gaps"""
    return max(gap / scale / 4, 1.0)


class Accuracy(NamedTuple):
    """digits : wanted digits; terms : functions in each of the three families of the gap; smallest :
    `Profiles.smallest`
    modes : evanescent modes per smallest length; kappa : digits of the table in κ
    plan : digits of the plan's panels; extra : polynomials per side and class beyond those that waves need
    further : further polynomials, added on the shorter side after rounding
    """

    digits: float
    terms: int
    smallest: float
    modes: float
    kappa: float
    plan: float
    extra: int
    further: int = 0


def accuracy(digits, draft, gap, scale):
    """`Accuracy` for a relative error of 10^(−digits); draft, gap under the keel and scale of the plan in m"""
    r, g = gap / min(draft, scale), gap / scale
    high = height(gap, scale)
    first, step = 8 * (1 + r) ** -0.7, 0.8 + 1.7 / (1 + r / 4)
    return Accuracy(
        digits,
        terms=1 + max(0, ceil((digits - first) / step)),
        smallest=max(10 ** (-3 - digits), CLEAR) / high,
        modes=15 * max(0.7, (digits - 1.5) / 1.2),
        kappa=max(1.0, (digits - 0.8 + 1.45 * log10(g) + 1.5 * log10(high)) / KAPPA),
        plan=max(3.0, (digits - 1.2 + 3.3 * log10(high)) / PLAN),
        extra=max(1, ceil(1.5 * (digits - 2.4))),
    )


def finer(coarse, draft, gap, scale):
    """`Accuracy` that estimates the error of a coarser `Accuracy`: every part is better by a factor of ten on average.

    The number of gap functions is chosen for the worst bodies; it is increased by one where these functions may
    dominate the error. The number of polynomials, which changes in steps, is raised to the next step.
    """
    fine, far = (accuracy(coarse.digits + n * DIGIT, draft, gap, scale) for n in (1, 2))
    return fine._replace(
        terms=max(fine.terms, min(far.terms, coarse.terms + 1)),
        kappa=max(fine.kappa, coarse.kappa + DIGIT / KAPPA),
        plan=max(fine.plan, coarse.plan + DIGIT / PLAN),
        extra=coarse.extra,
        further=1,
    )
