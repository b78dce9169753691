"""Fenders compressed by a body, and ropes from the body to a fixed point or to another body, compiled.

The face of a fender is at a in space. A flat side of the body touches the face. In the body's axes, this side has
the outward unit normal m and lies at the distance s from the origin x₀ + η; q = Rᵀ(a − x₀ − η) is the position of
the face:

    δ = s − c − m·q,    force on the body −N(δ) R m − T at a,    T = k_t u,  |T| ≤ μ N

u is the displacement, along the face, of the body's point at the fender; it is limited where the body slips (return
mapping). −N R m at a is the derivative of ∫N dδ, so an elastic fender conserves energy.  A rope runs from a to the
point p of the body:

    e = |x₀ + η + R p − a| − L₀,    pull T(e) towards a.

If a is on another body, a moves with that body, which receives the opposite force at a; u turns with the touched body.
Quantities with a history (u, and the state of `mooring.fenders.hysteresis`) keep the value from the start of a step;
`settle` stores their value at its end.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel

from ..fenders import hysteresis
from ..fenders.hysteresis import ContactTable
from .line_loads import give_generalized, push_shapes, reaction, rotation_of

advanced = kernel(inline=True, counted=False)(hysteresis.advanced_one)


ARM, OFFSET, FRICTION, SHEAR, ROPE = 3, 6, 7, 8, 9  # places in a row of `Contacts.numbers`, after a − x₀
DEPTH, STATE, SLIP, AT, FORCE = 0, 1, 2, 5, 8  # places in a row of `ContactWork`


@in_memory
class Contacts(NamedTuple):
    """Data of m fenders and ropes in the form that the kernels read.

    table : curves; numbers : (m, 10): a − x₀, m, or a in axes of the `other` body; normal m of the side, or p, m;
        s − c or L₀, m; μ; k_t, N/m; 1 for a rope, else 0
    body, other : (m,), number of the body that touches or is held, and of the body on which a lies, below 0 for none
    place : origins of the bodies' axes at rest, (N, 3) m
    bent : (2, m, f, 3), displacement, m, per unit of f shapes, of the contact's points on the other body and on its
        body, in their axes
    """

    table: ContactTable
    numbers: np.ndarray
    body: np.ndarray
    other: np.ndarray
    place: np.ndarray
    bent: np.ndarray


@in_memory
class ContactWork(NamedTuple):
    """start, now : (m, 9), values at the start of a step and now: δ or e, state of `hysteresis`, u (3) in space, q
    (3), force, N

    parts : forces of fenders and of ropes, (2, N, 6); arm : arm of a on the other body, (3,) m
    beyond : (1,), number of a contact that is beyond its table and refused, or −1
    bent : amplitudes of shapes, (f,), set by the caller; push : generalized forces of fenders and of ropes on
        shapes, (2, f)
    shift : displacement by shapes of the contact's point on its body, in that body's axes, (3,) m
    """

    start: np.ndarray
    now: np.ndarray
    parts: np.ndarray
    arm: np.ndarray
    beyond: np.ndarray
    bent: np.ndarray
    push: np.ndarray
    shift: np.ndarray


def contact_work(contacts):
    """`ContactWork` before any contact"""
    start = np.zeros((len(contacts.numbers), 9))
    start[:, DEPTH], start[:, STATE] = -np.inf, 1.0
    parts = np.zeros((2, len(contacts.place), 6))
    shapes = contacts.bent.shape[2]
    bent = np.zeros(shapes), np.zeros((2, shapes)), np.zeros(3)
    return ContactWork(start, start.copy(), parts, np.zeros(3), np.full(1, -1), *bent)


@kernel(inline=True, counted=False)
def pressed(contacts, work, i, depth):
    """Force, N, at a deflection or elongation, m; stores this value and its state"""
    state = advanced(work.start[i, STATE], work.start[i, DEPTH], depth, contacts.table.marks[i, 0])
    force = reaction(contacts.table, i, depth, state)
    work.now[i, DEPTH], work.now[i, STATE], work.now[i, FORCE] = depth, state, force
    return force


@kernel(counted=False)
def from_the_body(contacts, work, i, positions, R, v):
    """Fill v (3,) m, the arm from the origin of the body's axes to end a of contact i, and work.arm, the arm on the
    other body
    """
    b, other = contacts.body[i], contacts.other[i]
    c, bent = contacts.numbers, contacts.bent
    for j in range(3):
        v[j] = c[i, j] - positions[b, j]
        work.shift[j] = 0.0
        for k in range(work.bent.size):
            work.shift[j] += work.bent[k] * bent[1, i, k, j]
    if other >= 0:
        px, py, pz = c[i, 0], c[i, 1], c[i, 2]
        for k in range(work.bent.size):
            u = bent[0, i, k]
            px, py, pz = px + work.bent[k] * u[0], py + work.bent[k] * u[1], pz + work.bent[k] * u[2]
        for j in range(3):
            work.arm[j] = R[other, j, 0] * px + R[other, j, 1] * py + R[other, j, 2] * pz
            apart = contacts.place[other, j] - contacts.place[b, j]
            v[j] = apart + positions[other, j] + work.arm[j] - positions[b, j]


@kernel(counted=False)
def fender_force(contacts, work, i, R, v, f):
    """Fill f (3,), N in space, the force of fender i on its body at the arm v (3,) m from the origin of the body's
    axes
    """
    c, start, now, w = contacts.numbers, work.start, work.now, work.shift
    s = along = size = 0.0
    for j in range(3):
        f[j] = R[j, 0] * c[i, ARM] + R[j, 1] * c[i, ARM + 1] + R[j, 2] * c[i, ARM + 2]
        s += v[j] * f[j]
    if work.bent.size > 0:
        s -= w[0] * c[i, ARM] + w[1] * c[i, ARM + 1] + w[2] * c[i, ARM + 2]
    N = pressed(contacts, work, i, c[i, OFFSET] - s)
    turns = contacts.other[i] >= 0
    for j in range(3):
        now[i, AT + j] = R[0, j] * v[0] + R[1, j] * v[1] + R[2, j] * v[2] - w[j]
        # the body's point that was at the fender, from it, and what it had moved before
        x, y, z = start[i, AT] + w[0], start[i, AT + 1] + w[1], start[i, AT + 2] + w[2]
        moved = R[j, 0] * x + R[j, 1] * y + R[j, 2] * z - v[j]
        before = start[i, SLIP + j]
        if turns:
            before = R[j, 0] * start[i, SLIP] + R[j, 1] * start[i, SLIP + 1] + R[j, 2] * start[i, SLIP + 2]
        now[i, SLIP + j] = before + (moved if start[i, DEPTH] > 0.0 else 0.0)
        along += f[j] * now[i, SLIP + j]
    for j in range(3):
        now[i, SLIP + j] -= along * f[j]
        size += now[i, SLIP + j] ** 2
    pull, most = c[i, SHEAR] * np.sqrt(size), c[i, FRICTION] * N
    held = most / pull if pull > most else 1.0
    for j in range(3):
        now[i, SLIP + j] *= held
        f[j] = -N * f[j] - c[i, SHEAR] * now[i, SLIP + j]
    if turns:
        x, y, z = now[i, SLIP], now[i, SLIP + 1], now[i, SLIP + 2]
        for j in range(3):
            now[i, SLIP + j] = R[0, j] * x + R[1, j] * y + R[2, j] * z


@kernel(counted=False)
def rope_force(contacts, work, i, R, v, f):
    """Fill f (3,), N in space, the force of rope i on its body at the arm v (3,) m; before the call v leads to the
    other end
    """
    c, span, w = contacts.numbers, 0.0, work.shift
    for j in range(3):
        arm = R[j, 0] * (c[i, ARM] + w[0]) + R[j, 1] * (c[i, ARM + 1] + w[1]) + R[j, 2] * (c[i, ARM + 2] + w[2])
        f[j] = v[j] - arm
        v[j] = arm
        span += f[j] * f[j]
    span = np.sqrt(span)
    T = pressed(contacts, work, i, span - c[i, OFFSET])
    for j in range(3):
        f[j] *= T / span


@kernel(inline=True, counted=False)
def fender_on(contacts, work, i, b, R, v, f):
    """`fender_force` on body b; R : rotations of all bodies, (N, 3, 3)"""
    fender_force(contacts, work, i, R[b], v, f)


@kernel(inline=True, counted=False)
def rope_on(contacts, work, i, b, R, v, f):
    """`rope_force` on body b; R : rotations of all bodies, (N, 3, 3)"""
    rope_force(contacts, work, i, R[b], v, f)


@kernel(inline=True, counted=False)
def add_to(work, kind, b, positions, v, f):
    """Add a force at an arm to the forces of fenders or of ropes on body b."""
    give_generalized(positions[b], v, f, work.parts[kind, b])


@kernel(counted=False)
def contact_loads(contacts, work, positions, R, v, f):
    """Fill work.parts (2, N, 6), generalized forces of fenders and of ropes in heading axes; v, f : work arrays (3,)

    positions : positions of the bodies, (N, 6); R : rotations, (N, 3, 3), filled
    """
    for b in range(len(positions)):
        rotation_of(positions[b, 3:6], R[b])
    work.parts[:] = 0.0
    work.push[:] = 0.0
    work.beyond[0] = -1
    for i in range(len(contacts.numbers)):
        kind, b, other = 0, contacts.body[i], contacts.other[i]
        from_the_body(contacts, work, i, positions, R, v)
        if contacts.numbers[i, ROPE] > 0.0:
            kind = 1
            rope_on(contacts, work, i, b, R, v, f)
        else:
            fender_on(contacts, work, i, b, R, v, f)
        add_to(work, kind, b, positions, v, f)
        push_shapes(contacts.bent[1, i], R[b], f[0], f[1], f[2], work.push[kind])
        if other >= 0:
            for j in range(3):
                f[j] = -f[j]
            add_to(work, kind, other, positions, work.arm, f)
            push_shapes(contacts.bent[0, i], R[other], f[0], f[1], f[2], work.push[kind])
        if contacts.table.marks[i, 2] > 0.0 and work.now[i, DEPTH] > contacts.table.marks[i, 1]:
            work.beyond[0] = i


@kernel(counted=False)
def settle(work):
    """The end of a step becomes the start of the next."""
    for i in range(work.now.shape[0]):  # array to array takes two seconds to compile, for its error message
        for j in range(work.now.shape[1]):
            work.start[i, j] = work.now[i, j]


@kernel(counted=False)
def contacts_along(contacts, work, positions, R, v, f, depth, force, bent=None):
    """Depths and forces (n, m), m and N, with the bodies at positions (n, N, 6), one after the other

    bent : amplitudes of shapes, (n, f), None without shapes
    """
    for t in range(len(positions)):
        if bent is not None:
            for k in range(work.bent.size):
                work.bent[k] = bent[t, k]
        contact_loads(contacts, work, positions[t], R, v, f)
        settle(work)
        for i in range(len(contacts.numbers)):
            depth[t, i], force[t, i] = work.now[i, DEPTH], work.now[i, FORCE]
