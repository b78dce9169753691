"""Laws that the numbers of a result set obey, checked without the hull.

    Z = Zᵀ,  B ≥ 0,  ω²A₃₃ ≪ C₃₃ in long waves                             reciprocity, energy, waterplane
    B_ii = k/(8π ρ g C_g) ∫₀²π |X_i(β)|² dβ                                            Haskind and Newman
    X₃ → C₃₃ − ω²(A₃₃ + ρV),   X₁ → −i k g (A₁₁ + ρV) cosβ / tanh kh · tanh kh         of a wave longer than the body
    A(ω) − A(∞) = (2/π) ⨍ B(s)/(s² − ω²) ds                                            causality

The second row needs headings over the full circle, or from 0 to 180° or 90° for a body whose added mass is symmetric.
Otherwise heave and surge in long waves replace the second row: |X₃| is equal for all headings, and X₁ is proportional
to cosβ.
Surge shows a wrong sign. Conjugate numbers reverse the sign of X₁ and that of the imaginary part of X₃, −ωB₃₃;
opposite headings reverse the sign of X₁ alone.
"""

from dataclasses import replace

import numpy as np

from ...database.schema import QUANTITIES
from ...waves import group_factor, wavenumber

NOT_SYMMETRIC = 0.1  # largest asymmetry, over √(AᵢᵢAⱼⱼ)
LONG = 0.35  # k times the size of the body, of a long wave
SHORT = 6.0  # the same for short waves with negligible damping
TRUE = 0.25  # largest deviation of the ratio of a law from 1; allows for few headings and coarse panels
CAUSAL = 0.4  # the same for causality, whose integral is cut at the highest frequency
# deviation from the median of five neighbours, relative to the range of added mass, that marks a peak or an irregular
# frequency
PEAKED = 0.1
PEAK = 6  # frequencies above a quarter of the largest damping, without which its peak is not resolved
STEEP = 0.85  # power of ω above which a ratio counts as proportional to a power of it
DEPTH_FITS = 0.04  # largest deviation of ratios from 1 at the right depth
FLOATS = 0.01  # least heave stiffness of a floating body, over ρ g times its size squared
FEW = 2  # least number of frequencies for a ratio
NOISE = 0.02  # negative damping up to this fraction of ω A is tolerated
OFTEN = 0.1  # fraction of frequencies that violate a law; fewer count as irregular frequencies
SCATTERS = 0.5  # relative spread of a ratio between its 10 % and 90 % quantiles
FAINT = 1e-3  # damping below this fraction of the largest is rounding
DECKED = 0.4  # least −ω²A₃₃/C₃₃ in long waves of a hull that panels close at the surface; else near 0
CANCELS = 0.1  # moment, over force times body length, below which it is a small difference of large terms
ROUNDS = 1e-4  # of the largest inertia and damping of forces, or of moments: less moves no water
EVEN = 1e-3  # terms below this fraction of the largest diagonal vanish by symmetry
SURGE, SWAY, HEAVE = 0, 1, 2


def doubts(values):
    """Messages on the laws that the Values violate, and names of the laws that could be tested"""
    values, (found, tested) = _finite(values), ([], [])
    if not len(values.omega):
        return [], []
    for name, law in LAWS.items():
        answer = law(values)
        if answer is not None:
            tested.append(name)
            found += [f"{name}: {line}" for line in answer]
    return found, tested


def _finite(values):
    """Values at the frequencies at which all are finite"""
    names = [name for name in values.quantities if "omega" in QUANTITIES[name][0]]
    good = np.all([np.isfinite(values.quantities[n].reshape(len(values.omega), -1)).all(axis=1) for n in names], axis=0)
    return values if good.all() else replace(
        values, omega=values.omega[good],
        quantities={n: data[good] if n in names else data for n, data in values.quantities.items()},
    )  # fmt: skip


def size_of(values):
    """Length of the body, m: the length of the waterplane or, if larger, twice the arm of added mass in yaw. If both
    are unknown, the length follows from A₃₃"""
    C, A = values.get("hydrostatic_stiffness"), values.get("added_mass")
    plane = 0.0
    if C is not None and C[2, 2] > 0:
        plane = float(np.sqrt(C[2, 2] / (values.density * values.gravity)))
    sway, yaw = (float(np.abs(A[:, i, i]).max()) for i in (SWAY, 5))
    plane = max(plane, 2 * np.sqrt(yaw / sway) if sway else 0.0)
    side = np.median(np.abs(A[:, (SURGE, SWAY), (SURGE, SWAY)]), axis=0).max() / values.density
    return max(plane, float(side) ** (1 / 3)) or float((np.abs(A[:, 2, 2]).max() / values.density) ** (1 / 3)) or 1.0


def _waves(values):
    k = wavenumber(values.omega, values.water_depth, values.gravity)
    return k, k * size_of(values)


def _reciprocity(values):
    A, lines = values.get("added_mass"), []
    d = np.abs(np.einsum("nii->ni", A)).max(axis=0)
    d[:3], d[3:] = np.maximum(d[:3], 0.01 * d[:3].max()), np.maximum(d[3:], 0.01 * d[3:].max())
    off = np.abs(A - A.swapaxes(1, 2)) / np.sqrt(np.outer(d, d))
    worst = np.median(off, axis=0)
    if worst.max() > NOT_SYMMETRIC:
        i, j = np.unravel_index(np.argmax(worst), worst.shape)
        lines.append(
            f"A_{i + 1}{j + 1} and A_{j + 1}{i + 1} differ by {100 * worst[i, j]:.0f} % of their size; either "
            "rotations and translations have different units or points, or there are too few panels"
        )
    return lines


def _energy(values):
    B, A = (np.einsum("nii->ni", values.get(name)) for name in ("radiation_damping", "added_mass"))
    floor = NOISE * values.omega[:, None] * np.abs(A)
    below, above = (np.mean(part > 0, axis=0) for part in (-B - floor, B - floor))
    most = int(np.argmax(below))
    if below[most] > OFTEN and not (above > OFTEN).any():  # a sign is that of all modes and frequencies
        return [f"B_{most + 1}{most + 1} is below 0: damping has the opposite sign"]
    if not below[most] > OFTEN or _deck(values):  # a deck gives energy too, and is told by its own law
        return []
    return [
        f"B_{most + 1}{most + 1} is below 0 by more than {100 * NOISE:g} % of ωA at {100 * below[most]:.0f} % of the "
        "frequencies: the body gives energy to the water, as with an open hull, walls inside it or too few panels"
    ]


def _circle(values):
    """Weights (m,) of ∫ dβ of squares over all directions; None where the headings do not cover them"""
    beta = np.mod(values.wave_direction, 2 * np.pi)
    A = np.abs(values.get("added_mass"))
    d = np.einsum("nii->ni", A).max(axis=0)
    coupled = A.max(axis=0) / np.maximum(np.sqrt(np.outer(d, d)), 1e-300)
    port = max((coupled[i, j] for i in (0, 2, 4) for j in (1, 3) if d[i] and d[j]), default=0.0)
    fore = max((coupled[i, j] for i, j in ((0, 2), (2, 4), (1, 5)) if d[i] and d[j]), default=0.0)
    for turn, symmetric in ((2 * np.pi, True), (np.pi, port < 30 * EVEN), (0.5 * np.pi, max(port, fore) < 30 * EVEN)):
        closed = turn == 2 * np.pi
        part = np.sort(beta) if closed else np.sort(beta[beta <= turn + 1e-6])
        if not symmetric or len(part) < 4:
            continue
        if closed:
            steps = np.diff(np.append(part, part[0] + 2 * np.pi))
        elif part[0] > 1e-3 or part[-1] < turn - 1e-3:
            continue
        else:
            steps = np.diff(part)
        if steps.max() > 0.9:
            continue
        share = 0.5 * (steps + np.roll(steps, 1)) if closed else 0.5 * (np.append(steps, 0) + np.append(0, steps))
        out = np.zeros(len(beta))
        order = np.argsort(beta)
        chosen = order if closed else order[beta[order] <= turn + 1e-6]
        out[chosen] = share * (2 * np.pi / turn)
        return out, steps.max()
    return None


def haskind_ratios(values):
    """Ratios {mode: (q,)} of damping to the damping that follows from the far field, and frequencies (q,); None without
    excitation"""
    X, B = values.get("excitation_force"), np.einsum("nii->ni", values.get("radiation_damping"))
    if X is None or not X.size:
        return None
    k, kL = _waves(values)
    speed = group_factor(k, values.water_depth) * values.omega / k
    rate = k / (8 * np.pi * values.density * values.gravity * speed)
    circle = _circle(values)
    if circle is None:
        good = (kL < LONG) & (kL > 0.02)
        cos = np.abs(np.cos(values.wave_direction))
        ahead = int(np.argmax(cos))
        whole = {HEAVE: 2 * np.pi * np.mean(np.abs(X[:, :, HEAVE]) ** 2, axis=1)}
        if cos[ahead] > 0.7:
            whole[SURGE] = np.pi * np.abs(X[:, ahead, SURGE] / cos[ahead]) ** 2
    else:
        weights, step = circle
        good = (kL < 0.4 * np.pi / step) & (kL > 0.02)
        whole = {i: np.abs(X[:, :, i]) ** 2 @ weights for i in range(6)}
    found, rows = {}, np.abs(X).max(axis=1)
    few = FEW if circle is None else 1  # one frequency with waves all round is as good as many
    arm = CANCELS * size_of(values) * rows[:, :3].max(axis=1)  # moments below are small differences
    for i, integral in whole.items():
        far = rate * integral
        part = slice(0, 3) if i < 3 else slice(3, 6)
        clear = (
            good
            & (B[:, i] > 3 * FAINT * np.abs(B[:, i]).max())
            & (rows[:, i] > np.maximum(0.03 * rows[:, part].max(axis=1), arm * (i > 2)))
        )
        C = values.get("hydrostatic_stiffness")
        if i == HEAVE and C is not None:  # heave forces above and below a hull cancel and leave a small difference
            clear &= rows[:, HEAVE] > 0.3 * C[2, 2]
        if clear.sum() >= few:
            found[i] = (B[clear, i] / np.maximum(far[clear], 1e-300), values.omega[clear])
    return found or None


def energy_defects(values):
    """Largest |B_ii − k/(8πρgC_g) ∮ |X_i|² dβ| over ω|A_ii + iB_ii/ω| of six motions; shape (n,)

    The integral is the energy of the radiated waves by Haskind's relation.  The defect is NaN without excitation,
    without headings all round (or their mirror images), and where headings are too far apart for the length of the
    waves.
    """
    X, out = values.get("excitation_force"), np.full(len(values.omega), np.nan)
    circle = _circle(values) if X is not None and X.size else None
    if circle is None:
        return out
    weights, step = circle
    k, kL = _waves(values)
    A, B = (np.einsum("nii->ni", values.get(name)) for name in ("added_mass", "radiation_damping"))
    w = values.omega[:, None]
    speed = group_factor(k, values.water_depth) * values.omega / k
    rate = k / (8 * np.pi * values.density * values.gravity * speed)
    size = np.abs(w * A + 1j * B)
    for part in (slice(0, 3), slice(3, 6)):
        floor = ROUNDS * size[:, part].max(axis=1, keepdims=True)
        size[:, part] = np.where(size[:, part] > floor, size[:, part], np.inf)
    far = rate[:, None] * np.einsum("nmi,m->ni", np.abs(X) ** 2, weights)
    good = (kL < 0.4 * np.pi / step) & np.isfinite(far).all(axis=1)
    out[good] = (np.abs(B - far) / size).max(axis=1)[good]
    return out


def _haskind(values):
    found = haskind_ratios(values)
    if found is None:
        return None
    off = [i for i, mode in found.items() if not (_agrees(*mode) or (i == HEAVE and _deck(values)))]
    if not off:
        return []
    i, (ratio, omega) = off[0], found[off[0]]
    others = [f"B_{j + 1}{j + 1}" for j in found if j not in off]
    middle = float(np.median(ratio))
    why = _of_channel(values, found) or (not values.others and _of_depth(values))
    if not why and others:  # a wrong unit or length would show in these too
        why = f"{', '.join(others)} agrees, so the units are right: there are too few panels for mode {i + 1}"
    return [f"B_{i + 1}{i + 1} is {middle:.3g} times the value that follows from its excitation; "
            + (why or _why(middle, _slope(omega, ratio), ratio))]  # fmt: skip


def _agrees(ratio, omega):
    """Whether ratios (q,) of a mode are near 1, and independent of ω"""
    off = np.abs(np.log(np.abs(ratio) + 1e-300))
    wide = np.median(off) > np.log(1 + TRUE) or np.quantile(off, 0.8) > np.log(1 + 2 * TRUE)
    return not wide and abs(_slope(omega, ratio)) <= STEEP


def _slope(omega, ratio):
    """Power of ω to which a ratio is proportional, 0 for none"""
    if len(omega) < 5 or np.any(ratio <= 0):
        return 0.0
    power, size = np.polyfit(np.log(omega), np.log(ratio), 1)
    return power if np.std(np.log(ratio) - power * np.log(omega) - size) < 0.05 else 0.0


def depth_of(values):
    """Depth of water, m, possibly inf, at which damping and excitation agree in every mode; None if there is no such
    depth"""
    fits = {}
    for depth in (np.inf, *np.geomspace(1000, 5, 60)):
        found = haskind_ratios(replace(values, water_depth=depth)) or {}
        ratios = np.concatenate([np.zeros(0), *(ratio for ratio, _ in found.values())])
        if len(ratios) >= 5 and all(_agrees(*mode) for mode in found.values()):
            fits[depth] = np.median(np.abs(ratios - 1)) * (0.8 if np.isinf(depth) else 1.0)
    best = min(fits, key=fits.get, default=None)
    return best if fits and fits[best] < DEPTH_FITS else None


def _of_depth(values):
    """States in words the depth at which damping and excitation agree, "" without one"""
    depth = depth_of(values)
    if depth is None:
        return ""
    where = "deep water" if np.isinf(depth) else f"{depth:.3g} m of water"
    return f"they agree in {where}, not in {values.water_depth:g} m (--depth)"


def _deck(values):
    """A line where panels in the surface heave with the hull and lift water, A₃₃ → −C₃₃/ω² if they cover the
    waterplane; else None
    """
    C = values.get("hydrostatic_stiffness")
    long = _waves(values)[1] < LONG
    if C is None or not C[2, 2] > 0 or long.sum() < FEW:
        return None
    share = float(np.median(-(values.omega**2 * values.get("added_mass")[:, HEAVE, HEAVE])[long])) / C[2, 2]
    if share < DECKED:
        return None
    return [f"A_33 of long waves is {-share:.2g} C_33/ω²: the mesh has a deck or a lid in the surface whose panels "
            "heave with the hull and lift water; solve it without these"]  # fmt: skip


def _of_channel(values, found):
    """States the width w of a channel whose walls keep the waves in, B = 2/kw of surge and 1/kw of heave; else ""

    Other bodies reflect waves too: beside them both modes must give the width.
    """
    widths = []
    if values.others and not {SURGE, HEAVE} <= {i for i, (ratio, _) in found.items() if len(ratio) >= 5}:
        return ""
    for mode, (ratio, omega) in found.items():
        if mode in (SURGE, HEAVE) and len(ratio) >= 5:
            k = wavenumber(omega, values.water_depth, values.gravity)
            widths.append((2.0 if mode == SURGE else 1.0) / np.maximum(k * ratio, 1e-300))
    widths = np.concatenate(widths) if widths else np.zeros(0)
    if len(widths) < 5 or np.ptp(np.quantile(widths, [0.1, 0.9])) > 0.25 * np.median(widths):
        return ""
    return f"this is the damping in a channel {np.median(widths):.3g} m wide, not in open water"


def _why(ratio, slope, ratios):
    if 0.7 < slope < 1.3:
        return "the ratio is proportional to ω: damping is multiplied by ω in the files"
    if -1.3 < slope < -0.7:
        return "the ratio is proportional to 1/ω: damping is divided by ω in the files"
    for factor, words in ((0.25, "forces are for 1 m of wave height, not of "
                                 "amplitude"), (1e-6, "damping is in MN and forces are in N"),
                          (1e-3, "damping is in kN and forces are in N"), (1e3, "damping is in N and forces are in kN"),
                          (1e6, "forces are in kN"), (9.80665, "the factor g"), (1 / 9.80665, "the factor g"),
                          (1 / 1025, "the factor ρ"), (1025.0, "the factor ρ")):  # fmt: skip
        if abs(np.log(abs(ratio / factor))) < 0.25:
            return words
    if np.ptp(np.quantile(ratios, [0.1, 0.9])) > SCATTERS * abs(ratio):
        return (
            "the ratio scatters from frequency to frequency, so the cause is not a unit: there are too few panels, "
            "or thin plates in the mesh"
        )
    return (
        "damping and forces differ in their units, in the length of their dimensionless form, in density or in "
        "water depth, or the mesh has thin plates or too few panels"
    )


def _long_waves(values):
    X, C = values.get("excitation_force"), values.get("hydrostatic_stiffness")
    if X is None or not X[:, :, HEAVE].any() or values.others or _deck(values):
        return None  # next to other bodies the flow is different
    _, kL = _waves(values)
    n = int(np.argmin(kL))
    if kL[n] > LONG:
        return None
    lines, A = [], values.get("added_mass")[n]
    volume = values.body.get("displaced_volume") or values.body.get("mass", 0.0) / values.density
    moved = A[2, 2] + values.density * volume
    mean = X[n, :, HEAVE].mean()
    if C is not None and C[2, 2] > FLOATS * values.density * values.gravity * size_of(values) ** 2:
        expected = C[2, 2] - values.omega[n] ** 2 * moved
        if expected > 0.3 * C[2, 2]:
            ratio = mean / expected
            if ratio.real < 0 or abs(np.angle(ratio)) > 0.6:
                lines.append(
                    f"the heave force of the longest wave has a phase of {np.degrees(np.angle(mean)):.0f}°; it "
                    "must have 0°, in phase with the crest; forces have another sign, or phases are relative "
                    "to another point or to a sine"
                )
            elif abs(np.log(abs(ratio))) > np.log(1 + 2 * TRUE if not volume else 1 + TRUE):
                lines.append(
                    f"heave force of the longest wave is {abs(ratio):.3g} times the value from C₃₃; "
                    + _factor_of_force(abs(ratio))
                )
    floats = C is not None and C[2, 2] > FLOATS * values.density * values.gravity * size_of(values) ** 2
    return lines + _surge(values, n, mean, kL, floats)


def _factor_of_force(ratio):
    for factor, words in ((1e-3, "forces are in kN"), (1e3, "stiffness is in kN"), (2.0, "forces are for 1 m of wave "
                          "height, not of "
                          "amplitude"), (0.5, "forces are halved"), (1 / 9.80665, "forces lack g")):  # fmt: skip
        if abs(np.log(ratio / factor)) < 0.2:
            return words
    return "the two differ in their units, lengths, density or depth"


def _surge(values, n, heave, kL, floats):
    """Lines on the sign of surge in long waves; for a floating body also relative to heave, which follows the crest"""
    beta = values.wave_direction
    X = values.get("excitation_force")[kL <= max(LONG, kL[n])].sum(axis=0)  # sum over all long waves, to average noise
    ahead = int(np.argmax(np.abs(np.cos(beta))))
    if abs(np.cos(beta[ahead])) < 0.5 or not abs(X[ahead, SURGE]) > 1e-6 * abs(heave):
        return []
    turned = X[ahead, SURGE] / (-1j * np.cos(beta[ahead])) * (np.sign(heave.real) if floats else 1.0)
    if abs(np.angle(turned)) < 1.0:
        return []
    if abs(np.angle(turned)) < np.pi - 1.0:
        return [f"the surge force of the longest wave towards {np.degrees(beta[ahead]):g}° has a phase of "
            f"{np.degrees(np.angle(X[ahead, SURGE])):.0f}°; phases are not relative to the origin of the axes, or "
            "the hull is open"]  # fmt: skip
    long, B = kL < 2 * LONG, values.get("radiation_damping")[:, HEAVE, HEAVE]
    felt = values.get("excitation_force")[long, :, HEAVE].mean(axis=1).imag
    if np.sum(felt * values.omega[long] * B[long]) > 0:
        return ["surge and heave forces of long waves have the opposite phase; phases are conjugates, for exp(+iωt)"]
    return [
        "surge force of long waves has the opposite sign; headings are the directions that waves come from, or x "
        "points aft"
    ]


def _causality(values):
    w, B, A = values.omega, values.get("radiation_damping"), values.get("added_mass")
    if len(w) < 20 or _waves(values)[1].max() < SHORT:
        return None
    low, high = values.get("added_mass_zero"), values.get("added_mass_infinity")
    lines, tested = [], False
    for i in (SURGE, SWAY):  # not heave: it has no limit in finite depth, and moonpools have narrow peaks
        b, a = B[:, i, i], A[:, i, i]
        if np.abs(b[-1]) > 0.1 * np.abs(b).max() or not np.abs(b).max() > 0:
            continue
        limits = values.others == 0 and low is not None and high is not None and low[i, i] - high[i, i]
        if limits and np.isfinite(limits) and abs(limits) > 0.1 * abs(high[i, i]):
            ratio, fall, least, most = _integral(w, b) / limits, limits, 1 - CAUSAL, 1 + CAUSAL
        elif np.ptp(a) > 0.3 * np.abs(a).max() and _even(a) and np.count_nonzero(b > 0.25 * b.max()) >= PEAK:
            ratio, fall, least, most = _follows(w, a, b), float(np.ptp(a)), 0.5, 2.0
            if values.others and not least < ratio < most:  # waves between bodies cause peaks without meaning here
                continue
        else:
            continue
        tested = True
        if not least < ratio < most:
            lines.append(
                f"A_{i + 1}{i + 1} falls by {fall:.4g} from long to short waves; the fall that follows from damping "
                f"is {ratio:.3g} times as large; their units differ, or the two limits are exchanged"
            )
    return lines[:1] if tested else None


def _even(a):
    """Whether added mass (n,) has no peak that its frequencies cannot resolve"""
    around = np.median(np.lib.stride_tricks.sliding_window_view(a, 5), axis=1)
    return np.abs(a[2:-2] - around).max() < PEAKED * np.ptp(a)


def _integral(w, b):
    """A(0) − A(∞) from damping b (n,), which is proportional to ω³ below the first frequency"""
    inside = float(np.sum(0.5 * np.diff(w) * (b[1:] / w[1:] ** 2 + b[:-1] / w[:-1] ** 2)))
    return 2 / np.pi * (inside + b[0] / (2 * w[0]))


def _follows(w, a, b):
    """Slope of the added mass computed from damping against added mass a (n,), whose limits are unknown"""
    inner = slice(len(w) // 10 + 1, -len(w) // 10 - 1)
    s, at = w[:, None], w[None, inner]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (b[:, None] - b[None, inner]) / (s**2 - at**2)
    own = s == at
    share = np.where(own, (np.gradient(b, w) / (2 * w))[:, None], share)
    rest = np.log((w[-1] - at) * (at + w[0]) / ((w[-1] + at) * (at - w[0])))[0] / (2 * at[0])
    made = 2 / np.pi * (np.trapezoid(share, w, axis=0) + b[inner] * rest)
    return float(np.cov(a[inner], made)[0, 1] / np.var(a[inner], ddof=1))


LAWS = {
    "reciprocity": _reciprocity,
    "energy": _energy,
    "waterplane": _deck,
    "damping and excitation": _haskind,
    "long waves": _long_waves,
    "causality": _causality,
}
