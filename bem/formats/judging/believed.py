"""Faults of an imported set, found by hakobune's solution of the hull, or by laws between the numbers of the set."""

from ..values import FormatError
from . import laws
from .causes import AGREED, corrected, finding
from .own_solution import MOST_PANELS, own_of, sample

WAY_OUT = "import with --correct to store the set so corrected"


def believed(values, mesh, correct=False):
    """Values, messages on agreement, and messages on uncorrected contradictions.

    correct : whether to correct a recognised error of the files, such as a wrong unit or reference point
    raises : FormatError naming a recognised error, unless it is corrected
    """
    doubts, tested = laws.doubts(values)
    own = own_of(values, mesh)
    if own is None:
        why = "no frequency belongs to a long wave"
        if len(mesh) > MOST_PANELS:
            why = f"the hull has {len(mesh)} panels, and this check solves at most {MOST_PANELS}"
        if values.others:
            why = "there are other bodies beside it"
        return values, [f"not compared with our own solution: {why}; laws tested: {', '.join(tested)}"], doubts
    found = finding(sample(values, mesh), own)
    if found is None:
        return values, [], doubts
    named = found.quantity.replace("_", " ")
    off = f"{named} differs from our own solution of the hull by {100 * found.gap:.3g} %, allowed: {100 * AGREED:g} %"
    if found.cause is None:
        near = f"; the best guess, {found.nearest}, leaves {100 * found.left:.3g} %" if found.nearest else ""
        return (
            values,
            [],
            [f"{off}; no change of unit, point, sign or heading explains it, nor do two{near}", *doubts],
        )
    if not correct:
        way = f"give {found.cause.way_out}, or {WAY_OUT}" if found.cause.way_out else WAY_OUT
        raise FormatError(f"{off}: {found.cause.text}; {way}")
    return (
        corrected(values, found.cause),
        [f"corrected: {found.cause.text}; motions and drift of the files are left out"],
        [],
    )
