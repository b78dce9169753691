"""Faults of an imported set of results, found by hakobune's solution of the hull or by laws between the results."""

from ..values import FormatError
from . import laws
from .causes import AGREED, corrected, finding
from .own_solution import MOST_PANELS, own_of, sample

WAY_OUT = "import with --correct to store the set so corrected"


def believed(values, mesh, correct=False):
    """The Values, messages on agreement, and messages on contradictions that are not corrected.

    correct : whether to correct a recognised error of the files, such as a wrong unit or reference point. A fitted
        factor or depth that is no unit, sign or convention is never applied
    raises : FormatError that names a recognised error which is not corrected
    """
    doubts, tested = laws.doubts(values)
    own = own_of(values, mesh)
    if own is None:
        why = "no frequency belongs to a long wave"
        if len(mesh) > MOST_PANELS:
            why = f"the hull has {len(mesh)} panels, and this check solves at most {MOST_PANELS}"
        if values.others:
            why = "there are other bodies beside it"
        return (
            values,
            [f"the files are not compared with our own solution: {why}; laws tested: {', '.join(tested)}"],
            doubts,
        )
    found = finding(sample(values, mesh), own)
    if found is None:
        return values, [], doubts
    named = found.quantity.replace("_", " ")
    off = f"{named} differs from our own solution of the hull by {100 * found.gap:.3g} %, allowed: {100 * AGREED:g} %"
    cause = found.cause
    if cause is None or (cause.fitted and not cause.way_out):
        near = found.nearest if cause is None else f"{cause.text}, which is no unit and no convention"
        near = f"; the best guess, {near}, leaves {100 * found.left:.3g} %" if near else ""
        return (
            values,
            [],
            [
                f"{off}; no change of unit, point, sign, heading or depth explains it, and no pair of such changes "
                f"does{near}",
                *doubts,
            ],
        )
    if cause.fitted:
        raise FormatError(f"{off}: {cause.text}; give {cause.way_out}")
    if not correct:
        way = f"give {cause.way_out}, or {WAY_OUT}" if cause.way_out else WAY_OUT
        raise FormatError(f"{off}: {cause.text}; {way}")
    return (
        corrected(values, cause),
        [f"the files are corrected: {cause.text}; their motions and drift are left out"],
        [],
    )
