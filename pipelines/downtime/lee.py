"""Wave height behind a floating breakwater in every hour: S_t = K_T² S_i, with one K_T for waves from all
directions.
"""

import numpy as np

from hakobune.mooring.downtime.every_hour import RING, Response

from ..breakwater.result import breakwater
from ..common.quantities import StudyError
from .limits import limits_of

BEHIND = "wave height behind"
PERIODS = 1.5, 40.0  # s, shortest and longest waves; beyond the study's periods K_T is that of its first or last
COUNT = 400


def lee(read, folder):
    """Limits, `every_hour.Response` and notes of a DowntimeStudy with [lee].  Raises StudyError."""
    for key in ("points", "keel", "turned_deg"):
        if getattr(read, key):
            raise StudyError(
                f"{key} is given together with [lee]; {key} needs a floating body, and [lee] has none; "
                f"leave out one of the two"
            )
    limits = limits_of(read, [], {BEHIND: "m"})
    found = breakwater(folder / read.lee.study)
    names, periods = list(found.labels["holding"].values), found.labels["period"].values
    wanted = read.lee.holding or _designed(found.detail.study, names)
    if wanted not in names:
        raise StudyError(f"lee.holding is {wanted!r}; allowed: {', '.join(names)}")
    order = np.argsort(2 * np.pi / periods)
    omega = np.geomspace(2 * np.pi / PERIODS[1], 2 * np.pi / PERIODS[0], COUNT)
    through = np.interp(omega, 2 * np.pi / periods[order], found["transmission"][order, names.index(wanted)])
    power = np.broadcast_to((2 * through)[:, None, None] ** 2, (COUNT, RING[0], 1))
    note = (
        f"behind {wanted} of {read.lee.study}: K_T for waves along its normal with periods of {periods.min():.3g} to "
        f"{periods.max():.3g} s, constant outside that range and used for all wave directions; {BEHIND} is "
        "twice the crest height, for the significant wave or the mean largest wave of an hour"
    )
    return limits, Response((BEHIND,), ("m",), omega, power), [note]


def _designed(study, names):
    """The name of the curve for which the breakwater is designed"""
    wanted = study.design.holding
    return next((name for name in names if wanted and wanted in name and study.design.theory in name),
                next((name for name in names if wanted and name.startswith(wanted)), names[-1]))  # fmt: skip
