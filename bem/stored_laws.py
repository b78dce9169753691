"""Laws that the stored numbers of a database must obey.

With Z = A + iB/ω, relative to √|Zᵢᵢ Zⱼⱼ|, for every frequency separately:

    Z = Zᵀ;  B ≥ 0;  B/ω = (4ρg n/(kω)²) (1/2π) ∫ Re HᵢH̄ⱼ dθ;  F = F_FK + F_D;  (1/2π) ∫ |H_D|² dθ = −Re H_D(β)
    {−ω²[M + A] − iωB + C} X = F;  mean drift of H_D and of H_D + Σ XⱼHⱼ

The signs are those of `bem.kochin`, `bem.motions` and `bem.drift`.  A number that is doubled, or stored at a wrong
frequency, violates one of the laws.
"""

from typing import NamedTuple

import numpy as np

from .checks import damping_scale
from .drift import OF_EACH, about, energy_defect, mean_drift, sum_about_origin
from .modes import displacing, moving, names_of, turning
from .waves import group_factor

OF_MOTIONS = "motions obey their equation"  # name of this law
ROUNDING = 1e-6  # tolerance of laws that the computation of the numbers uses
SUM = 0.1  # tolerance of drift by pressure, whose error is of first order in that of potentials, motions and waves
SUMS = " is the sum over the bodies"
PRINTED = 1e-4  # the same for files of other programs with seven digits, whose rounding a resonance magnifies


class Broken(NamedTuple):
    """A law that stored numbers violate: its largest relative violation, the frequency of this violation, rad/s, and
    the limit"""

    law: str
    worst: float
    omega: float
    limit: float


def broken_laws(db, tolerance):
    """[Broken] of a `bem.database.Database`.

    tolerance : allowed relative violation; checks stored with a frequency replace this limit where they are larger
    """
    stored = np.array(list(db.checks().values()))
    allowed = 1.01 * np.fmax(tolerance, np.fmax.reduce(np.vstack([stored, np.zeros((1, len(db.omega)))])))
    return _violated(db, _laws(db, PRINTED if "imported" in db.attributes else ROUNDING), allowed)


def _violated(db, laws, allowed):
    """[Broken] of laws as in `_laws`; allowed : (n,) limits of laws without one"""
    found = []
    for law, values, limit in laws:
        limit = allowed if limit is None else np.full(len(db.omega), limit)
        over = np.nan_to_num(values, nan=0.0, posinf=np.inf) / limit if len(values) else np.zeros(0)
        if np.any(over > 1):
            i = int(np.argmax(over))
            found.append(Broken(law, float(values[i]), float(db.omega[i]), float(limit[i])))
    return found


def reciprocity_defects(db):
    """Largest |Z − Zᵀ| / √|Zᵢᵢ Zⱼⱼ| at each frequency of a database with added mass and damping; shape (n,)"""
    return next(values for law, values, _ in _radiation_laws(db, set()) if law == "reciprocity")


def damping_errors(db):
    """Largest estimated error of stored damping over the size of damping, `bem.checks.damping_scale`; shape (n,); NaN
    without estimated errors"""
    relative = _relative_to_damping(db)
    if relative is None:
        return np.full(len(db.omega), np.nan)
    relative = relative.reshape(len(relative), -1)
    return np.where(np.isnan(relative).all(axis=1), np.nan, np.nan_to_num(relative).max(axis=1, initial=0.0))


def worst_damping(db):
    """Names (force, motion) of the damping coefficient whose error is the largest of `damping_errors`"""
    relative, names = np.nan_to_num(_relative_to_damping(db)), names_of(db.bodies, db.modes)
    own = moving(db.bodies, db.modes)
    _, i, j = np.unravel_index(relative.argmax(), relative.shape)
    return names[own[i]], names[own[j]]


def _relative_to_damping(db):
    """Estimated error of stored damping over its size; shape (n, forces, motions); None without estimates"""
    error = db.estimated_errors().get("radiation_damping")
    if error is None:
        return None
    omega = db.omega[:, None, None]
    own = moving(db.bodies, db.modes)
    A = np.nan_to_num(db["added_mass"][:, own]) if "added_mass" in db.names else 0.0
    Z = A + 1j * np.nan_to_num(db["radiation_damping"][:, own]) / omega
    return error[:, own] / omega / damping_scale(Z, displacing(db.mesh, db.modes)[own])


def _laws(db, rounding):
    """Return (law, relative violations (n,), limit or None for that of the stored checks) of the available
    quantities"""
    there = set(db.names)
    if {"added_mass", "radiation_damping"} <= there:
        yield from _radiation_laws(db, there)
    forces = ("Froude_Krylov_force", "diffraction_force", "excitation_force")
    if there >= set(forces):
        incident, scattered, total = (db[name] for name in forces)
        gap = np.abs(incident + scattered - total) / _largest(db, total, incident)
        yield "excitation is incident and scattered", _worst(gap), rounding
    motions = {"rao", "added_mass", "radiation_damping", "excitation_force"} <= there and db.inertia_matrix is not None
    if motions and not db.has_viscous_motions:
        yield OF_MOTIONS, _motion_defect(db), rounding
    if "kochin_diffraction" in there:
        yield from _far_field_laws(db, there)
    yield from _drift_laws(db, there)


def unequal_drift(db):
    """[Broken] of drift: the sum over the bodies of the drift by pressure must equal the drift by the far field"""
    return _violated(db, _drift_laws(db, set(db.names)), None)


def _drift_laws(db, there):
    for each, whole in zip(OF_EACH, ("drift_force_fixed", "drift_force"), strict=True):
        if {each, whole} <= there and not db.has_damping_lids:  # damping lids change the drift of the far field
            yield whole + SUMS, _sum_defect(db, db[each], db[whole]), SUM


def _radiation_laws(db, there):
    own = moving(db.bodies, db.modes)
    A, B, omega = db["added_mass"][:, own], db["radiation_damping"][:, own], db.omega[:, None, None]
    Z = A + 1j * B / omega
    size = np.sqrt(np.abs(np.einsum("nii->ni", Z)))
    for part in _kinds(db, own):
        floor = 1e-4 * np.nanmax(size[:, part], axis=1, initial=0.0)
        size[:, part] = np.where(size[:, part] > floor[:, None], size[:, part], np.inf)
    scale = size[:, :, None] * size[:, None, :]
    yield "reciprocity", _worst(np.abs(Z - Z.transpose(0, 2, 1)) / scale), None
    done = np.nan_to_num((B / omega + (B / omega).transpose(0, 2, 1)) / 2 / scale)
    yield "damping takes energy out", -np.linalg.eigvalsh(done)[:, 0], None
    if "kochin_radiation" in there:
        H, k = db["kochin_radiation"], db["wavenumber"]
        factor = 4 * db.density * db.gravity * group_factor(k, db.water_depth) / (k * db.omega) ** 2
        far = factor[:, None, None] * np.einsum("nit,njt->nij", H, H.conj()).real / H.shape[-1]
        left = (B / omega - far) / scale
        if db.has_damping_lids:
            yield (
                "radiated energy, less than all",
                -np.linalg.eigvalsh((left + left.transpose(0, 2, 1)) / 2)[:, 0],
                None,
            )
        else:
            yield "radiated energy", _worst(np.abs(left)), None


def _motion_defect(db):
    from .motions import response

    out, own = [], moving(db.bodies, db.modes)
    extra = 0.0 if db.structural_damping is None else db.structural_damping
    terms = zip(db.omega, db["added_mass"], db["radiation_damping"], db["excitation_force"], db["rao"], strict=True)
    for omega, A, B, F, X in terms:
        if not all(np.all(np.isfinite(part)) for part in (A, B, F, X)):
            out.append(np.nan)
            continue
        right = response(omega, A[own], (B + extra)[own], F[:, own], db.inertia_matrix[own], db.stiffness[own])
        size = np.maximum(np.abs(right), np.abs(X))
        for part in _kinds(db, own):
            size[:, part] = size[:, part].max()
        out.append(float(np.max(np.abs(right - X) / np.maximum(size, 1e-300))))
    return np.array(out)


def _far_field_laws(db, there):
    H, k, beta = db["kochin_diffraction"], db["wavenumber"], db.wave_direction
    theta = db["theta"]
    forward = np.einsum("nmt,mt->nm", H, _trigonometric(theta, beta))
    gained = np.array([energy_defect(h, f) for h, f in zip(H, forward, strict=True)])
    if db.has_damping_lids:
        yield "scattered energy, less than all", np.maximum(gained, 0.0).max(axis=-1), None
    else:
        yield "scattered energy", np.abs(gained).max(axis=-1), None
    if "drift_force_fixed" in there:
        yield "drift of the fixed body", _drift_defect(db, H, k, db["drift_force_fixed"]), None
    if {"drift_force", "rao", "kochin_radiation"} <= there:
        total = H + np.einsum("nmj,njt->nmt", db["rao"], db["kochin_radiation"])
        yield "drift of the free body", _drift_defect(db, total, k, db["drift_force"]), None


def _drift_defect(db, H, k, stored):
    """Relative to the largest force and moment; moments count at least as that of a force at one wave length / 2π"""
    theta, beta = db["theta"], db.wave_direction
    turn = np.fft.fftfreq(len(theta), 1 / len(theta))
    turn[np.abs(turn) == len(theta) / 2] = 0.0
    slope = np.fft.ifft(1j * turn * np.fft.fft(H, axis=-1), axis=-1)
    at = _trigonometric(theta, beta)
    out = []
    for i, water in enumerate(group_factor(k, db.water_depth)):
        ahead = (np.einsum("mt,mt->m", part[i], at) for part in (H, slope))
        force = mean_drift(H[i], slope[i], *ahead, theta, beta, k[i], water, db.density, db.gravity)
        gap = np.abs(about(force, db.rotation_center) - stored[i])
        size = np.abs(stored[i]).max(axis=0)
        level = db.density * db.gravity * water * np.max(np.mean(np.abs(H[i]) ** 2, axis=-1)) / k[i]
        push = max(size[:2].max(), level)
        out.append(float((gap / np.maximum([push, push, push / k[i]], size)).max()))
    return np.array(out)


def _sum_defect(db, each, whole):
    """Difference of all bodies' horizontal drift by pressure from that of the far field, over the largest force; shape
    (n,)"""
    gap = np.abs(sum_about_origin(each, db.bodies) - whole)[..., :2]
    size = np.maximum(np.abs(each[..., :2]).max(axis=2), np.abs(whole[..., :2])).max(axis=(1, 2))
    return gap.max(axis=(1, 2)) / np.maximum(size, 1e-300)


def _trigonometric(theta, beta):
    """Weights with which values at equally spaced theta give those at beta; shape (m, t)"""
    count = len(theta)
    turns = np.arange(-((count - 1) // 2), (count - 1) // 2 + 1)
    return np.exp(1j * turns * (beta[:, None, None] - theta[:, None])).sum(axis=-1).real / count


def _largest(db, *values):
    """Largest force and moment; shape (n, 1, 1 or 6); for several bodies (n, 1, 6N)"""
    size = np.max([np.nan_to_num(np.abs(value)) for value in values], axis=0).max(axis=1, keepdims=True)
    for part in _kinds(db, range(size.shape[-1])):
        size[..., part] = size[..., part].max(axis=-1, keepdims=True)
    return np.maximum(size, 1e-300)


def _kinds(db, own):
    """Masks of forces and of moments among the modes `own`"""
    turns = turning(db.bodies, db.modes)[own]
    return ~turns, turns


def _worst(values):
    return np.nan_to_num(values).reshape(len(values), -1).max(axis=1, initial=0.0)
