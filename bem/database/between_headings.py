"""Values at any heading from values at stored headings: by turning a round body, by mirror images, by plane waves.

A round body sees the same wave from every heading: with R of a turn by α about its axis F(β + α) = R F(β) and H(θ +
α; β + α) = H(θ; β); drift turns like F.  One stored heading is enough, without interpolation.

On a body with a plane of symmetry the mirror image of a wave exerts the mirror image of the force.  P is the sign of
each of the six modes in the mirror, −1 for modes that the mirror reverses, and F(β′) = P F(β):

    plane y = 0:  β′ = −β,      P = (+ − + − + −),    drift (+ − −)
    plane x = 0:  β′ = π − β,   P = (− + + + − −),    drift (− + −)

A force or Kochin function is linear in the incident wave at the hull, so that over β it is a sum of exp(ik x·e), e =
(cos β, sin β), x in the plan of the hull.  If all parts of the plan were equal and independent, then for a plan of 2a
by 2b about c the values at two headings would have the covariance

    κ(β, β′) = exp(ik c·Δ) f(ka Δ_x) f(kb Δ_y),    Δ = e − e′,    f(x) = (1 − ¹⁄₅) sin x / x + ¹⁄₅ cos x

with a fifth of the weight at the ends of the hull. For quantities quadratic in the wave (drift) the covariance is κ².
Values between headings follow from Gaussian-process regression with κ, as in `interpolant`: κ contains the phase of
the wave at the ends of the hull, and for kR = 3.4 the error of surge over gaps of 30° is 0.6 %, where a spline has 4
%. The remaining variance is the estimated error. Beside a wall, the reflected wave on the hull is the incident wave
on the hull's image. The plan therefore contains hull and image, and a plane parallel to the wall is not a plane of
symmetry.
With the wall at y = w, a wave towards −β and its reflection are, except for a phase, a wave towards β and its
reflection:  F(−β) = exp(−2ikw sin β) F(β), and drift is equal at −β and β.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..drift import harmonics
from ..waves import wavenumber
from .between_frequencies import BetweenError

SAME = 1e-9  # rad
WIDEST_GAP = np.deg2rad(45.0)  # widest gap between neighbouring headings that is interpolated
ENDS = 0.2  # share of the weight at the ends of the plan
NUGGET = 1e-10  # regularisation of the kernel, relative to its diagonal
KEPT = 4  # number of sums over the ring that are kept with their weights
NEAR = 1e-4  # rad, below which sin x / x is computed by its series: a difference of products would lose digits
LONGEST = 2.0  # ka of the longest wave with its own κ: for longer waves κ would be constant
MIRRORS = {
    "y": (lambda beta: -beta, np.array([1, -1, 1, -1, 1, -1]), np.array([1, -1, -1])),
    "x": (lambda beta: np.pi - beta, np.array([-1, 1, 1, 1, -1, -1]), np.array([-1, 1, -1])),
    "wall": (lambda beta: -beta, np.ones(6), np.ones(3)),  # mirror image, with a change of phase
}


@dataclass(frozen=True, eq=False)
class Ring:
    """Headings (M,) rad from 0 to 2π of stored waves and their mirror images.

    source : index of the stored heading of each heading, (M,)
    force, drift : signs of the modes in the image, (M, 6) and (M, 3)
    theta : indices of the angles at which the stored Kochin function is that of the image, (M, t)
    images : index of the image of each θ, {plane: (t,)}; angles : angles θ of the Kochin functions, rad, (t,)
    is_round : whether a turn of the body gives all values at any heading; wall : y of the wall, m; None without a wall
    from_others : whether values at any heading follow from rings of other quantities; gaps of any width are then
        allowed
    """

    headings: np.ndarray
    source: np.ndarray
    force: np.ndarray
    drift: np.ndarray
    theta: np.ndarray
    images: dict
    angles: np.ndarray
    is_round: bool = False
    from_others: bool = False
    wall: float | None = None

    def of_forces(self, values):
        """Forces at all headings of the ring, shape (…, M, 6), from forces at the stored headings, (…, m, 6)"""
        return values[..., self.source, :] * self.force

    def of_drift(self, values):
        """Drift at all headings of the ring, shape (…, M, 3), from drift at the stored headings, (…, m, 3)"""
        return values[..., self.source, :] * self.drift

    def of_kochin(self, values):
        """Kochin functions at all headings of the ring, shape (…, M, t), from values at the stored headings, (…, m, t):
        H(θ′; β′) = H(θ; β)"""
        return values[..., self.source[:, None], self.theta]

    def stored(self, wanted):
        """Index of the ring heading equal to each of `wanted`, −1 for none; shape (p,)"""
        apart = np.abs(_wrapped(self.headings[:, None] - wanted))
        near = apart.argmin(axis=0)
        return np.where(apart[near, np.arange(len(wanted))] <= SAME, near, -1)

    def reflected(self, wanted):
        """Whether a heading β beside a wall is computed from −β, shape (p,): β is then not stored, and lies on the side
        with fewer stored headings"""
        if self.wall is None:
            return np.zeros(len(wanted), bool)
        side = 1 if np.sum(np.sin(self.headings)) >= -SAME else -1
        return (side * np.sin(wanted) < -SAME) & (self.stored(wanted) < 0)

    def gap(self, wanted):
        """Angle between the two ring headings beside each heading, or beside its reflection in a wall, rad; shape (p,);
        0 for a round body"""
        wanted = np.atleast_1d(wanted)
        if self.is_round or self.from_others:
            return np.zeros(len(wanted))
        beta = np.where(self.reflected(wanted), -wanted, wanted)
        offset = np.mod(self.headings[:, None] - beta, 2 * np.pi)
        return offset.min(axis=0) + (2 * np.pi - offset).min(axis=0)

    def reached(self, wanted):
        """Whether each heading is stored, or lies between ring headings at most 45° apart; shape (p,)"""
        return (self.stored(wanted) >= 0) | (self.gap(wanted) <= WIDEST_GAP * (1 + SAME))

    def turned(self, value, wanted, kind):
        """Values (q, p, …) of `value`, a function of headings, at `wanted` (p,) rad. Headings that are not `reached`
        take the nearest stored heading, turned as on a round body; kind : "force" or "drift" """
        apart = _wrapped(wanted[:, None] - self.headings)
        turns = apart[np.arange(len(wanted)), np.abs(apart).argmin(axis=1)]
        turns[self.reached(wanted)] = 0.0
        return _turned(value(wanted - turns), turns, None, kind)

    def inside(self, wanted):
        """`wanted` (p,) rad as an array.  Raises BetweenError for a heading in a gap above 45°."""
        wanted = np.atleast_1d(np.asarray(wanted, float))
        if not np.all(np.isfinite(wanted)):
            raise BetweenError(f"wave direction is {wanted[~np.isfinite(wanted)][0]}; allowed: finite, rad")
        wide = ~self.reached(wanted)
        if wide.any():
            stored = ", ".join(f"{np.rad2deg(b):.4g}" for b in self.headings)
            raise BetweenError(
                f"wave direction {np.rad2deg(wanted[wide][0]) % 360:.4g}° does not lie between stored headings "
                f"at most 45° apart ({stored}°); add this direction to the headings of the scene, or of the program "
                f"whose files were imported, and solve again"
            )
        return wanted


@dataclass(frozen=True, eq=False)
class AtHeadings:
    """Quantities of a ring at headings `wanted` (p,) rad in waves of `k` (q,) rad/m.

    The plan of the hull has half sides `half` about `middle`, m.
    quadratic : whether the quantities are of second order in the wave
    """

    ring: Ring
    wanted: np.ndarray
    k: np.ndarray
    half: np.ndarray
    middle: np.ndarray
    quadratic: bool = False

    def value(self, values, kind):
        """Values at the wanted headings, shape (q, p, …), from ring values (q, M, …); kind : "force", "drift" or
        "kochin" """
        one = len(self.folded) == 1 and self.place[0] >= 0
        return self.unfolded(values[:, self.place] if one else _joined(self.weights, values), kind)

    def unfolded(self, values, kind):
        """Values at the wanted headings, shape (q, p, …), from values (q, u, …) at the `folded` headings"""
        if self._as_folded:
            return values
        values = values[:, self.source]
        if self.ring.is_round:
            return _turned(values, self._turns, self.ring.angles, kind)
        for plane, image in self.ring.images.items():
            mirrored = self._folds[plane]
            if kind == "kochin":
                values[:, mirrored] = values[:, mirrored][..., image]
            else:
                values[:, mirrored] *= MIRRORS[plane][1 if kind == "force" else 2]
        if self.ring.wall is not None and kind == "force":
            ahead = np.where(self._folds["wall"], 2 * self.ring.wall * np.sin(self.wanted), 0.0)
            values = values * np.exp(1j * np.multiply.outer(self.k, ahead))[..., None]
        return values

    def deviation(self, values, independent):
        """Standard deviation of `value`; shape (q, u, …)
        independent : ring values that do not follow from other ring values, (…)"""
        scale = np.sum(np.abs(_joined(self._root, values)) ** 2, axis=1) / np.maximum(independent, 1)
        left = self._left.reshape(*self._left.shape, *[1] * (values.ndim - 2))
        return np.sqrt(left * scale[:, None])

    def unfolded_deviation(self, deviation, kind):
        """Deviations at the wanted headings, shape (q, p, …), from deviations (q, u, …) at `folded` headings. Where a
        vector is turned, the deviations of its two components are combined"""
        if self._as_folded or not self.ring.is_round:
            return deviation[:, self.source]
        if kind == "kochin":
            return np.abs(self.unfolded(deviation, kind))
        return np.sqrt(np.einsum("pij,qpj->qpi", _turn(self._turns, kind) ** 2, deviation[:, self.source] ** 2))

    @cached_property
    def _turns(self):
        """Angle from the stored heading that is used to each of `wanted`, for a round body, rad; shape (p,)"""
        return _wrapped(self.wanted - self.folded[self.source])

    @cached_property
    def _folds(self):
        """{plane: (p,) whether the mirror image of a heading is used}: mirror images then agree to the last digit"""
        c, s = np.cos(self.wanted), np.sin(self.wanted)
        folds = {plane: (s if plane == "y" else c) < -SAME for plane in self.ring.images}
        return folds if self.ring.wall is None else {**folds, "wall": self.ring.reflected(self.wanted)}

    @property
    def folded(self):
        """Different headings, rad, that remain when the wanted headings are mirrored to one side of every plane of
        symmetry; shape (u,)"""
        return self._once[0]

    @property
    def source(self):
        """Index in `folded` of the heading used for each wanted heading; shape (p,)"""
        return self._once[1]

    @cached_property
    def _once(self):
        if self.ring.is_round:
            near = np.abs(_wrapped(self.ring.headings[:, None] - self.wanted)).argmin(axis=0)
            kept, source = np.unique(near, return_inverse=True)
            return self.ring.headings[kept], source
        folded = self.wanted
        for plane, mirrored in self._folds.items():
            folded = np.where(mirrored, MIRRORS[plane][0](folded), folded)
        _, first, source = np.unique(
            np.round(np.mod(folded + SAME, 2 * np.pi) / SAME), return_index=True, return_inverse=True
        )
        return folded[first], source

    @cached_property
    def _as_folded(self):
        """Whether every wanted heading is already folded, in order: Kochin functions are then not copied"""
        return (
            len(self.folded) == len(self.wanted)
            and not any(map(np.any, self._folds.values()))
            and bool(np.all(self.source == np.arange(len(self.wanted))))
            and bool(np.all(np.abs(_wrapped(self.folded - self.wanted)) <= SAME))
        )

    @cached_property
    def place(self):
        """Index of the ring heading equal to each folded heading, −1 for none; shape (u,)"""
        return self.ring.stored(self.folded)

    @cached_property
    def weights(self):
        """Weights of ring values; shape (q, u, M); a stored heading has weight only on its own value"""
        weights = self._whitened @ self._root
        found = self.place >= 0
        weights[:, found] = np.eye(len(self.ring.headings))[self.place[found]]
        return weights

    @cached_property
    def _root(self):
        """R (q, M, M) of the inverse R*R of κ over the ring with its nugget"""
        headings = self.ring.headings
        return np.linalg.inv(np.linalg.cholesky(self._kernel(headings, headings) + NUGGET * np.eye(len(headings))))

    @cached_property
    def _whitened(self):
        return self._kernel(self.folded, self.ring.headings) @ self._root.conj().swapaxes(1, 2)

    @cached_property
    def _left(self):
        """Share of the variance that remains at the wanted headings; shape (q, p)"""
        left = np.maximum(1 - np.sum(np.abs(self._whitened) ** 2, axis=-1) - 2 * NUGGET, 0)
        return np.where(self.place >= 0, 0.0, left)

    def _kernel(self, a, b):
        """κ (q, a, b)"""
        k = np.maximum(self.k, LONGEST / max(self.half.max(), 1e-300))
        real = _side(np.outer(k, self.half[0] * np.cos(a)), np.outer(k, self.half[0] * np.cos(b)))
        real *= _side(np.outer(k, self.half[1] * np.sin(a)), np.outer(k, self.half[1] * np.sin(b)))
        if self.quadratic:
            return real**2
        if not self.middle.any():
            return real
        away = [np.exp(1j * np.outer(k, self.middle[0] * np.cos(c) + self.middle[1] * np.sin(c))) for c in (a, b)]
        return away[0][:, :, None] * away[1].conj()[:, None] * real


def ring(headings, theta, symmetry, is_round=False, from_others=False, wall=None, motions=6):
    """`Ring` of stored headings (m,) rad and angles theta (t,) of Kochin functions.

    symmetry : planes, from `whole_mirrors`; theta : equally spaced from 0, t a multiple of 4 or 0
    is_round : whether the body is unchanged by a turn about the vertical, so that no mirror planes are needed
    from_others, wall : see `Ring`; motions : number of motions; more than six belong to several bodies, without mirrors
    """
    symmetry = "" if is_round else symmetry
    found, source = np.asarray(headings, float), np.arange(len(headings))
    force, drift, t = np.ones((len(found), motions)), np.ones((len(found), 3)), len(theta)
    angles, images = np.broadcast_to(np.arange(t), (len(found), t)), {}
    for plane in symmetry:
        mirror, of_force, of_drift = MIRRORS[plane]
        image = np.rint(np.mod(mirror(np.asarray(theta)), 2 * np.pi) / (2 * np.pi) * t).astype(int) % max(t, 1)
        found, source = np.concatenate([found, mirror(found)]), np.concatenate([source, source])
        force, drift = np.concatenate([force, force * of_force]), np.concatenate([drift, drift * of_drift])
        angles, images[plane] = np.concatenate([angles, angles[:, image]]), image
    found = np.mod(found, 2 * np.pi)
    found = np.where(2 * np.pi - found < SAME, 0.0, found)
    order = np.argsort(np.round(found / SAME), kind="stable")  # a stored heading precedes its image
    kept = order[np.concatenate([[True], np.diff(found[order]) > 2 * SAME])]
    held = found[kept], source[kept], force[kept], drift[kept], angles[kept]
    return Ring(*held, images, np.asarray(theta), is_round, from_others, wall)


def at_headings(ring, wanted, omega, between, quadratic=False):
    """`AtHeadings` of the headings `wanted` (p,) rad at omega (q,) rad/s for the hull of a
    `between_frequencies.Between`.

    The last `KEPT` results are kept with their weights: forces, Kochin functions, drift and errors share these weights.
    """
    omega = np.asarray(omega, float)
    of_ring = ring.headings.tobytes(), ring.force.tobytes(), ring.is_round
    key = (*of_ring, np.asarray(wanted).tobytes(), omega.tobytes(), quadratic)
    kept = between.over_headings
    if key not in kept:
        while len(kept) >= KEPT:
            kept.pop(next(iter(kept)))
        kept[key] = _at_headings(ring, wanted, omega, between, quadratic)
    return kept[key]


def _at_headings(ring, wanted, omega, between, quadratic):
    k = np.atleast_1d(wavenumber(omega, between.depth, between.gravity))
    low, high = between.met_by_waves.min(axis=0), between.met_by_waves.max(axis=0)
    half, middle = 0.5 * (high - low), 0.5 * (high + low)
    middle = np.where(np.abs(middle) <= SAME * half.max(), 0.0, middle)
    return AtHeadings(ring, ring.inside(wanted), k, half, middle, quadratic)


def whole_mirrors(symmetry, matrices, center):
    """Planes of symmetry, "", "x", "y" or "xy", under which all of `matrices` (6, 6) and `center` are unchanged."""
    return "".join(plane for plane in symmetry if _is_mirrored(plane, matrices, center))


def is_turned(matrices, center):
    """Whether turns about the z axis leave `matrices` (6, 6) and `center` unchanged, to the rounding of files"""
    turn = _turn(np.array([1.0]), "force")[0]  # one radian: no fraction of a circle
    on_axis = np.abs(np.asarray(center)[:2]).max() <= 1e-6
    return bool(on_axis and all(_is_same(m, turn @ m @ turn.T, 1e-6) for m in matrices))


def _turn(angles, kind):
    """Matrices of turns by angles (p,), rad, about the vertical; shape (p, 6, 6), or (p, 3, 3) for drift"""
    c, s, one = np.cos(angles), np.sin(angles), np.ones_like(angles)
    matrix = np.zeros((len(angles), 3, 3))
    matrix[:, 0, 0], matrix[:, 0, 1], matrix[:, 1, 0], matrix[:, 1, 1], matrix[:, 2, 2] = c, -s, s, c, one
    if kind == "drift":
        return matrix
    both = np.zeros((len(angles), 6, 6))
    both[:, :3, :3] = both[:, 3:, 3:] = matrix
    return both


def _turned(values, turns, angles, kind):
    """Values (q, p, …) of a round body, turned by turns (p,) rad; angles (t,) rad of Kochin functions"""
    if kind != "kochin":
        return np.einsum("pij,qpj->qpi", _turn(turns, kind), values)
    moved = np.abs(turns) > SAME
    order, series = harmonics(values[:, moved], angles)
    series = series * np.exp(-1j * np.multiply.outer(turns[moved], order))
    there = series @ np.exp(1j * np.multiply.outer(order, angles))
    values[:, moved] = there if np.iscomplexobj(values) else there.real
    return values


def _side(a, b):
    """f (q, p, M) of the module at x = a − b, from a (q, p) and b (q, M)"""
    (ca, sa), (cb, sb) = ((np.cos(x), np.sin(x)) for x in (a, b))
    x = a[:, :, None] - b[:, None]
    sine, near = sa[:, :, None] * cb[:, None] - ca[:, :, None] * sb[:, None], np.abs(x) < NEAR
    np.divide(sine, x, out=sine, where=~near)
    sine[near] = 1 - x[near] ** 2 / 6
    return (1 - ENDS) * sine + ENDS * (ca[:, :, None] * cb[:, None] + sa[:, :, None] * sb[:, None])


def _joined(weights, values):
    """Σ_M weights (q, p, M) values (q, M, …)"""
    flat = values.reshape(*values.shape[:2], -1)
    return (weights @ flat).reshape(*weights.shape[:2], *values.shape[2:])


def _wrapped(angle):
    """Between −π and π"""
    return np.mod(angle + np.pi, 2 * np.pi) - np.pi


def _is_mirrored(plane, matrices, center):
    _, signs, _ = MIRRORS[plane]
    at_center, flip = abs(center["xy".index(plane)]) <= 1e-9, np.outer(signs, signs)
    return at_center and all(_is_same(np.asarray(m, float), flip * m) for m in matrices)


def _is_same(matrix, other, share=1e-9):
    scale = np.sqrt(np.abs(np.outer(np.diag(matrix), np.diag(matrix)))).max() + np.abs(matrix).max()
    return np.all(np.abs(matrix - other) <= share * scale)
