"""Bodies with hinges between them: stability at rest, and valid starts of a run."""

import numpy as np

from ..links import rows_at

TOGETHER = 1e-12  # m, rad: apart by less is rounding
TRIES = 50
OUT = 1e-6  # fraction of the stiffest motion; smaller negative restoring is rounding


def check_held(stiffness, body):
    """Raise ValueError for hinged bodies whose equilibrium at rest is unstable; stiffness : (n, n)."""
    scale = 1 / np.sqrt(np.diag(body.inertia))
    free = np.linalg.qr(body.free / scale[:, None])[0]
    K = free.T @ (0.5 * (stiffness + stiffness.T) * np.outer(scale, scale)) @ free
    values, ways = np.linalg.eigh(K)
    if len(values) and values[0] < -OUT * np.abs(values).max():
        worst = int(np.argmax(np.abs(free @ ways[:, 0])))
        names = ", ".join(link.name for link in body.links)
        raise ValueError(
            f"hinges {names}: {body.words[worst]} is unstable at rest, with ω² of {values[0]:.3g} 1/s², "
            "limit 0; lower center_of_gravity, or reduce the compression of the hinges"
        )


def begin_together(links, inverse, poses, speed, shapes=None):
    """Poses and velocities (N, 6) that satisfy the links, nearest to those given; inverse : inverse of the mass
    matrix, (n, n).

    shapes : amplitudes of shapes and their rates, (2, f), which are then added to the result; None without shapes
    raises : ValueError if no such poses lie nearby
    """
    poses, speed, rigid = np.array(poses, float), np.array(speed, float), np.size(poses)
    bent = np.zeros((2, 0)) if shapes is None else np.array(shapes, float)
    for _ in range(TRIES):
        G, gap = rows_at(links, poses, bent[0]) if bent.size else rows_at(links, poses)
        share = inverse @ G.T
        if np.abs(gap).max() < TOGETHER:
            both = np.append(speed.ravel(), bent[1])
            both = both - share @ np.linalg.solve(G @ share, G @ both)
            speed, bent[1] = both[:rigid].reshape(-1, 6), both[rigid:]
            return (poses, speed) if shapes is None else (poses, speed, bent)
        whole = -(share @ np.linalg.solve(G @ share, gap))
        step = whole[:rigid].reshape(-1, 6)
        bent[0] += whole[rigid:]
        step[:, :2] = [[np.cos(c) * x - np.sin(c) * y, np.sin(c) * x + np.cos(c) * y]
                       for c, (x, y) in zip(poses[:, 5], step[:, :2], strict=True)]  # fmt: skip
        poses += step
    raise ValueError(f"the offset leaves hinges {np.abs(gap).max():.3g} m or rad apart; give a smaller offset")
