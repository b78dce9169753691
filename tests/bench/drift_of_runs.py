"""Mean drift over seeds of `hakobune simulate` with a current, beside what `moor` adds for the same study.

    python tests/bench/drift_of_runs.py DATABASE [SEEDS] [SECONDS]

The study of `hakobune new simulation` (12 chains that move, wind and gusts, Hs 4.5 m, 3 kn) with a database of its
scene.  A file of runs has no forces, so runs are made here, and the drift is summed anew over the wave components of
each seed, where the slow body is and as it is turned:

    F(t) = |Σ aᵢ √D⁺ᵢ exp{i(kᵢ·r + εᵢ − σᵢt)}|² − |Σ aᵢ √D⁻ᵢ exp{…}|² − B ṙ,    σ = ω + k·V,  D = D₀ + B V

Printed are the means over the seeds with their 95 % band, that of `moor`, and that of still water.
"""

import sys
import tomllib
from pathlib import Path

import numpy as np
from scipy.stats import t as student

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT)]

from hakobune.bem.database import open_database
from hakobune.bem.waves import wavenumber
from hakobune.mooring.motion.simulation import simulate, wave_components
from hakobune.mooring.motion.slow_damping import drift_damping_ring
from hakobune.mooring.motion.tables.wave_windows import HEADINGS
from hakobune.mooring.motion.wave_loads import drift_on_current
from hakobune.pipelines.moor.result import studied
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.simulate.work import Task, prepared

AT_ONCE = 500  # times


def drift_on_the_way(body, weather, settings, seed, run):
    """(n, 3) N, N, N m in the axes of the body, of long-crested waves"""
    reader, place = body.reader, (body.reader.depth, body.reader.gravity)
    omega, a, phase, towards = (np.asarray(part, float) for part in wave_components(body, weather, settings, seed))
    held = np.clip(omega, body.waves.omega[0], body.waves.omega[-1])
    D = drift_on_current(body.waves, held, towards, weather.carrier.velocity, *place)
    k = wavenumber(omega, reader.depth, reader.gravity)[:, None] * np.stack([np.cos(towards), np.sin(towards)], -1)
    met = omega + k @ np.asarray(weather.carrier.velocity)
    ring, out = np.arange(HEADINGS + 1) * (2 * np.pi / HEADINGS), np.zeros((len(run.time), 3))
    around = np.concatenate([D, D[:, :1]], axis=1)
    for some in np.array_split(np.arange(len(run.time)), len(run.time) // AT_ONCE + 1):
        x, y, turned = run.slow[some].T
        t = run.time[some] + settings.ramp
        E = a * np.exp(1j * (np.outer(x, k[:, 0]) + np.outer(y, k[:, 1]) + phase - np.outer(t, met)))
        at = np.mod(towards[0] - turned, 2 * np.pi) / ring[1]
        low = at.astype(int)
        d = around[:, low] + (at - low)[:, None] * (around[:, low + 1] - around[:, low])
        for j in range(3):
            up, down = (np.sqrt(np.maximum(sign * d[..., j].T, 0.0)) for sign in (1, -1))
            out[some, j] = np.abs((E * up).sum(1)) ** 2 - np.abs((E * down).sum(1)) ** 2
    B = drift_damping_ring(body.waves.omega, *body.drift_slopes, weather)
    at_rest = B[(len(B) - HEADINGS) // 2].reshape(3, 2)
    (u, v), psi = np.gradient(run.slow[:, :2], run.time, axis=0).T, run.slow[:, 2]
    along = np.stack([np.cos(psi) * u + np.sin(psi) * v, np.cos(psi) * v - np.sin(psi) * u], axis=-1)
    return out - along @ at_rest.T


def main(database, seeds=20, seconds=600.0):
    raw = tomllib.loads((ROOT / "pipelines" / "scenes" / "simulate_chain_12.toml").read_text(encoding="utf-8"))
    raw["simulation"] = {}
    study = make_study(raw)
    body, plan, _ = prepared(Task(study, database, seconds, None))
    effects, means = studied(study, open_database(database))[0].waves["irregular"], []
    for seed in range(1, seeds + 1):
        run = simulate(body, plan.weather, plan.settings, seed)
        means.append(drift_on_the_way(body, plan.weather, plan.settings, seed, run)[run.time >= 0].mean(axis=0))
    half = student.ppf(0.975, seeds - 1) * np.std(means, axis=0, ddof=1) / np.sqrt(seeds)
    for j, name in enumerate(("Fx, kN", "Fy, kN", "Mz, kN m")):
        mean, band, moor, by_current = 1e-3 * np.array(
            [np.mean(means, axis=0)[j], half[j], effects.drift[j], effects.by_current[j]]
        )
        where = "inside" if abs(mean - moor) <= band else "OUTSIDE"
        print(f"{name:9} {mean:9.1f} ± {band:6.1f}   moor {moor:9.1f} {where}, in still water {moor - by_current:9.1f}")


if __name__ == "__main__":
    main(sys.argv[1], *(kind(value) for kind, value in zip((int, float), sys.argv[2:4], strict=False)))
