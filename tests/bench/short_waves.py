"""Waves that are not resolved (`bem.contour.short_wave_frequency`) beside the same waves resolved, on random boxes.

    python tests/bench/short_waves.py [--quick] [--bodies 60] [--seed 0]

30 to 90 waves along a box, nine and more along its shorter side, kd 0.9 … 9, gap 0.005 … 10 drafts, five headings, of
which some go along a wall and some nearly so; tolerance 1 %.  Of every box the largest difference relative to the
scales of `bem.checks` and the largest over what is said to be left out (`bem.contour.short_waves`) and the difference
from a finer body, for A + iB/ω, for surge, sway and yaw, and for heave, roll and pitch; then quantiles of all headings.
"""

import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np
from bench.random_bodies import asked, between

from hakobune.bem.contour.one_frequency import ContourFrequency
from hakobune.bem.contour.short_wave_frequency import ShortWaveFrequency
from hakobune.bem.contour.solver import prepare_box

GRAVITY, DENSITY, TOLERANCE = 9.80665, 1025.0, 0.01
LENGTH, WAVES, SIDE, PHASE, GAP = 100.0, (30, 90), 9, (0.9, 9), (0.005, 10)
QUANTILES = (0.5, 0.75, 0.9, 0.97, 1)


def drawn(rng, most):
    """(length, beam, draft, depth) m, ω rad/s, headings rad"""
    waves = between(rng, WAVES[0], most)
    plan, k = [LENGTH, LENGTH / between(rng, 1, waves / SIDE)], 2 * np.pi * waves / LENGTH
    draft = between(rng, *PHASE) / k
    depth = draft * (1 + between(rng, *GAP))
    along, other = rng.choice([0, 90, 180, 270], 2)
    headings = [along, other + rng.normal(0, 3), *rng.uniform(0, 360, 3)]
    sizes = (*rng.permutation(plan), draft, depth)
    return sizes, np.sqrt(GRAVITY * k * np.tanh(k * depth)), np.radians(headings)


def first_order(body, solver, omega, headings):
    return solver(body, omega, headings, (), range(6), DENSITY, GRAVITY).result()


def compared(sizes, omega, headings):
    """Size of errors of A + iB/ω (6, 6) and excitation (m, 6), estimates of both, and the resolved `FirstOrder`"""
    body = prepare_box(*sizes, TOLERANCE)
    ours, fine = (first_order(b, ShortWaveFrequency, omega, headings) for b in (body, body.finer))
    exact, rough = (first_order(b, ContourFrequency, omega, headings) for b in (body.finer, body))
    found = []
    for name, left_out in zip(("radiation", "diffraction"), ours.neglected, strict=True):
        mine, finer, true, other = (getattr(r, name) for r in (ours, fine, exact, rough))
        error = np.maximum(np.abs(mine - true) - np.abs(other - true), 0)  # the resolved one errs too
        found.append((error, np.abs(mine - finer) + left_out))
    return *zip(*found, strict=True), exact


def scales(exact, reach):
    """As in `bem.checks`, of every heading alone"""
    size = np.sqrt(np.abs(np.diag(exact.radiation)))
    force = np.maximum(np.abs(exact.froude_krylov + exact.diffraction), np.abs(exact.diffraction))
    least = 0.2 * force[:, :3].max(axis=1)
    moment = np.maximum(0.2 * force[:, 3:].max(axis=1), 0.5 * least * reach)
    return np.outer(size, size), np.maximum(force, np.repeat(np.stack([least, moment], axis=1), 3, axis=1))


def ratio(error, allowed):
    return np.divide(error, allowed, out=np.zeros_like(error), where=allowed > 0)


def main(words=None):
    given = asked(words, __doc__, "one box of up to 32 waves, some seconds", 60, 0)
    table(*((1, given.seed, 32) if given.quick else (given.bodies, given.seed, WAVES[1])))


def table(count, seed, most):
    """most : waves along a box"""
    print("| length × beam × draft, depth m | waves | kd | A + iB/ω | X | over estimate: A + iB/ω | X₁₂₆ | X₃₄₅ | s |")
    print("|---|---|---|---|---|---|---|---|---|")
    rng, rows_of_all = np.random.default_rng(seed), []
    for _ in range(count):
        start, (sizes, omega, headings) = time.perf_counter(), drawn(rng, most)
        (Z, X), (Z_allowed, X_allowed), exact = compared(sizes, omega, headings)
        Z_scale, X_scale = scales(exact, np.hypot(*sizes[:2]) / 2)
        relative, over = X / X_scale, ratio(X, X_allowed)
        rows = np.column_stack([relative.max(axis=1), (X_allowed / X_scale).max(axis=1),
                                over[:, [0, 1, 5]].max(axis=1), over[:, 2:5].max(axis=1)])  # fmt: skip
        rows_of_all.append(rows)
        k = omega**2 / GRAVITY
        cells = [(Z / Z_scale).max(), rows[:, 0].max(), ratio(Z, Z_allowed).max(), *rows[:, 2:].max(axis=0)]
        name = "{:.3g} × {:.3g} × {:.3g}, {:.4g}".format(*sizes)
        numbers = f"{k * LENGTH / 2 / np.pi:.0f} | {k * sizes[2]:.2g} | " + " | ".join(f"{c:.1e}" for c in cells)
        print(f"| {name} | {numbers} | {time.perf_counter() - start:.1f} |", flush=True)
    names = ("error of X, relative", "estimate of X, relative", "X₁₂₆ over estimate", "X₃₄₅ over estimate")
    for name, values in zip(names, np.vstack(rows_of_all).T, strict=True):
        found = zip(QUANTILES, np.quantile(values, QUANTILES), strict=True)
        print(f"{name}: " + ", ".join(f"{q:g}: {v:.1e}" for q, v in found))


if __name__ == "__main__":
    main()
