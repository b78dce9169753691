"""Our side of the bench, in a process of its own: a job on standard input, one line of JSON on standard output.

    python -m pipelines.validation.bench.ours

The job: case (name), method ("contour" or "panel"), tolerance or panels, and what `peers.repeated` takes; with "band"
the frequencies share their work as many of them do (`bem.panels.band.equations`).  The body is prepared from a
scene, as the
commands do; the estimate of the error is made, and timed, after everything else.
"""

import time
from dataclasses import replace

from .cases import CASES, DENSITY, GRAVITY, HEADING
from .peers.repeated import answer, job, repeated

WANT = ("radiation", "excitation_force")
FINEST = 1e-5  # tolerance of a scene; the contour method itself goes further


def scene_of(case, asked):
    """The scene a user would write"""
    from hakobune.pipelines.scene.scene import make_scene

    fineness = {"panels": asked["panels"]} if "panels" in asked else {"tolerance": max(asked["tolerance"], FINEST)}
    return make_scene(
        {
            "water": {"depth": case.depth, "density": DENSITY, "gravity": GRAVITY},
            "bodies": [{"shape": case.shape, **case.sizes}],
            "waves": {"omegas": list(asked["omega"]), "headings_deg": [HEADING]},
            "method": asked["method"],
            "want": list(WANT),
            **fineness,
        }
    )


def make(case, asked):
    """The scene and the body, prepared"""
    from hakobune.bem.methods.panel_problem import prepare
    from hakobune.pipelines.solve.plan import planned

    scene = scene_of(case, asked)
    plan = planned(scene)
    problem, omegas = plan.problem, plan.omegas
    if "tolerance" in asked:
        problem = replace(problem, tolerance=asked["tolerance"])
    if asked.get("band"):
        problem = replace(problem, band=(float(omegas.min()), float(omegas.max())))
    return scene, prepare(problem)


def solve(made, omega):
    """The solved frequency and its results: `bem.frequency.solve_frequency` without the estimate of the error"""
    from hakobune.bem import DOFS

    scene, prepared = made
    run = prepared.run(omega, scene.headings(), scene.names(), None, DOFS)
    return run, run.result()


def estimates(runs):
    """The largest estimated error, and the mean ms of an estimate; the first is not counted"""
    values, taken = [], []
    for run in runs:
        start = time.perf_counter()
        values.append(float(run.estimated_error()))
        taken.append(1e3 * (time.perf_counter() - start))
    return {"estimate": max(values), "estimating_ms": sum(taken[1:]) / max(1, len(taken) - 1)}


def answered(asked):
    """Times, estimated errors and coefficients of a job, as plain values"""
    import numpy as np

    case = CASES[asked["case"]]
    results, times = repeated(asked, lambda: make(case, asked), solve)
    runs, found = zip(*results, strict=True)
    names = "added_mass", "radiation_damping", "excitation_force"
    A, B, X = (np.array([row[name] for row in found]) for name in names)
    problem = runs[0].problem
    return {
        **times,
        **estimates(runs),
        "panels": problem.mesh.total if asked["method"] == "panel" else None,
        "A": A.tolist(),
        "B": B.tolist(),
        "X": [X[:, 0].real.tolist(), X[:, 0].imag.tolist()],
    }


if __name__ == "__main__":
    answer(answered(job()))
