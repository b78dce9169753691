"""Report on forces of wave pairs: size of each part, deviation of Newman's approximation, errors."""

import math

import numpy as np

from hakobune.bem.panels.pressure_drift.hull_interpolation import twisted_panels
from hakobune.bem.second_order.kinds import SUM
from hakobune.bem.second_order.stored import APART, USABLE, diagonal_gap, failed_gap
from hakobune.bem.waves import wavenumber
from hakobune.mooring.criteria.failing import fails

from .question import A_WAVE, carried_by

MODES = [0, 1, 5]
MORE = "the difference falls with more panels"
MORE_OF_TWISTED = (
    "flow at the pointed ends and on the twisted panels of this hull is uncertain, and more panels may not lower the "
    "difference"
)


def newman(forces, mode, heading):
    """Signed √(DᵢDⱼ) of the diagonal of the squares, NaN without a pair; shape (d, n)"""
    D = forces.squares[0, :, heading, heading, mode].real
    out = np.full((len(forces.frequency), len(D)), np.nan)
    for m in range(len(forces.frequency)):
        one, two = D[m:], D[: len(D) - m]
        out[m, : len(two)] = np.where(one * two > 0, np.sign(one) * np.sqrt(np.abs(one * two)), 0.0)
    return out


def failures(stored, db=None):
    """Failures of `StoredForces`: a mean drift by pressure that differs from the mean drift by the far field

    db : its open database, whose panels may be too large for the waves; None for no message on them
    """
    failed = failed_gap(stored.forces)
    if failed is not None:
        words, gap = failed
        remedy = _smaller_panels(stored.forces, db)
        if remedy == MORE and db is not None:
            most = math.ceil(db.mesh.total * gap / APART - 1e-9)
            remedy += f", at best as one over their number: {most} or more for the limit"
        used = "uses these pairs with a warning" if gap <= USABLE else "leaves these pairs out"
        yield fails(f'{words}; {remedy}; qtf = "auto" {used}, and qtf = "bound-wave" needs none')


def _smaller_panels(forces, db):
    """The remedy: panels that resolve the waves, or longer waves"""
    size, most = (np.inf, np.inf) if db is None else (float(db.mesh.sizes.max()), _carried(db))
    if most >= forces.omega[-1]:
        twisted = db is not None and twisted_panels(db.mesh).any()
        return MORE_OF_TWISTED if twisted else MORE
    length = 2 * np.pi / wavenumber(float(forces.omega[-1]), db.water_depth, db.gravity)
    within = "in the mesh, and import it (--mesh)" if "imported" in getattr(db, "attributes", ()) else "in the scene"
    return (
        f"the shortest waves are {length:.3g} m long ({forces.omega[-1]:.3g} rad/s), and panels are up to {size:.3g} "
        f"m; only waves up to {most:.3g} rad/s have {A_WAVE:g} panels to a wave length; use smaller panels {within}, "
        f"or --omega up to that frequency"
    )


def _carried(db):
    return carried_by(db.mesh, db.water_depth, db.gravity)


def notes(stored):
    """Lines of text about `StoredForces`, in addition to their table"""
    forces, share = stored.forces, stored.share
    bodies = "body" if len(stored.names) == 6 else "bodies"
    yield (
        f"{_held(stored.held)} {bodies}, {len(forces.omega)} frequencies {forces.omega[0]:.4g} to "
        f"{forces.omega[-1]:.4g} rad/s, {forces.kind.name}s to {forces.frequency[-1]:.3g} rad/s, "
        + _headings(len(forces.headings))
    )
    if forces.kind is SUM:
        yield from _of_sums(stored)
        return
    gap = diagonal_gap(forces)
    if gap is not None:
        yield (
            "the diagonal is the mean drift by the far field; the drift by pressure differs from it by "
            f"{100 * gap:.3g} % of the largest"
        )
    if failed_gap(forces) is not None:
        yield "there is no estimated error, since the mean drift by pressure fails its check"
    elif stored.errors is None:
        yield "there is no estimated error, since there is no mesh with half as many panels"
    else:
        shares = _relative(stored)
        yield f"estimated error of the {_way(stored)}, over the root mean square of the force: {shares}"
    size = "unknown" if share is None else f"{100 * share:.3g} % of the force in surge and sway"
    if len(stored.names) > 6:
        yield "left out: the free-surface forcing around the bodies; --level full includes it for a single body only"
    elif forces.surface is None and share is None:
        yield (
            "left out: the free-surface forcing around the body, of unknown size: it needs one closed waterline, so "
            "no level includes it here"
        )
    elif forces.surface is None:
        yield (
            f"left out: the free-surface forcing around the body (its size, estimated from few pairs: {size}); "
            f"--level full includes it"
        )
    else:
        yield f"the free-surface forcing around the body is {size}, root mean square"


def _headings(count):
    return "1 heading" if count == 1 else f"{count} headings and all their pairs"


def _of_sums(stored):
    """Lines about forces at sums of frequencies"""
    forces = stored.forces
    if stored.errors is None:
        yield "there is no estimated error, since there is no mesh with half as many panels"
    else:
        each = np.arange(len(forces.headings))
        parts = (np.abs(part[:, :, each, each]) ** 2 for part in (stored.errors, forces.total))
        error, force = (np.sqrt(np.nanmean(part, axis=(0, 1, 2))) for part in parts)
        each_body = force.reshape(-1, 2, 3).max(axis=2)
        named = zip(stored.words, error, np.repeat(each_body.ravel(), 3), strict=True)
        shares = (f"{name} {100 * e / s:.3g} %" for name, e, s in named if e > 1e-6 * s)
        yield f"estimated error of the {_way(stored)}, of the largest force and moment: {', '.join(shares)}"
    if forces.surface is None:
        yield (
            "left out: the free-surface forcing around the body, a large part of sum-frequency forces; "
            "--level full includes it"
        )


def parts_of_sums(forces, mode, heading):
    """{name: (d, n)} T at sum frequencies with each additional part, for one heading"""
    names = [("squares", "squares"), ("+ bound wave", "bound_wave"), ("+ body", "body"), ("+ surface", "surface")]
    found = {name: getattr(forces, part) for name, part in names if getattr(forces, part) is not None}
    sums = np.cumsum([value[:, :, heading, heading, mode] for value in found.values()], axis=0)
    return dict(zip(found, sums, strict=True))


def _way(stored):
    return "contour method" if stored.method == "contour" else "panels"


def _relative(stored):
    """Root mean square of errors over that of the forces in equal headings, per cent of the larger of surge and sway"""
    forces, words = stored.forces, stored.words
    each, found = np.arange(len(forces.headings)), []
    parts = [np.abs(part[:, :, each, each]) ** 2 for part in (stored.errors, forces.total)]
    error, force = (np.sqrt(np.nanmean(part, axis=(0, 1, 2))) for part in parts)
    for first in range(0, len(words), 6):
        largest = max(force[first : first + 2])
        for mode, whole in zip(MODES, (largest, largest, force[first + 5]), strict=True):
            if force[first + mode] > 1e-6 * largest:
                found.append(f"{words[first + mode]} {100 * error[first + mode] / whole:.3g} %")
    return ", ".join(found)


def _held(held):
    if held.name:
        return f"moored ({held.name})"
    return "floating" if held.floats else "fixed"


def levels(forces, mode, heading):
    """{name: (d, n)} T by each level, for one heading"""
    rule = newman(forces, mode, heading)
    bound, squares, body = (
        getattr(forces, part)[:, :, heading, heading, mode] for part in ("bound_wave", "squares", "body")
    )
    out = {
        "Newman": rule,
        "Newman + bound wave": rule + bound,
        "squares + bound wave": squares + bound,
        "+ body": squares + bound + body,
    }
    if forces.surface is not None:
        out["+ surface"] = out["+ body"] + forces.surface[:, :, heading, heading, mode]
    return out
