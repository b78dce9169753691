"""The slow force of wave pairs by levels of its quadratic transfer function T; each level is more complete and more
expensive.

newman      √(DᵢDⱼ) of the mean drift: needs no data beyond those of every study (`slow_drift`)
bound-wave  and the long wave bound to the pair, diffracted (`bound_wave_drift`): a second for a sea
body        squares at their difference frequency, bound wave and the moving hull (`bem.second_order`), as
            `hakobune qtf` stores them, of the freely floating body
full        and the forcing of the surface around it, as `hakobune qtf --level full` stores it
auto        newman where bound long waves are estimated to push with less than ENOUGH of it, else full or body,
            whichever is stored, else bound-wave below kh = SHALLOW and newman from it on, where squares at their
            difference frequency take away most of what the bound wave adds to newman

The addition to Newman's force is T minus Newman's T, for pairs at their difference frequency.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..environment.sea import Sea, linear_weights
from .bound_wave_drift import RATIO, SHALLOW, STOKES, bound_to_newman, depth_in_waves, of_sea, slow_share, ursell
from .slow_drift import HORIZONTAL

if TYPE_CHECKING:  # it loads the panel method, which Newman's approximation does not need
    from hakobune.bem.second_order.stored import BetweenPairs

LEVELS = ("newman", "bound-wave", "body", "full", "auto")
ENOUGH = 0.05  # largest part, over Newman's slow force, that "auto" neglects
# both from docs/slow_forces.md: slow forces by either level relative to the whole
OF_BOUND = (
    "without the other terms, slow forces are 0.9 to 1.6 times the complete ones (boxes in 12 and 20 m of water, and a "
    "ship with 2.6 m under its keel)"
)
OF_NEWMAN = (
    "for boxes in 10 to 20 m of water the complete slow force is 0.7 to 1.2 times that by Newman's approximation in "
    "surge and sway, and 1 to 2 times in yaw"
)
SAME = 1e-6  # rad, below which two headings are equal
MOST_OUTSIDE = (
    0.05  # share of the energy of the waves beyond the stored pairs at either end, for which Newman's rule is left
)
AT_ONCE = 20_000  # pairs
LEAST_SHARE = 1e-3  # headings with less than this fraction of the largest energy are neglected


@dataclass(frozen=True, eq=False)
class PairForces:
    """Transfer function T of stored pairs minus Newman's T, for waves in one direction, or for pairs of waves in two
    directions.

    between : `BetweenPairs` of these headings; omega : (q,) rad/s; drift : (q, 3) N/m², N m/m² at omega
    second : (q, 3) drift towards the heading of the second wave, None for one direction
    """

    between: BetweenPairs
    omega: np.ndarray
    drift: np.ndarray
    level: str = "body"
    second: np.ndarray | None = None

    @property
    def highest(self):
        """rad/s, difference frequency above which only Newman's force remains"""
        return float(self.between.difference[-1])

    def of_components(self, components, drift=None):
        """Transfer functions of all pairs of wave `components`, all in the one direction; shape (n, n, 6)"""
        return self(components.omega[:, None], components.omega)

    def __call__(self, one, two):
        """Transfer functions of pairs of frequencies that broadcast, rad/s; shape (…, 6); zero if one is beyond the
        stored pairs"""
        one, two = np.broadcast_arrays(np.asarray(one, float), np.asarray(two, float))
        flat = one.ravel(), two.ravel()
        parts = [self._of(*(w[i : i + AT_ONCE] for w in flat)) for i in range(0, one.size, AT_ONCE)]
        return np.concatenate(parts).reshape(*one.shape, 6)

    def _of(self, one, two):
        T = self.between(one, two)
        T[:, HORIZONTAL] -= self.newman(one, two)
        return T * self.share(one, two)[:, None]

    def share(self, one, two):
        """Weight of T, shape (…,): zero if a frequency or the difference is beyond the stored pairs"""
        low, high = self.between.omega[[0, -1]]
        known = (np.minimum(one, two) >= low) & (np.maximum(one, two) <= high)
        return known * slow_share((one - two) / self.highest)

    def newman(self, one, two):
        """Mean drift at frequencies (q,), as Newman's approximation uses it; shape (q, 3)"""
        both = (one, self.drift), (two, self.drift if self.second is None else self.second)
        return newman(*(np.stack([np.interp(w, self.omega, d) for d in drift.T], axis=-1) for w, drift in both))


def newman(one, two):
    """Force of pairs by Newman's approximation, from the mean drift of their waves; arrays broadcast"""
    return np.where(one * two > 0, np.sign(one) * np.sqrt(np.abs(one * two)), 0.0)


@dataclass(frozen=True, eq=False)
class SpreadPairForces:
    """Pairs of a sea of several directions: each wave of a pair has its own direction.

    pairs : {(a, b): `PairForces`} of numbers of headings; headings : (m,) rad; sea : `Sea`
    """

    pairs: dict
    headings: np.ndarray
    sea: Sea
    level: str

    @property
    def highest(self):
        """rad/s, difference frequency above which only Newman's force remains"""
        return max(pair.highest for pair in self.pairs.values())

    def of_components(self, components, drift):
        """Transfer function T of all pairs of wave `components` minus Newman's T from their mean drift (n, 3); shape
        (n, n, 6)

        T is linear between headings; outside the headings of the pairs the nearest heading is used
        """
        omega, total = np.asarray(components.omega, float), 0.0
        used = sorted({a for a, _ in self.pairs})
        weights = between_headings(self.headings[used], components.direction)
        for (a, b), pair in self.pairs.items():
            first, second = (weights[:, used.index(heading)] for heading in (a, b))
            rows, columns = np.flatnonzero(first), np.flatnonzero(second)
            T = np.zeros((len(omega), len(omega), 6), complex)
            T[np.ix_(rows, columns)] = pair.between(omega[rows, None], omega[columns])
            total = total + T * (first[:, None] * second)[..., None]
        total[..., HORIZONTAL] -= newman(drift[:, None], drift)
        return total * pair.share(omega[:, None], omega)[..., None]

    def spectrum(self, omega, difference):
        """Spectrum 8 ∫ S(ω) S(ω + Ω) Σ_a Σ_b w_a w_b |T_ab|² dω of the slow force over differences Ω (d,), rad/s; shape
        (d, 6)

        omega : (q,) rad/s; w : shares of the energy per heading, w_a at ω + Ω and w_b at ω
        """
        two, one = np.broadcast_arrays(omega, omega + np.asarray(difference)[:, None])
        density = self.sea.spectrum.density
        energy = 8 * density(omega) * np.where(one <= omega[-1], density(one), 0.0)
        high, low = (self.sea.directional(self.headings, w.ravel()).reshape(*one.shape, -1) for w in (one, two))
        total = np.zeros((*one.shape, 6))
        for (a, b), pair in self.pairs.items():
            T = pair(one, two)
            T[..., HORIZONTAL] += pair.newman(one.ravel(), two.ravel()).reshape(*one.shape, 3)
            total += (high[..., a] * low[..., b])[..., None] * np.abs(T) ** 2
        return np.trapezoid(energy[..., None] * total, omega, axis=1)


def between_headings(headings, directions):
    """Weights of headings (m,) for linear interpolation at directions (n,), rad; shape (n, m); beyond the headings,
    weight 1 of the nearest heading"""
    weights = linear_weights(headings, np.asarray(directions, float))
    outside = ~weights.any(axis=1)
    apart = np.abs(np.angle(np.exp(1j * (directions[outside, None] - headings))))
    weights[outside, np.argmin(apart, axis=1)] = 1.0
    return weights


def beside_newman(db, sea, level, spread=False):
    """Terms of a level beyond Newman's approximation, as a function of two frequencies, or None; and remarks.

    spread : whether `SpreadPairForces` are acceptable, in a sea of several directions
    raises : ValueError for any other sea of several directions, and for pairs that are not stored

    A remark on a neglected part of the force begins with "left out"; it gives the size of the part and a command to
    compute it.
    """
    if level == "newman":
        return None, ()
    if level in ("body", "full"):
        return stored_pairs(db, sea, level, spread), (*_failed(db, level), *_surface_left_out(db, sea, level))
    if level == "bound-wave":
        return of_sea(db, sea), ()
    if (steep := ursell(db.reader, sea)) > STOKES:
        return None, (
            'left out: the force of wave pairs beyond Newman\'s approximation (qtf = "auto" uses newman): '
            f"for waves with Hλ²/h³ of {steep:.3g} (allowed: {STOKES:g}) it is not known",
        )
    ratio = bound_to_newman(db.reader.floating(), sea)
    if ratio is None or ratio < ENOUGH:
        size = "their force is unknown without drift and inertia"
        if ratio is not None:
            size = f"their force is {100 * ratio:.3g} % of Newman's slow force"
        return None, (f'qtf = "auto" uses newman: bound long waves are left out; {size}',)
    size = f"about {ratio:.2g} times the slow force of" if ratio <= RATIO else "a slow force that is nearly zero by"
    size = f"the force of bound long waves is {size} Newman's approximation"
    try:
        found = stored_pairs(db, sea, "auto", spread)
        used = f'qtf = "auto" uses {found.level}: {size}'
        return found, (used, *_failed(db, "auto"), *_surface_left_out(db, sea, found.level))
    except ValueError as missing:
        kh, lacks = depth_in_waves(db.reader, sea), _lacks(db, sea, missing)
    beside = (
        f'left out: the force of wave pairs beyond Newman\'s approximation (qtf = "auto" uses newman at kh = {kh:.2g})'
    )
    if kh >= SHALLOW:
        return None, (f"{beside}: {OF_NEWMAN}; {lacks}",)
    try:
        return of_sea(db, sea), (
            'left out: the force of wave pairs other than that of bound long waves (qtf = "auto" uses '
            "bound-wave): "
            f"{size}, {OF_BOUND}; {lacks}",
        )
    except ValueError as none:
        return None, (f"{beside}: {size}; not bound-wave: {none}; {lacks}",)


def beside_newman_of_bodies(db, sea, level):
    """The result of `beside_newman` for each of several bodies, or None, shape (moving bodies,); and remarks

    level : newman, body, or auto, which is body if that is stored. raises : as in `beside_newman`
    """
    if level == "newman":
        return None, ()
    beyond = "the slow force of wave pairs beyond Newman's approximation"
    try:
        moving = (number for number, one in enumerate(db.bodies) if not one.fixed)
        found = tuple(stored_pairs(db, sea, "body", spread=True, body=number) for number in moving)
    except ValueError as missing:
        if level != "auto":
            raise
        return None, (f'left out: {beyond} (qtf = "auto" uses newman): {_lacks(db, sea, missing)}',)
    return found, (
        "left out: the free-surface forcing around several bodies is not known; it is a part of "
        + beyond
        + ", is not known",
    )


def _failed(db, level):
    """Remark on stored pairs that fail their check and are used all the same"""
    from hakobune.bem.second_order.stored import failed_gap, read_forces

    failed = failed_gap(read_forces(db).forces)
    if failed is None:
        return ()
    return (
        f'qtf = "{level}" uses wave pairs that fail their check: {failed[0]}; slow forces may be wrong by about as '
        f'much; qtf = "bound-wave" needs no pairs',
    )


def _lacks(db, sea, missing):
    """Pairs of a Sea that a database lacks, with the command that stores them"""
    from hakobune.bem.database.widening import read_group
    from hakobune.bem.second_order.kinds import DIFFERENCE
    from hakobune.bem.second_order.stored import GROUPS

    if read_group(db, GROUPS[DIFFERENCE]) is not None or not isinstance(sea, Sea):
        return str(missing)
    return f"{_command(db, sea)} computes it"


def _command(db, sea):
    """The command that stores all pairs for a sea"""
    towards = f" --heading {np.degrees(sea.direction) % 360:.4g}" if sea.spreading is None else ""
    return f"'hakobune qtf {db.path}{towards}{'' if db.bodies else ' --level full'}'"


def _surface_left_out(db, sea, level):
    """Remark on the size of the surface forcing, where the level `body` neglects it"""
    from hakobune.bem.second_order.stored import read_forces

    share = read_forces(db).share
    if level == "full" or share is None:
        return ()
    begin, way = ("left out: ", f"; {_command(db, sea)} adds it") if share > ENOUGH else ("", "")
    return (
        f'{begin}the free-surface forcing (qtf = "body"), about {100 * share:.3g} % of the slow force of wave '
        f"pairs{way}",
    )


def stored_pairs(db, sea, level="body", spread=False, body=None):
    """`PairForces` of an open database at a level; "auto" is the highest stored level.

    In a sea of several directions `SpreadPairForces`, where `spread` allows them.

    body : number of one of several bodies
    raises : ValueError, with a message of one line, for what is not stored in it
    """
    from hakobune.bem.second_order.stored import USABLE, failed_gap, read_forces

    if not isinstance(sea, Sea) or (sea.spreading is not None and not spread):
        raise ValueError(f'qtf = "{level}" in a sea of several directions; it needs one long-crested system')
    stored = read_forces(db)
    forces = stored.forces
    if not stored.held.floats:
        raise ValueError(
            f"the wave pairs in {db.path} are for a fixed body; 'hakobune qtf {db.path} --fresh' computes the "
            f"floating body"
        )
    if stored.asked is not None:
        raise ValueError(
            f"the wave pairs in {db.path} come from an unfinished run; differences up to {forces.frequency[-1]:.3g} "
            f"of {stored.asked:.3g} rad/s are stored; 'hakobune qtf {db.path}' continues it"
        )
    if level == "full" and forces.surface is None:
        raise ValueError(
            f"the wave pairs in {db.path} do not include the free-surface forcing; 'hakobune qtf {db.path} "
            f"--level full' adds it"
        )
    if level == "auto" and (failed := failed_gap(forces)) is not None and failed[1] > USABLE:
        raise ValueError(
            f"the wave pairs in {db.path} fail their check and are not used: {failed[0]}; "
            'qtf = "body" or "full" uses them all the same'
        )
    level = {"auto": "body" if forces.surface is None else "full"}.get(level, level)
    values = forces.total if level == "full" else forces.to_body
    values = values if body is None else values[..., 6 * body : 6 * body + 6]
    found = (_of_heading if sea.spreading is None else _of_headings)(db, sea, forces, values, level, body)
    low, high = forces.omega[[0, -1]]
    first, last = sea.spectrum.quantile((MOST_OUTSIDE, 1 - MOST_OUTSIDE))
    if not (low <= first and last <= high):
        raise ValueError(
            f"wave pairs are stored from {low:.4g} to {high:.4g} rad/s, but 90 % of the wave energy lies within "
            f"{first:.4g} to {last:.4g}; run 'hakobune qtf {db.path}' on a database of a wider band"
        )
    return found


def _of_heading(db, sea, forces, values, level, body):
    """`PairForces` of the sea's one direction"""
    from hakobune.bem.second_order.stored import BetweenPairs

    apart = np.abs(np.angle(np.exp(1j * (forces.headings - sea.direction))))
    h, degrees = int(np.argmin(apart)), np.degrees(sea.direction) % 360
    if apart[h] > SAME:
        raise ValueError(
            f"{db.path} has no wave pairs towards {degrees:.4g}°; "
            f"'hakobune qtf {db.path} --heading {degrees:.4g}' computes them"
        )
    omega, drift = _drift(db, forces, [sea.direction], body)
    return PairForces(BetweenPairs(forces.omega, forces.frequency, values[:, :, h, h]), omega, drift[:, 0], level)


def _of_headings(db, sea, forces, values, level, body):
    """`SpreadPairForces` of all pairs of stored headings that waves travel to"""
    from hakobune.bem.second_order.stored import BetweenPairs

    try:
        share = sea.directional(forces.headings)
    except ValueError as error:
        raise ValueError(f"pairs in {db.path}: {error}; 'hakobune qtf {db.path} --heading' computes them") from None
    omega, drift = _drift(db, forces, forces.headings, body)
    used, pairs = np.flatnonzero(share > LEAST_SHARE * share.max()), {}
    for a, b in ((a, b) for a in used for b in used):
        between = BetweenPairs(forces.omega, forces.frequency, values[:, :, a, b])
        pairs[a, b] = PairForces(between, omega, drift[:, a], level, drift[:, b])
    return SpreadPairForces(pairs, forces.headings, sea, level)


def _drift(db, forces, headings, body):
    """Frequencies, rad/s, close enough for the mean drift, shape (q,), and its values there, shape (q, m, 3)"""
    omega, reader = np.linspace(*forces.omega[[0, -1]], 8 * len(forces.omega)), db.bodies_reader.floating()
    if body is None:
        return omega, reader.drift(omega, headings)
    return omega, reader.drift_of_each(omega, headings)[:, :, body]
