"""Draft, width and angle of the lines against each other: the least wave behind a breakwater for every tension.

Sobol's points over the given ranges, then for limits of the tension between the best of them COBYLA (Powell 1994),
which lowers the wave behind under the limit; designs whose lines go slack, that are unstable, or that cannot be, do not
count.  The body goes with its section: what is upright with its height, what is across with its width.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import msgspec
import numpy as np

from hakobune.bem.sections.outline import OutlineError
from hakobune.mooring.breakwater.transmission import equal_cells

from ..common.quantities import StudyError
from ..common.weather.seas import spectrum_of
from .build import Breakwater
from .curves import Curve, response
from .results import SEA_CELLS, WAYS, design, in_sea, pretension_of, tides_of, ways_of
from .study import periods

KEYS = ("draft", "width", "angle_deg")
FEW_PERIODS, FEW_CELLS, FEW_WAYS = 10, 16, 4  # of a trial; what is reported has all
TRIALS = 20  # for a limit
OUT = 1e6


class Front(NamedTuple):
    """names : of what varies; designs : (n, names), in m and degrees; tension : (n,) greatest, N/m, ascending
    behind : (n,) 4√m₀ behind, m, or without a sea the greatest K_T, descending; trials : number of designs tried"""

    names: tuple
    designs: np.ndarray
    tension: np.ndarray
    behind: np.ndarray
    trials: int


def front(study):
    """The `Front` of a study with an OptimisationTable.  Raises StudyError where no design holds."""
    from scipy.stats import qmc

    asked = study.optimisation
    names = tuple(key for key in KEYS if getattr(asked, key) is not None)
    low, high = np.array([getattr(asked, key) for key in names], float).T
    tried = {}

    def trial(x):
        values = tuple(low + (high - low) * np.clip(x, 0, 1))
        if values not in tried:
            tried[values] = objectives(study, dict(zip(names, values, strict=True)), few=True)
        return tried[values]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # balance of Sobol's points; what trials warn of is told of those reported
        for x in qmc.Sobol(len(names), seed=0).random(asked.samples):
            trial(x)
        holding = {x: value for x, value in tried.items() if value is not None}
        if not holding:
            raise StudyError(f"optimisation: none of {asked.samples} designs holds its lines taut; give other ranges")
        _refine(trial, holding, low, high, asked.limits)
        kept = {x: value for x, value in tried.items() if value is not None}
        best = [x for x, value in kept.items() if not any(_better(other, value) for other in kept.values())]
        whole = [(x, objectives(study, dict(zip(names, x, strict=True)), few=False)) for x in best]
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


def _better(one, other):
    return one != other and one[0] <= other[0] and one[1] <= other[1]


def objectives(study, values, few):
    """(greatest tension, N/m; height behind, m, or K_T) of a study changed to `values`, None where it does not hold"""
    try:
        breakwater = Breakwater(changed(study, values))
        period = periods(study)
        if few:
            period = period[np.unique(np.linspace(0, len(period) - 1, FEW_PERIODS).round().astype(int))]
        tides = tides_of(breakwater, period)
        held = pretension_of(breakwater, tides)
        unstable = study.body is not None and any(breakwater.taut(one.rise).stiffness <= 0 for one in tides)
    except (StudyError, OutlineError):
        return None
    if held.slack or unstable or not np.isfinite(held.greatest).all():
        return None
    holding, theory = design(study)
    if study.sea is None:
        return max(held.greatest), float(
            abs(response(breakwater, holding, theory, 0.0, 2 * np.pi / period).transmission).max()
        )
    spectrum = spectrum_of("sea", study.sea, study.water.depth)
    sea = equal_cells(spectrum, FEW_CELLS if few else SEA_CELLS)
    ways = ways_of(study, spectrum, sea.omega, FEW_WAYS if few else WAYS)
    found = in_sea(breakwater, Curve(holding, theory, "mean", None), 0.0, sea.omega, study.waves.height / 2, ways)
    return max(held.greatest), 4 * float(sea.deviation(found.transmission))


def changed(study, values):
    """The study with another draft, width (m) or angle (degrees) of its lines, the body going with its section"""
    section, body, lines = study.section, study.body, study.lines
    across = "diameter" if section.shape == "circle" else "beam"
    draft = values.get("draft", section.draft)
    width = values.get("width", getattr(section, across))
    wider, deeper = width / getattr(section, across), draft / section.draft
    upright = wider if section.shape == "circle" else deeper
    sizes = {across: width, "draft": draft}
    if section.height is not None:
        sizes["height"] = section.height * deeper
    replace = msgspec.structs.replace
    lines = replace(
        lines, angle_deg=values.get("angle_deg", lines.angle_deg), attachment=lines.attachment * wider,
        attachment_height=lines.attachment_height * upright,
    )  # fmt: skip
    if body is not None:
        weights = {"free_draft": deeper, "mass_t_per_m": wider * deeper}
        given = {key: getattr(body, key) * by for key, by in weights.items() if getattr(body, key) is not None}
        given |= {"center_of_gravity": body.center_of_gravity * upright, "gyration": body.gyration * wider}
        body = replace(body, **given)
    return replace(study, section=replace(section, **sizes), body=body, lines=lines)
