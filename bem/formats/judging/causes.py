"""Cause of the difference between the results of another program and hakobune's solution of the same hull. Every
cause is tried, and the cause that fits is reported.

    corrected = cause(set),    best = argmin over causes of the largest of `gaps`(corrected)

A cause with a number (a length, a factor or a point) first fits this number to both solutions by least squares.  If no
single cause fits, all pairs of causes are tried. The report can thus name a unit and a point, or a sign and a unit.
"""

import itertools
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from ...kernels.progress import CAUSE, report_progress
from ...modes import reference_change
from ...waves import wavenumber
from .own_solution import gaps, sizes_of_forces

AGREED = 0.10  # largest difference, relative to the size of a row, that counts as agreement
MESH = 2.0  # the same for differences caused by panels
SHIFT = 0.02  # distance, relative to half the hull's size, above which two points count as different
FITS = 0.5  # largest remaining fraction of the difference for which a cause is accepted
CLEARLY = 0.3  # largest fraction of one cause's remainder that two causes may leave
DEPTHS = 1.1, 60.0  # times the draft, between which the depth of a set is sought
NEARLY = 0.03  # relative distance within which a factor is identified
FACTORS = {
    1e3: "kilo instead of the unit", 1e-3: "the unit instead of kilo", 2.0: "per metre of wave height", 0.5: "halved",
    9.80665: "the factor g", 1 / 9.80665: "without the factor g", 9806.65: "tonnes-force", 1e6: "mega",
    1 / 9806.65: "tonnes-force as N", 1e-6: "mega as the unit", 4.4482: "pounds-force", 4448.22: "kilopounds-force",
    1 / 4448.22: "kips as N", 1 / 4.4482: "pounds-force as N", 0.3048: "feet", 1 / 0.3048: "feet",
    1025.0: "the factor ρ", 1 / 1025.0: "without the factor ρ", 1025 * 9.80665: "the factor ρ g",
    1 / (1025 * 9.80665): "without the factor ρ g", 1.025 * 9.80665: "the factor ρ g in kN",
    np.pi / 180: "per degree", 180 / np.pi: "radians as degrees",
    14.5939: "slugs", 0.453592: "pounds", 1 / 0.453592: "pounds", 1 / 14.5939: "slugs", -1.0: "the opposite sign",
}  # fmt: skip
LENGTHS = (1e-3, 1e-2, 0.1, 0.3048, 1 / 0.3048, 10.0, 100.0, 1e3)
ROTATION = np.array([0, 0, 0, 1, 1, 1])
FORCES = ("excitation_force", "diffraction_force", "Froude_Krylov_force")
NOT_CORRECTED = ("rao", "drift_force", "drift_force_fixed")
MATRICES = ("added_mass", "radiation_damping", "added_mass_zero", "added_mass_infinity")


class Cause(NamedTuple):
    """text : description; correct : Values → Values; way_out : remedy besides `--correct`

    fitted : whether the cause has a fitted number that is no unit, sign or convention; such a cause corrects nothing
    """

    text: str
    correct: Callable
    way_out: str = ""
    fitted: bool = False


class Finding(NamedTuple):
    """gap : the largest difference, found in `quantity`; cause : the cause, or None
    left : difference that remains after correction for the cause, or for the best cause that was tried"""

    gap: float
    quantity: str
    cause: Cause | None
    left: float = np.inf
    nearest: str = ""


def finding(values, own):
    """`Finding` on a `sample` of Values against `Own`; None if the set agrees with hakobune's solution within `AGREED`

    Agreement is tested on flat panels with one node, as in most programs, and with four nodes, which is close to the
    limit of many panels.
    """
    flat, found = own, _finding(values, own)
    if found is not None and found.gap <= MESH:  # may be of panels
        off = f"{found.quantity.replace('_', ' ')} differs by {100 * found.gap:.3g} %"
        report_progress(
            CAUSE, f"{off} from our own solution on flat panels; it is solved again with four nodes on each"
        )
        sharp = _finding(values, own.sharper())
        if sharp is None or sharp.gap < found.gap:
            found, own = sharp, own.sharper()
    if found is None or (found.cause is not None and not found.cause.fitted and found.left <= AGREED):
        return found
    report_progress(CAUSE, "another depth is tried as the cause, at most 12, each solved at two frequencies")
    depth, left = _of_depth(values, flat)
    if _explains(left, found.gap) and (left <= AGREED or left < 0.8 * found.left):
        return found._replace(cause=depth, left=left)
    report_progress(CAUSE, "pairs of causes are tried")
    pair, left = _two(values, own)
    most = AGREED if found.cause is None else min(AGREED, CLEARLY * found.left)
    return found._replace(cause=pair, left=left) if left <= min(most, FITS * found.gap) else found


def _finding(values, own):
    off = gaps(values, own)
    quantity = max(off, key=off.get)
    if off[quantity] <= AGREED:
        return None
    best, left = None, np.inf
    for cause in _causes(values, own):
        now = max(gaps(cause.correct(values), own).values())
        if now < 0.8 * left or (best is None and now < left):  # a later cause must be clearly better
            best, left = cause, now
        if left < 0.2 * AGREED:
            break
    if left > AGREED and np.isfinite(values.water_depth):
        deep = max(gaps(values, own.in_water(np.inf)).values())
        if deep < 0.8 * left:
            text = f"the set is for deep water, not for a depth of {values.water_depth:g} m"
            best, left = Cause(text, lambda one: replace(one, water_depth=np.inf), "--depth inf"), deep
    if _explains(left, off[quantity]):
        return Finding(off[quantity], quantity, best, left)
    return Finding(off[quantity], quantity, None, left, best.text if best and left < FITS * off[quantity] else "")


def _explains(left, gap):
    return left <= FITS * gap and left <= 2.5 * AGREED


def _of_depth(values, own):
    """The depth of water in which our solution is nearest to the set, as a cause, and the remaining difference"""

    def left(log):
        return max(gaps(values, own.in_water(float(np.exp(log)))).values())

    best = minimize_scalar(
        left, bounds=np.log(np.multiply(DEPTHS, own.draft)), method="bounded", options={"xatol": 0.02, "maxiter": 12}
    )
    depth = float(np.exp(best.x))
    given = f"{values.water_depth:g} m" if np.isfinite(values.water_depth) else "deep water"
    text = f"the set fits a depth of about {depth:.3g} m, not {given}"
    way = f"--depth as in that solution (about {depth:.3g})"
    return Cause(text, lambda one: replace(one, water_depth=depth), way, fitted=True), float(best.fun)


def _two(values, own):
    """The best two causes in sequence, as one, and their remaining difference; the first must help by itself"""
    best, left, before = None, np.inf, gaps(values, own)
    groups = _about_units, _about_directions, _about_points  # water is no second cause: it would need its own solutions
    for one, other in itertools.product((*groups, _about_water), groups):
        for first in one(values, own):
            part = first.correct(values)
            after = gaps(part, own)
            if one is not _about_units and not any(after[name] < 0.8 * before[name] for name in before):
                continue
            for second in other(part, own):
                now = max(gaps(second.correct(part), own).values())
                if now < 0.8 * left:
                    best, left = (first, second), now
        if left < 0.2 * AGREED:
            break
    if best is None:
        return None, left
    first, second = best
    ways = [one.way_out for one in best]
    return Cause(f"two causes: {first.text}; and then {second.text}", lambda one: second.correct(first.correct(one)),
                 " and ".join(ways) if all(ways) else "", any(one.fitted for one in best)), left  # fmt: skip


def _causes(values, own):
    yield from _about_units(values, own)
    yield from _about_directions(values, own)
    yield from _about_points(values, own)
    yield from _about_water(values, own)


def corrected(values, cause):
    """Values corrected for a cause, without motions and drift, which depend on the correction"""
    kept = {name: data for name, data in values.quantities.items() if name not in NOT_CORRECTED}
    return cause.correct(replace(values, quantities=kept))


def changed(values, names, function):
    """Values with `function` applied to some of their quantities"""
    new = {name: function(data) for name, data in values.quantities.items() if name in names}
    return replace(values, quantities=values.quantities | new)


def scaled(values, names, factor, rows=None):
    """Values with the quantities `names` divided by a factor; row i of a quantity is divided by factor to the power
    rows[i]"""

    def over(data):
        size = factor if rows is None else float(factor) ** np.asarray(rows, float)
        if rows is not None and data.shape[-2:] == (6, 6) and not np.iscomplexobj(data):
            size = np.outer(size, size)
        return data / size

    return changed(values, names, over)


def _factor(pairs):
    """The real factor f that minimises Σ |file − f own|² / size² over pairs of (file, own, size)"""
    top = sum(float(np.sum((a * np.conj(b)).real / size**2)) for a, b, size in pairs)
    return _identified(top / sum(float(np.sum(np.abs(b) ** 2 / size**2)) for _, b, size in pairs))


def _identified(number, known=FACTORS):
    """The known number nearest to one within `NEARLY`, else the number itself"""
    nearest = min(known, key=lambda one: abs(number / one - 1))
    return nearest if abs(number / nearest - 1) < NEARLY else number


def _factors(pairs):
    """`_factor`, and the ratio of sizes, for different signs or phases"""
    file, own = (sum(float(np.sum(np.abs(three[i] / three[2]) ** 2)) for three in pairs) for i in (0, 1))
    signed, size = _factor(pairs), float(np.sqrt(file / own))
    return (signed,) if abs(abs(signed) - size) < NEARLY * size else (signed, size)


def _apart(numbers, known=FACTORS):
    """Those of numbers that differ from 1 and from each other by more than `NEARLY`, rounded to known ones"""
    kept = []
    for number in numbers:
        number = _identified(number, known)
        if number and all(abs(number / one - 1) > NEARLY for one in (1.0, *kept)):
            kept.append(number)
    return kept


def _said(factor):
    """Words on a factor, with another known one that panels cannot tell from it (g, and ρ g in kN)"""
    words = FACTORS.get(factor)
    near = [f"{one:.4g}, {FACTORS[one]}" for one in FACTORS if one != factor and abs(one / factor - 1) < NEARLY]
    other = f" (or {'; or '.join(near)})" if words and near else ""
    return f"{factor:.4g} times as large" + (f": {words}" if words else "") + other


def _owns(values, own):
    """A (n, 6, 6), B, X (n, m, 6) of our own solution, and sizes of rows that are finite"""
    parts = [own.at(omega, values.wave_direction) for omega in values.omega]
    return [np.array(part) for part in zip(*parts, strict=True)]


UNITS = {  # groups of quantities whose units can differ together
    "forces": ("excitation_force",),
    "added mass": ("added_mass",),
    "damping": ("radiation_damping",),
    "added mass and damping": ("added_mass", "radiation_damping"),
    "added mass, damping and forces": ("added_mass", "radiation_damping", "excitation_force"),
}
LIKE = {"excitation_force": FORCES, "added_mass": ("added_mass", "added_mass_zero", "added_mass_infinity")}


def _about_units(values, own):
    parts = _compared(values, own)
    straight = {name: [part[_straight(name)] for part in three] for name, three in parts.items()}
    yield from _about_length(straight)
    yield from _about_factors(straight)
    if "excitation_force" in parts:
        yield from _about_moments([part[..., 3:] for part in parts["excitation_force"]])
    if "radiation_damping" in values.quantities:
        for words, power in (("damping is that over ω", 1), ("damping is that times ω", -1)):
            yield Cause(
                words,
                lambda one, p=power: changed(one, ("radiation_damping",), lambda B: B * one.omega[:, None, None] ** p),
            )


def _straight(name):
    """Where translations stand in a quantity"""
    return (..., slice(0, 3)) if name == "excitation_force" else (..., slice(0, 3), slice(0, 3))


def _compared(values, own):
    """{name: (the file's, ours, sizes)} of the coefficients that both have"""
    A, B, X = _owns(values, own)
    sizes = {"added_mass": _sizes_of_matrices, "radiation_damping": _sizes_of_matrices, "excitation_force": _sizes_of_X}
    return {
        name: (values.quantities[name], true, np.broadcast_to(sizes[name](true, own), true.shape))
        for name, true in zip(sizes, (A, B, X), strict=True)
        if name in values.quantities and true.size
    }


def _sizes_of_matrices(true, own):
    d = np.where(own.moves, np.sqrt(np.abs(np.einsum("nii->ni", true)) + 1e-12), np.inf)
    return d[:, :, None] * d[:, None, :]


def _sizes_of_X(true, own):
    return np.array([sizes_of_forces(x, own) for x in true])[:, None, :]


def _about_factors(straight):
    """Causes by a factor of one kind of quantities, or of several together"""
    for words, names in UNITS.items():
        chosen = [straight[name] for name in names if name in straight]
        if len(chosen) < len(names):
            continue
        taken = tuple(one for name in names for one in LIKE.get(name, (name,)))
        factors = [factor for three in (chosen, *([one] for one in chosen)) for factor in _factors(three)]
        for factor in _apart(factors):
            yield Cause(
                f"{words} are {_said(factor)}",
                lambda one, n=taken, f=factor: scaled(one, n, f),
                fitted=factor not in FACTORS,
            )


def _about_moments(moments):
    for words, names in (("moments", FORCES), ("rows of rotations", FORCES + MATRICES)):
        for factor in (one for one in _apart(_factors([moments])) if one != -1):  # that is a sense of rotations
            yield Cause(
                f"{words} are {_said(factor)}",
                lambda one, n=names, f=factor: scaled(one, n, f, ROTATION),
                fitted=factor not in FACTORS,
            )


def _about_length(straight):
    """Causes by the length that makes results dimensionless, from forces, from both, and from added mass"""
    a = _factor([straight["added_mass"]]) if "added_mass" in straight else 1.0
    x = _factor([straight["excitation_force"]]) if "excitation_force" in straight else None
    lengths = ([np.sqrt(abs(x)), abs(a / x)] if x else []) + [abs(a) ** (1 / 3)]
    for length in _apart(lengths, LENGTHS):
        yield Cause(
            f"made dimensionless by a length of {1 / length:.4g} m, not by the assumed length",
            lambda one, L=length: of_length(one, L), f"--length-unit {1 / length:.4g}",
        )  # fmt: skip


def of_length(values, L):
    """Values in which each quantity is divided by L to the power of the length unit in WAMIT's normalisation"""
    matrix, force = L ** (3.0 + ROTATION + ROTATION[:, None]), L ** (2.0 + ROTATION)
    out = changed(values, MATRICES, lambda data: data / matrix)
    return changed(out, FORCES, lambda data: data / force)


def turned(values, words):
    """Values whose headings are "opposite", "mirrored" or both"""
    beta = values.wave_direction
    if "mirrored" in words:
        beta = -beta
    if "opposite" in words:
        beta = beta + np.pi
    return replace(values, wave_direction=beta)


def _about_directions(values, own):
    if "excitation_force" not in values.quantities or not values.quantities["excitation_force"].size:
        return
    conjugate = (
        "phases are the conjugates of ours: they have the other sign in the files than the format prescribes",
        np.conj,
    )
    phases = (("", None), conjugate, ("forces have the opposite sign, as if phase 0 were a wave trough", np.negative),
              ("phases are 90° behind ours", lambda X: X * 1j), ("phases are 90° ahead of ours", lambda X: X * -1j),
              ("phases are conjugates with the opposite sign", lambda X: -np.conj(X)))  # fmt: skip
    headings = {"": "", "opposite": "headings are the directions that waves come from; ours are the directions that "
                                    "waves travel to",
                "mirrored": "headings are counted clockwise, ours anticlockwise",
                "opposite mirrored": "headings are compass directions (clockwise) that waves come from"}  # fmt: skip
    for phase, change in phases:
        for words, text in headings.items():
            both = "; ".join(part for part in (phase, text) if part)
            if both:
                yield Cause(
                    both,
                    lambda one, w=words, c=change: turned(one if c is None else changed(one, FORCES, c), w),
                )
    for name, signs, words in (
        ("axes have z down and y to starboard", (1, -1, -1, 1, -1, -1), "mirrored"),
        ("axes have x aft and y to starboard", (-1, -1, 1, -1, -1, 1), "opposite"),
        ("axes have y to starboard with z up", (1, -1, 1, -1, 1, -1), "mirrored"),
        ("axes have x aft with y to port", (-1, 1, 1, 1, -1, -1), "opposite mirrored"),
        ("rotations have the opposite sign", (1, 1, 1, -1, -1, -1), ""),
        ("pitch has the opposite sign", (1, 1, 1, 1, -1, 1), ""),
        ("roll has the opposite sign", (1, 1, 1, -1, 1, 1), ""),
        ("heave has the opposite sign", (1, 1, -1, 1, 1, 1), ""),
        ("surge has the opposite sign", (-1, 1, 1, 1, 1, 1), ""),
        ("z is down", (1, 1, -1, -1, -1, 1), ""),
    ):
        S = np.array(signs, float)
        for both in (True, False):
            names = FORCES + MATRICES if both else FORCES
            if both or not words:
                yield Cause(
                    name + ("" if both else ", in forces alone"),
                    lambda one, n=names, s=S, w=words: turned(changed(one, n, lambda data: _signed(data, s)), w),
                )


def _signed(data, signs):
    return data * signs if np.iscomplexobj(data) else data * np.outer(signs, signs)


def _about_points(values, own):
    A, B, X = _owns(values, own)
    p = None
    if "excitation_force" in values.quantities and X.size:
        p = point_of_moments(values.quantities["excitation_force"], X)
    q = _point_of_coefficients(values, A, B)
    center = np.asarray(own.center)
    for r, names, words in (
        (p, FORCES + MATRICES, "moments and rotations are"), (q, FORCES + MATRICES, "moments and rotations are"),
        (p, FORCES, "moments of the wave forces, but not those of added mass, are"),
        (q, MATRICES, "rotations of added mass and damping, but not moments of the wave forces, are"),
    ):  # fmt: skip
        if r is not None and np.linalg.norm(r) > SHIFT * own.arm:
            r = -center if np.linalg.norm(center + r) < SHIFT * own.arm else r  # the origin itself
            said = ", ".join(f"{x:.4g}" for x in np.round(center + r, 3) + 0.0)
            way = f"--about {said.replace(' ', '')}" if names == FORCES + MATRICES else ""
            yield Cause(f"{words} about ({said}) m", lambda one, n=names, d=r: _moved(one, n, d), way)
    if "excitation_force" in values.quantities and X.size:
        r = _crest_at(values, X)
        if np.linalg.norm(r) < SHIFT * own.arm:
            return
        said = ", ".join(f"{x:.4g}" for x in np.round(r, 3) + 0.0)
        yield Cause(
            f"phase 0 is a crest at ({said}) m, not at the origin of the axes", lambda one: _crest_moved(one, r)
        )


def point_of_moments(file, true):
    """Arm r, m, from the reference point of moments here to that of the file, by least squares; shape (3,)

    file, true : forces of the file and forces here, (…, 6), whose moments satisfy M_file = M − r × F"""
    F, M = true[..., :3].reshape(-1, 3), (true - file)[..., 3:].reshape(-1, 3)
    zero = np.zeros(len(F))
    cross = np.stack([  # r × F = [F]ᵀ r, rows of the system
        np.stack([zero, F[:, 2], -F[:, 1]], 1), np.stack([-F[:, 2], zero, F[:, 0]], 1),
        np.stack([F[:, 1], -F[:, 0], zero], 1),
    ], axis=1).reshape(-1, 3)  # fmt: skip
    right = M.reshape(-1)
    cross, right = np.concatenate([cross.real, cross.imag]), np.concatenate([right.real, right.imag])
    return np.linalg.lstsq(cross, right, rcond=1e-3)[0]


def _point_of_coefficients(values, A, B):
    """`point_of_moments` by the effect of translations on moments in added mass and damping, each with its own size"""
    file, true = [], []
    for name, own in (("added_mass", A), ("radiation_damping", B)):
        size = np.linalg.norm(own[:, :3, :3])
        file.append(values.quantities[name][:, :3] / size)
        true.append(own[:, :3] / size)
    return point_of_moments(np.array(file), np.array(true))


def _moved(values, names, r):
    """Quantities about a point at r (3,) m from ours, converted to ours"""
    T = reference_change(-r)  # n about our point = T · n about the file's

    def move(data):
        return data @ T.T if np.iscomplexobj(data) else T @ data @ T.T

    return changed(values, names, move)


def _crest_at(values, X):
    """Point to which the phases refer, m: X_file = X exp(−ik·r), by least squares for the longest wave; shape (2,)"""
    n = int(np.argmin(values.omega))
    k = wavenumber(values.omega[n], values.water_depth, values.gravity)
    file, true = values.quantities["excitation_force"][n], X[n]
    size = np.abs(true).max(axis=0)
    size[:3], size[3:] = size[:3].max(), size[3:].max()
    product = np.sum(file * np.conj(true) / np.maximum(size, 1e-300) ** 2, axis=1)
    beta = values.wave_direction
    rows = k * np.stack([np.cos(beta), np.sin(beta)], axis=1)
    return -np.linalg.lstsq(rows, np.angle(product), rcond=1e-3)[0]


def _crest_moved(values, r):
    k = wavenumber(values.omega, values.water_depth, values.gravity)[:, None]
    beta = values.wave_direction[None, :]
    turn = np.exp(1j * k * (r[0] * np.cos(beta) + r[1] * np.sin(beta)))[..., None]
    return changed(values, FORCES, lambda X: X * turn)


def _about_water(values, own):
    for words, factor in (
        ("frequencies are in Hz, not rad/s", 2 * np.pi),
        ("frequencies are in rad/s and were read as Hz", 1 / (2 * np.pi)),
    ):  # fmt: skip
        yield Cause(words, lambda one, f=factor: replace(one, omega=one.omega * f))
    yield Cause("frequencies are periods", lambda one: _by_period(one))


def _by_period(values):
    """Values whose frequencies were periods in s"""
    omega = 2 * np.pi / values.omega
    order = np.argsort(omega)
    moved = {
        name: data[order] if name not in ("added_mass_zero", "added_mass_infinity") else data
        for name, data in values.quantities.items()
    }
    return replace(values, omega=omega[order], quantities=moved)
