"""Trade-off of draft, width and line angle: the lowest wave behind a breakwater for every tension.

First, Sobol's points over the given ranges are tried. Then COBYLA (Powell 1994) lowers the wave behind the
breakwater under tension limits between the best of these points. Designs that have slack lines, are unstable or are
impossible are excluded.
"""

import warnings
from typing import NamedTuple

import numpy as np

from hakobune.bem.sections.outline import OutlineError

from ...breakwater.transmission import equal_cells
from .breakwater import BreakwaterError
from .curves import response
from .in_sea import SEA_CELLS, WAYS, response_in_sea, ways_of
from .tides import pretension_of, tides_of

FEW_PERIODS, FEW_CELLS, FEW_WAYS = 10, 16, 4  # periods, cells and directions of a trial; the reported design uses all
TRIALS = 20  # trials per limit
OUT = 1e6
BESIDE, STEEP = 0.05, 0.2  # relative change of period and the change of K_T that indicates a resonance


class Front(NamedTuple):
    """Best designs, by increasing tension. names : of the varied values; designs : (n, names), in the units of the
    ranges; tension : (n,) greatest, N/m; behind : (n,) 4√m₀ behind the breakwater, m, or the greatest K_T if there is
    no sea; trials : number of designs tried"""

    names: tuple
    designs: np.ndarray
    tension: np.ndarray
    behind: np.ndarray
    trials: int


def front(changed, ranges, samples=64, limits=6):
    """The `Front` of breakwaters on lines to the bed.  Raises BreakwaterError where no design holds.

    changed : function of named values that returns a `Breakwater`, as its `changed`
    ranges : {name: (from, to)} of the values
    samples : number of initial designs, a power of two; limits : tension limits under which the wave behind is lowered
    """
    from scipy.stats import qmc

    names = tuple(ranges)
    low, high = np.array([*ranges.values()], float).T
    tried = {}

    def trial(x):
        values = tuple(low + (high - low) * np.clip(x, 0, 1))
        if values not in tried:
            tried[values] = objectives(changed, dict(zip(names, values, strict=True)), few=True)
        return tried[values]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # balance of Sobol's points; warnings of trials follow for the reported designs
        for x in qmc.Sobol(len(names), seed=0).random(samples):
            trial(x)
        holding = {x: value for x, value in tried.items() if value is not None}
        if not holding:
            raise BreakwaterError(f"optimisation: none of {samples} designs keeps its lines taut; give other ranges")
        _refine(trial, holding, low, high, limits)
        kept = {x: value for x, value in tried.items() if value is not None}
        best = [x for x, value in kept.items() if not any(_better(other, value) for other in kept.values())]
        whole = [(x, objectives(changed, dict(zip(names, x, strict=True)), few=False)) for x in best]
    whole = sorted(((x, value) for x, value in whole if value is not None), key=lambda row: row[1])
    whole = [row for row in whole if not any(_better(other, row[1]) for _, other in whole)]
    designs, values = (np.array(column) for column in zip(*whole, strict=True))
    return Front(names, designs, *values.T, len(tried))


def _refine(trial, holding, low, high, limits):
    """COBYLA from the best of the designs tried under each limit of the tension"""
    from scipy.optimize import minimize

    tensions = np.array([tension for tension, _ in holding.values()])
    for limit in np.geomspace(tensions.min(), tensions.max(), limits + 1)[1:]:
        under = {x: value for x, value in holding.items() if value[0] <= limit}
        start = (np.array(min(under, key=lambda x: under[x][1])) - low) / (high - low)
        height = min(value[1] for value in under.values())

        def lower(x, height=height):
            return (trial(x) or (OUT, OUT))[1] / height

        def spare(x, limit=limit):
            return 1 - min((trial(x) or (OUT, OUT))[0] / limit, 10.0)

        minimize(
            lower, start, method="COBYLA", bounds=[(0, 1)] * len(low), constraints={"type": "ineq", "fun": spare},
            options={"rhobeg": 0.1, "maxiter": TRIALS},
        )  # fmt: skip


def beside_resonances(changed, found):
    """A message on designs of a `Front` close to a resonance, with K_T at the periods around the steepest change"""
    steep = []
    for number, values in enumerate(found.designs, 1):
        made = changed(**dict(zip(found.names, map(float, values), strict=True)))
        period = np.outer([1 - BESIDE, 1.0, 1 + BESIDE], made.waves.period)
        order = np.argsort(period.ravel())
        passed = np.empty(period.size)
        passed[order] = abs(response(made, *made.design, 0.0, 2 * np.pi / period.ravel()[order]).transmission)
        spread = np.ptp(passed.reshape(period.shape), axis=0)
        worst = int(spread.argmax())
        steep.append((spread[worst], number, period[:, worst], passed.reshape(period.shape)[:, worst]))
    beside = [row for row in steep if row[0] > STEEP]
    if beside:
        _, number, period, passed = max(beside)
        told = ", ".join(f"{K:.2f} at {T:.3g} s" for T, K in zip(period, passed, strict=True))
        yield (
            f"{len(beside)} of the {len(steep)} best designs are near a resonance, most of all design {number}: "
            f"its K_T is {told}; a slightly different draft or period changes K_T by more than {STEEP:g}; choose "
            "another design, or give waves.periods at closer values there"
        )


def _better(one, other):
    return one != other and one[0] <= other[0] and one[1] <= other[1]


def objectives(changed, values, few):
    """(greatest tension, N/m; height behind, m, or K_T) of a breakwater with these values, None if the breakwater
    does not hold
    """
    try:
        made = changed(**values)
        period = made.waves.period
        if few:
            period = period[np.unique(np.linspace(0, len(period) - 1, FEW_PERIODS).round().astype(int))]
        tides = tides_of(made, period)
        held = pretension_of(made, tides)
        unstable = made.body is not None and any(made.taut(one.rise).stiffness <= 0 for one in tides)
    except (BreakwaterError, OutlineError):
        return None
    if held.slack or unstable or not np.isfinite(held.greatest).all():
        return None
    if made.sea is None:
        found = response(made, *made.design, 0.0, 2 * np.pi / period)
        return max(held.greatest), float(abs(found.transmission).max())
    sea = equal_cells(made.sea.spectrum, FEW_CELLS if few else SEA_CELLS)
    ways = ways_of(made, sea.omega, FEW_WAYS if few else WAYS)
    found = response_in_sea(made, *made.design, 0.0, sea.omega, made.waves.height / 2, ways)
    return max(held.greatest), 4 * float(sea.deviation(found.transmission))
