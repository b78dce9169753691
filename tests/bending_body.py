"""Readers of made-up bodies that bend, whose coefficients are straight in frequency and couple all motions."""

from dataclasses import replace

import numpy as np
from made_up_body import INERTIA, OMEGA, STIFFNESS, force
from two_bodies import coupled_bodies

from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.reader import Reader
from hakobune.bem.flexible.beams import Beam
from hakobune.bem.modes import Mode

AROUND = np.arange(24) * (np.pi / 12)
KINDS = ("vertical bending", "torsion")


def shapes(count, kinds, more=1.0, **where):
    """`Mode`s of a beam of 100 m; more : times its stiffness"""
    per_length = {"torsion": 1.2e8}
    return tuple(
        Mode(f"{kind.replace(' ', '_')}_{n}", kind == "torsion",
             Beam(kind, n, -50.0, 50.0, 0.0, more * 5e10, per_length.get(kind, 5e5)), **where)
        for kind in kinds for n in range(1, count + 1)
    )  # fmt: skip


def with_shapes(rigid, modes, coupled=True):
    """A Reader with `modes` beside its motions: their mass and stiffness, added mass of half of it and more, damping"""
    rng, f, n = np.random.default_rng(5), len(modes), len(rigid.inertia)
    M, C = (np.zeros((n + f, n + f)) for _ in range(2))
    M[:n, :n], C[:n, :n] = rigid.inertia, rigid.stiffness
    M[n:, n:], C[n:, n:] = (np.diag([getattr(mode.shape, key) for mode in modes]) for key in ("mass", "stiffness"))
    root = np.sqrt(np.diag(M))
    mix = 0.03 * coupled * rng.normal(size=(n + f, n + f)) * np.outer(root, root)
    mix = mix + mix.T
    mix[:n, :n] = 0.0
    mix[n:, n:] += M[n:, n:]
    at = modes[0].body * 6 if rigid.bodies else 0
    first = min(at, n - 6) + 2
    pressed = (
        0.05 * coupled * rng.normal(size=(3, f)) * np.sqrt(np.outer(np.diag(C)[first : first + 3], np.diag(M)[n:]))
    )
    C[first : first + 3, n:] += pressed
    C[n:, first : first + 3] += pressed.T

    def stored(name, values):
        if name == "excitation_force":
            i = np.arange(f)
            phase = np.exp(1j * (0.5 * i + np.cos(AROUND)[:, None] + 0.3 * np.sin(AROUND)[:, None]))
            own = (1 + OMEGA)[:, None, None] * (1e6 + 2e5 * i) * phase * (root[n:] / root[n])
            return np.concatenate([values, own], axis=-1)
        share = {"added_mass": 0.5 + 0.2 * OMEGA, "radiation_damping": 0.01 + 0.02 * OMEGA}[name]
        out = share[:, None, None] * mix
        out[:, :n, :n] = values
        return out

    quantities = {name: stored(name, values) for name, values in rigid.between.quantities.items()}
    between = replace(rigid.between, quantities=quantities, shapes=(first // 6,) * f)
    damping = np.diag(np.append(np.zeros(n), 0.04 * np.sqrt(np.diag(M) * np.diag(C))[n:]))
    return replace(rigid, between=between, inertia=M, stiffness=C, damping=damping, modes=modes)


def bending(count, more=1.0, coupled=True, kinds=KINDS):
    """Reader of one body of so many shapes of each kind"""
    added, damping = (share[:, None, None] * INERTIA for share in (0.5 + 0.2 * OMEGA, 0.01 + 0.02 * OMEGA))
    stored = {"added_mass": added, "radiation_damping": damping,
              "excitation_force": np.array([force(w, AROUND) for w in OMEGA])}  # fmt: skip
    plan = 50.0 * np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    between = Between(OMEGA, stored, 20.0, 9.80665, AROUND, np.zeros(1), plan)
    rigid = Reader(between, 1025.0, np.zeros(3), INERTIA, STIFFNESS, np.zeros((6, 6)))
    return with_shapes(rigid, shapes(count, kinds, more), coupled)


def two_of_which_one_bends(count, kinds=KINDS):
    """Reader of the bodies of `two_bodies`; the barge, which heads astern, bends"""
    where = {"body": 2, "place": (10.0, -30.0), "heading": np.pi}
    return with_shapes(coupled_bodies(AROUND), shapes(count, kinds, **where))


class Turned:
    """The shape of a hinge: nothing needs to know how it moves points"""

    turns = True

    def displacement(self, points):
        return np.zeros_like(points)


def hinged_as_a_shape(pair, link):
    """Reader of one body whose six motions and one shape are those that a hinge leaves to a pair, and (12, 7) how these
    move the pair

    The motions are those of the whole about the first body's rotation centre, along its axes; the shape turns the
    second body about the hinge's axis, x, by 1 rad.
    """
    first, second = (one for one in pair.bodies if not one.fixed)
    to_pair = np.zeros((12, 7))
    for k, body in enumerate((first, second)):
        turn = np.kron(np.eye(2), body.axes.T)
        for column, center in ((slice(0, 6), first.rotation_center), (slice(6, 7), first.in_scene(link.position))):
            x, y, z = np.subtract(body.rotation_center, center)
            cross = np.array([[0, z, -y], [-z, 0, x], [y, -x, 0]])
            moves = np.block([[np.eye(3), cross], [np.zeros((3, 3)), np.eye(3)]])
            if column == slice(6, 7):
                moves = moves[:, 3:4] * k
            to_pair[6 * k : 6 * k + 6, column] = turn @ moves

    def both_sides(matrix):
        return to_pair.T @ matrix @ to_pair

    stored = pair.between.quantities
    quantities = {name: both_sides(stored[name]) for name in ("added_mass", "radiation_damping")}
    quantities["excitation_force"] = stored["excitation_force"] @ to_pair
    between = replace(pair.between, quantities=quantities, outlines=(), shapes=(0,))
    made = Reader(
        between, pair.density, np.array(first.rotation_center), both_sides(pair.inertia), both_sides(pair.stiffness),
        np.zeros((7, 7)), modes=(Mode("hinge", True, Turned()),),
    )  # fmt: skip
    return made, to_pair
