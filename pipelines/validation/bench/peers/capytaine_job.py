"""Capytaine's side of the bench: a job on standard input, one line of JSON on standard output.

The job: hull and lid ({"vertices", "faces"}; lid may be null), symmetry ("xy": a quarter is given; "rotation": one of
`copies` wedges; "": everything), depth, omega, heading (rad), density, gravity, method ("direct" or "indirect"),
quadrature (name or null), and what `repeated` takes.  The default Green function is used. The alternative for finite
depth, FinGreen3D, gives NaN on lids; with a quadrature its roll damping of the box is wrong by 100 %.
"""

import numpy as np
from repeated import answer, job, repeated


def mesh(part, job):
    import capytaine as cpt

    made = cpt.Mesh(vertices=np.array(part["vertices"]), faces=np.array(part["faces"]))
    if job["quadrature"]:
        made = made.with_quadrature(job["quadrature"])
    if job["symmetry"] == "xy":
        half = cpt.ReflectionSymmetricMesh(made, plane="xOz")
        return cpt.ReflectionSymmetricMesh(half, plane="yOz")
    return cpt.RotationSymmetricMesh(made, n=job["copies"]) if job["symmetry"] == "rotation" else made


def make(job):
    import capytaine as cpt

    cpt.set_logging("ERROR")
    lid = mesh(job["lid"], job) if job["lid"] else None
    dofs = cpt.rigid_body_dofs(rotation_center=(0, 0, 0))
    body = cpt.FloatingBody(mesh(job["hull"], job), dofs=dofs, lid_mesh=lid, center_of_mass=(0, 0, 0))
    return body, cpt.BEMSolver(method=job["method"])


def solve(made, omega, job):
    """A (6, 6), B (6, 6), X (6,)"""
    import capytaine as cpt

    body, solver = made
    water = {
        "body": body,
        "omega": omega,
        "water_depth": job["depth"],
        "rho": job["density"],
        "g": job["gravity"],
    }
    problems = [cpt.RadiationProblem(radiating_dof=dof, **water) for dof in body.dofs]
    problems.append(cpt.DiffractionProblem(wave_direction=job["heading"], **water))
    *moving, wave = (solver.solve(p, keep_details=False, _check_wavelength=False) for p in problems)
    names = list(body.dofs)
    A = [[r.added_masses[i] for r in moving] for i in names]
    B = [[r.radiation_dampings[i] for r in moving] for i in names]
    incident = cpt.bem.airy_waves.froude_krylov_force(problems[-1])
    return np.array(A), np.array(B), np.array([wave.forces[i] + incident[i] for i in names])


def main():
    import capytaine as cpt

    asked = job()
    results, times = repeated(asked, lambda: make(asked), lambda made, omega: solve(made, omega, asked))
    A, B, X = (np.array(values) for values in zip(*results, strict=True))
    found = {"A": A.tolist(), "B": B.tolist(), "X": [X.real.tolist(), X.imag.tolist()]}
    answer({**times, **found, "version": cpt.__version__})


if __name__ == "__main__":
    main()
