"""What is kept of forces of pairs of waves beside the database that holds them: how large each part is."""

from __future__ import annotations

import numpy as np

from hakobune.bem.second_order.kinds import SUM

from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result, labels
from .report import ALL, MODES, NAMES, diagonal_gap, failures, levels, notes, parts_of_sums

SMALL = 1e-6  # of the largest force, m beside N: what symmetry makes zero
ARM = 100.0  # m, by which a moment is divided to stand beside forces


def result_of(stored, db):
    """Result of `StoredForces` of an open database: root mean square of the force with each next part"""
    forces, sums = stored.forces, stored.forces.kind is SUM
    rows = list(_rows(forces, sums))
    parts = list(rows[0][3]) if rows else []
    title = f"force of pairs at {forces.kind.name}s of frequencies, root mean square, with each next part"
    units = tuple("N m/m2" if name in ("roll", "pitch", "yaw") else "N/m2" for _, name, _, _ in rows)
    made = {
        f"force.{_key(part)}": Quantity([row[3][part] for row in rows], ("force",), units, part, title)
        for part in parts
    }
    words = [f"{np.degrees(beta):.4g}° {name}, {frequency:.4g} rad/s" for beta, name, frequency, _ in rows]
    gap = None if sums else diagonal_gap(forces)
    for name, value, word in (
        ("drift_apart", gap, "mean drift by pressure off that of the far field"),
        ("surface_share", stored.share, "forcing of the surface, of the force"),
    ):
        if value is not None:
            made[name] = Quantity(float(value), (), "", word, "checks", share=True)
    return Result("qtf", made, labels("force", words), tuple(failures(stored)), tuple(notes(stored)),
                  provenance=provenance(database=db), detail=stored)  # fmt: skip


def _key(part):
    return part.removeprefix("+ ").lower().replace(" ", "_").replace("_+_", "_and_")


def _rows(forces, sums):
    """(heading, rad; motion; frequency, rad/s; {part: root mean square}) of equal headings"""
    motions = list(enumerate(ALL)) if sums else list(zip(MODES, NAMES, strict=True))
    most = 4 if sums else 5
    chosen = sorted({*np.linspace(0, len(forces.frequency) - 1, most).astype(int)})
    for h, beta in enumerate(forces.headings):
        whole = np.nanmax(np.abs(forces.total[:, :, h, h, : 3 if sums else 2]))
        for mode, name in motions:
            found = parts_of_sums(forces, mode, h) if sums else levels(forces, mode, h)
            if np.nanmax(np.abs(found["+ body"])) < SMALL * whole * (1.0 if mode < 3 else ARM):
                continue
            for m in chosen:
                yield (
                    beta,
                    name,
                    forces.frequency[m],
                    {part: float(np.sqrt(np.nanmean(np.abs(value[m]) ** 2))) for part, value in found.items()},
                )
