"""Checks of a whole single-point study before the computation, with the properties of its body known by then."""

import msgspec

from ..common.weather.seas import sea_with_swell
from ..moor.checked import check_headings
from .running import check
from .study import check_database, make
from .tables import MassTable


def checked(study, body=None):
    """Raises StudyError for a Study that no run supports

    body : `moor.checked.Body` of its database or scene, None if the study names none
    """
    known, is_round = study, body is not None and body.ring is not None and body.ring.is_round
    if body is not None:
        check_database(study, body)
        if study.mass is None:  # with a database the mass of the body follows from its waves
            hull = msgspec.structs.replace(study.hull, center=float(body.rotation_center[0]))
            known = msgspec.structs.replace(study, mass=MassTable(0.0, 0.0, 0.0), hull=hull)
        if study.waves is not None and study.waves.drift_tonf_per_m2 is None:
            check_headings(body, [sea_with_swell("waves", study.waves, study.water.depth)])
            known = msgspec.structs.replace(known, waves=None)
    make(known, is_round=is_round)
    if study.slewing is not None:
        check(study, body)
