"""Checks before a run of flexible bodies: whether their shapes can be followed in time."""

import numpy as np

FASTEST = 300.0  # rad/s of a shape: explicit steps are 3 over that, 10 ms


def check_bending(body, free):
    """Raise ValueError for a Reader whose shapes cannot be followed; free : numbers of the free motions"""
    held = [body.words[i] for i in range(body.rigid, len(body.words)) if i not in free]
    if held and body.links:
        raise ValueError(
            f"simulation.motions holds {', '.join(held)}, and hinges "
            f"{', '.join(one.name for one in body.links)} are given; with hinges no shape may be held; solve "
            "fewer shapes (count)"
        )
    added = body.held_added_mass(np.inf)[0]
    for i in range(body.rigid, len(body.words)):
        omega = np.sqrt(max(body.stiffness[i, i], 0.0) / (body.inertia[i, i] + added[i, i]))
        if i in free and omega > FASTEST:
            raise ValueError(
                f"{body.words[i]} has a natural frequency of {omega:.3g} rad/s, limit {FASTEST:g}: a run would "
                "need far shorter steps than waves need; solve fewer shapes (count), or hold it by simulation.motions"
            )
