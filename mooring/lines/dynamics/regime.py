"""Regime of the simplified method in which a line moves, for lines to which the method applies."""

import numpy as np

from ..regimes import harmonic_tension


def regime_of(line, fairlead, displacement, period):
    """`HarmonicTension` of a DynamicLine whose fairlead moves harmonically, or a text with the reason for none.

    fairlead : mean position (3,) m; displacement : outermost displacement from the mean (3,) m; period : s.
    SR179 report (1982), section 3.2.1
    """
    if len(line.segments) > 1:
        return "the simplified method is for a uniform line without bodies"
    segment = line.segments[0]
    if len(segment.elongation) > 1:
        return "the simplified method is for a line of one axial stiffness"
    if line.bed is None or line.bed.slope != 0 or line.bed.points or line.bed.below > 0:
        return "the simplified method is for a line whose anchor lies on a flat bed"
    away = np.asarray(fairlead, float) - np.array(line.anchor)
    span = float(np.hypot(*away[:2]))
    outward = away[:2] / span if span > 0 else np.array([1.0, 0.0])
    try:
        return harmonic_tension(
            span,
            float(away[2]),
            segment.length,
            segment.weight,
            segment.mass,
            segment.diameter,
            (float(displacement[:2] @ outward), float(displacement[2])),
            period,
            axial_stiffness=segment.stiffness,
            drag=segment.drag_normal,
            added_mass=segment.added_normal,
            density=line.density,
            gravity=line.gravity,
        )
    except ValueError as error:
        return str(error)
