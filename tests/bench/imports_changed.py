"""Random changes of unit, sign, reference and convention in sets with a hull: how many are told, with the right cause.

python tests/bench/imports_changed.py [--changes 500] [--seed 1] [--two]

A ship without fore-and-aft symmetry, a barge and a buoy are solved with bilinear panels; each set is changed in one
way, with --two in two of different kinds, and held against its hull as `hakobune import` does, on flat panels.  A cause
is right where its correction gives the set as it was.  A change counts as silent where a coefficient or a force changes
by more than 10 % of its row and nothing is told.
"""

import argparse
from dataclasses import replace

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.formats.judging.causes import FORCES, MATRICES, ROTATION, changed, finding, of_length, turned
from hakobune.bem.formats.judging.own_solution import WANT, Own, gaps, own_of, sample
from hakobune.bem.formats.values import Values
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.modes import reference_change
from hakobune.bem.waves import wavenumber
from hakobune.meshing.panels import joined, structured
from hakobune.meshing.shapes import box

RHO, G = 1025.0, 9.80665
HEADINGS = np.radians([0.0, 30.0, 90.0, 150.0])
SAME = 1e-6


def ship(n, length=60.0, beam=12.0, draft=5.0):
    """A hull with a sharp bow and a wide stern, fuller at the waterline; n stations"""
    s, girth = np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n // 3 * 2 + 1)
    half = 0.5 * beam * np.where(s > 0, 1 - s**2, 1 - 0.35 * s**2)
    half[-1] = 0.02 * beam
    angle = 0.5 * np.pi * girth[None, :]
    y = half[:, None] * np.sign(angle) * np.sqrt(np.abs(np.sin(angle)))
    z = -draft * (0.7 + 0.3 * (half / half.max())[:, None]) * np.sqrt(np.abs(np.cos(angle)))
    z[:, [0, -1]] = 0.0
    x = np.broadcast_to(0.5 * length * s[:, None], y.shape)
    hull = structured(np.stack([x, y, z], axis=-1))
    stern = structured(np.stack([np.stack([x[0], y[0] * w, z[0]], -1) for w in (1.0, 0.5, 0.0)], axis=0))
    bow = structured(np.stack([np.stack([x[-1], y[-1] * w, z[-1]], -1) for w in (0.0, 0.5, 1.0)], axis=0))
    out = []
    for part, axis, sign in ((hull, 2, -1), (stern, 0, -1), (bow, 0, 1)):
        out.append(part if sign * part.area_vectors[:, axis].sum() > 0 else part.flipped())
    return joined(out)


def set_of(mesh, depth, omegas):
    """The Values of a hull on bilinear panels"""
    prepared = PanelProblem(mesh=mesh, depth=depth, density=RHO, gravity=G).prepared()
    rows = [prepared.run(float(w), HEADINGS, frozenset(WANT), None, DOFS).result() for w in omegas]
    quantities = {name: np.array([row[name] for row in rows]) for name in WANT}
    return Values(np.array(omegas), HEADINGS, depth, RHO, G, quantities)


def about(values, r, names):
    """The quantities about a point that lies r from the one they are about"""
    T = reference_change(r)

    def move(data):
        return data @ T.T if np.iscomplexobj(data) else T @ data @ T.T

    return changed(values, names, move)


def crest_at(values, r):
    k = wavenumber(values.omega, values.water_depth, values.gravity)[:, None]
    turn = np.exp(-1j * k * (r[0] * np.cos(values.wave_direction) + r[1] * np.sin(values.wave_direction)))
    return changed(values, FORCES, lambda X: X * turn[..., None])


def times(values, names, factor, power=None):
    def by(data):
        size = 1.0 if power is None else None
        if size is None:
            row = factor**power
            return data * (row if np.iscomplexobj(data) else np.outer(row, row))
        return data * factor

    return changed(values, names, by)


def signed(values, signs, words):
    S = np.array(signs, float)
    new = changed(values, FORCES + MATRICES, lambda d: d * S if np.iscomplexobj(d) else d * np.outer(S, S))
    return turned(new, words)


def drawn(random, values, size):
    """(kind, changed Values) of one change"""
    pick = random.choice
    force = [1e3, 1e-3, 9806.65, 1 / 9806.65, 2.0, 0.5, G, 1 / G, 4448.22, RHO * G, 1 / (RHO * G), 0.3048, 1e6]
    kind = random.integers(16)
    if kind == 0:
        return "length unit", of_length(values, 1 / pick([1e-3, 0.3048, 10.0, 100.0, random.uniform(2, 200)]))
    if kind == 1:
        return "unit of forces", times(values, FORCES, pick(force))
    if kind == 2:
        return "unit of added mass", times(values, ("added_mass",), pick([1e3, 1e-3, RHO, 1 / RHO, 0.4536, 14.594]))
    if kind == 3:
        return "unit of damping", times(values, ("radiation_damping",), pick([1e3, 1e-3, RHO, 1 / RHO, G, -1.0]))
    if kind == 4:
        return "unit of both", times(values, WANT[:2], pick([1e3, 1e-3, RHO, 1 / RHO]))
    if kind == 5:
        return "unit of all", times(values, WANT, pick([1e3, 1e-3, RHO, 1 / RHO, 4448.22]))
    if kind == 6:
        return "phase", changed(values, FORCES, pick([np.conj, np.negative, lambda X: 1j * X, lambda X: -1j * X]))
    if kind == 7:
        return "headings", turned(values, pick(["opposite", "mirrored", "opposite mirrored"]))
    if kind == 8:
        axes = [((1, -1, -1, 1, -1, -1), "mirrored"), ((-1, -1, 1, -1, -1, 1), "opposite"),
                ((1, -1, 1, -1, 1, -1), "mirrored"), ((1, 1, 1, 1, -1, 1), ""), ((1, 1, -1, 1, 1, 1), ""),
                ((1, 1, 1, -1, -1, -1), "")]  # fmt: skip
        return "axes", signed(values, *axes[random.integers(len(axes))])
    r = random.uniform(-1, 1, 3) * size
    if kind == 9:
        return "reference point", about(values, r, FORCES + MATRICES)
    if kind == 10:
        return "reference point of forces", about(values, r, FORCES)
    if kind == 11:
        return "reference point of coefficients", about(values, r, MATRICES)
    if kind == 12:
        return "place of the crest", crest_at(values, r)
    if kind == 13:
        power = pick([-1, 1])
        omega = values.omega[:, None, None]
        return "damping over frequency", changed(values, ("radiation_damping",), lambda B: B * omega**power)
    if kind == 14:
        names = FORCES if random.random() < 0.5 else FORCES + MATRICES
        return "unit of rotations", times(values, names, pick([np.pi / 180, 180 / np.pi, 1e3, 1e-3, 0.3048]), ROTATION)
    return "unit of frequency", replace(values, omega=values.omega * pick([2 * np.pi, 1 / (2 * np.pi)]))


def bodies():
    """(name, Values, hull to hold them against, the size of changes of points in m)"""
    yield "ship", set_of(ship(36), 40.0, np.arange(0.3, 1.4, 0.1)), ship(36), np.array([15.0, 3.0, 3.0])
    omegas = np.arange(0.3, 1.8, 0.15)
    yield (
        "barge",
        set_of(box(40, 12, 3, panels=1000), np.inf, omegas),
        box(40, 12, 3, panels=1000),
        np.array([10, 3, 3]),
    )
    omegas = np.arange(0.6, 3.0, 0.2)
    hull = box(8, 8, 4, panels=800)
    yield "buoy", set_of(hull, 15.0, omegas), hull, np.array([3.0, 3.0, 3.0])


def changes_by_more(values, base, own):
    """Whether a coefficient or a force of the changed set is more than 10 % of its row off"""
    return max(gaps(values, own).values()) > max(gaps(base, own).values()) + 0.1


def right(cause, values, base):
    again = cause.correct(values)
    for name, data in base.quantities.items():
        if not np.allclose(again.quantities[name], data, rtol=0, atol=0.05 * np.abs(data).max()):
            return False
    off = np.exp(1j * again.wave_direction) - np.exp(1j * base.wave_direction)
    return np.allclose(again.omega, base.omega, rtol=1e-3) and np.abs(off).max() < 1e-3


def both(random, values, size):
    """(kinds, changed Values) of two changes, one after the other"""
    one, other = drawn(random, values, size)
    two, again = drawn(random, other, size)
    return (f"{one} + {two}", again) if one != two else both(random, values, size)


def tried(name, values, mesh, size, count, random, draw):
    """[(kind, "right", "told", "silent" or "small")] of so many changes"""
    own, rows, found = own_of(values, mesh), sample(values, mesh), []
    print(f"{name}: as it is {gaps(rows, own)}, {finding(rows, own)}")
    for _ in range(count):
        kind, other = draw(random, values, size)
        against = Own(mesh, other.water_depth, RHO, G, solved=own.solved)
        part = sample(other, mesh)
        said = finding(part, against)
        if said is None:
            found.append((kind, "silent" if changes_by_more(part, rows, against) else "small"))
        else:
            fits = said.cause is not None and right(said.cause, other, values)
            found.append((kind, "right" if fits else "told"))
            if not fits:
                cause = said.cause.text if said.cause else "no cause"
                print(f"  {name}, {kind}: {said.quantity} {said.gap:.3g}, {cause}, {said.left:.3g}")
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--changes", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--two", action="store_true")
    asked = parser.parse_args()
    random, found = np.random.default_rng(asked.seed), []
    made = list(bodies())
    for i, (name, values, mesh, size) in enumerate(made):
        found += tried(name, values, mesh, size, (asked.changes + i) // len(made), random, both if asked.two else drawn)
    kinds = [] if asked.two else sorted({kind for kind, _ in found})
    words = ("right", "told", "silent", "small")
    print(f"{'':34s}" + "".join(f"{word:>8s}" for word in words))
    for kind in (*kinds, "all"):
        counts = [sum(1 for k, w in found if w == word and kind in (k, "all")) for word in words]
        print(f"{kind:34s}" + "".join(f"{n:8d}" for n in counts))
    told = [w for _, w in found if w != "small"]
    print(f"right cause {100 * told.count('right') / len(told):.1f} %, silent {told.count('silent')} of {len(told)}")


if __name__ == "__main__":
    main()
