"""The reference values of `hakobune bench`: writes its references.csv and says how sure they are.

    python tests/bench/solver_references.py

Cylinders are exact (Garrett 1971, Yeung 1981; `tests/exact/truncated_cylinder.py`), boxes by the contour method at its
finest tolerance.  What the printed lines say: cylinders with more functions in the gap, boxes against a tolerance of
1e-6 and against panels extrapolated from three meshes.  About two minutes.
"""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2]), str(Path(__file__).parents[1])]

import numpy as np
from exact.truncated_cylinder import TruncatedCylinder

from hakobune.bem.contour.solver import prepare_box
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box
from hakobune.pipelines.validation.bench.cases import CASES, DENSITY, GRAVITY, HEADING
from hakobune.pipelines.validation.bench.references import COLUMNS, FILE, Coefficients, compared

FINEST = 1e-7
BETA = np.radians(HEADING)
WANT = frozenset({"added_mass", "radiation_damping", "excitation_force"})
NOTES = (
    "Reference coefficients of the bench: A kg, kg m, kg m2; B per s; X N/m, N m/m per unit wave amplitude",
    "About the origin in the waterplane, time factor exp(-i omega t), waves towards {heading:g} degrees",
    "Density {density:g} kg/m3, gravity {gravity:g} m/s2; sizes and depths in pipelines/validation/bench/cases.py",
    "Cylinders: matched eigenfunctions, exact; boxes: contour method, tolerance {finest:g}",
    "Made by tests/bench/solver_references.py",
)


def collected(rows):
    """`Coefficients` of (A, B, X) at each frequency"""
    return Coefficients(*(np.array(values) for values in zip(*rows, strict=True)))


def exact(case, terms=20, modes=100):
    rows = []
    for omega in case.omega:
        sizes = case.sizes["radius"], case.sizes["draft"], case.depth
        body = TruncatedCylinder(*sizes, omega, DENSITY, GRAVITY, terms=terms, modes=modes)
        rows.append((body.added_mass(), body.damping(), body.excitation(BETA)))
    return collected(rows)


def contour(case, tolerance, omegas=None):
    body, rows = prepare_box(*case.sizes.values(), case.depth, tolerance), []
    for omega in omegas or case.omega:
        r = body.first_order(omega, [BETA], density=DENSITY, gravity=GRAVITY)
        rows.append((r.radiation.real, r.radiation.imag * omega, (r.froude_krylov + r.diffraction)[0]))
    return collected(rows)


def panels(case, counts, omegas=None):
    mesh, rows = box(*case.sizes.values(), counts=counts), []
    body = prepare(PanelProblem(mesh, lid(mesh), depth=case.depth, density=DENSITY, gravity=GRAVITY))
    for omega in omegas or case.omega:
        r = solve_frequency(body, omega, [BETA], WANT)
        rows.append((r["added_mass"], r["radiation_damping"], r["excitation_force"][0]))
    return collected(rows)


def extrapolated(case, omegas=None, coarse=(4, 3, 2)):
    """Panels of three sizes 3 : 2 : 1 carried on to none: c + (c − c′) / (1.5^p − 1), p from the three.

    Where the three do not converge at an order between 1 and 4 the order is 2.
    """
    coarse, middle, fine = (panels(case, tuple(n * times for n in coarse), omegas).named() for times in (1, 2, 3))
    out = {}
    for name, c in fine.items():
        first, second = np.abs(middle[name] - coarse[name]).max(), np.abs(c - middle[name]).max()
        orders = np.linspace(1.0, 4.0, 301)
        ratio = (1 - 2.0**-orders) / (2.0**-orders - 3.0**-orders)
        p = 2.0 if second == 0 else orders[np.abs(ratio - first / second).argmin()]
        p = p if orders[0] < p < orders[-1] else 2.0
        out[name] = c + (c - middle[name]) / (1.5**p - 1)
    return out


def apart(case, one, two):
    """Largest difference of two sets of named values, as the bench measures errors, and of what"""
    sizes = compared(case, one)
    errors = {name: np.abs(one[name] - two[name]).max() / size for name, size in sizes.items()}
    worst = max(errors, key=errors.get)
    return f"{errors[worst]:.1e} ({worst})"


def row(case, omega, values):
    cells = []
    for name in COLUMNS:
        value = values[name.split("_")[0]]
        cells.append(f"{value.imag if name.endswith('im') else value.real:.12g}")
    return ",".join((case.name, f"{omega:g}", *cells))


def main():
    words = {"heading": HEADING, "density": DENSITY, "gravity": GRAVITY, "finest": FINEST}
    lines = [f"# {note.format(**words)}" for note in NOTES] + [",".join(("case", "omega", *COLUMNS))]
    for case in CASES.values():
        if case.shape == "buoy":
            values = exact(case).named()
            print(f"{case.name}: more functions {apart(case, values, exact(case, 28, 200).named())}", flush=True)
        else:
            values = contour(case, FINEST).named()
            rougher, carried = contour(case, 1e-6).named(), extrapolated(case)
            print(
                f"{case.name}: tolerance 1e-6 {apart(case, values, rougher)}, "
                f"extrapolated panels {apart(case, values, carried)}",
                flush=True,
            )
        for i, omega in enumerate(case.omega):
            lines.append(row(case, omega, {name: value[i] for name, value in values.items()}))
    FILE.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
