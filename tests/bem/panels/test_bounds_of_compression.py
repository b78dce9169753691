"""What compression may change of coefficients and forces, by the inequality of Schwarz with made-up potentials."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.panels.compressed.one_frequency import CompressedRun


def test_bounds_are_the_norms_of_potentials_and_modes():
    """ρ ε ‖φ‖ ‖nⱼ‖ over all images, for forces times ω; the larger of both of a pair"""
    rng = np.random.default_rng(1)
    areas, modes = np.array([1.0, 2.0, 3.0]), rng.normal(size=(3, 6))
    potentials = {"even": rng.normal(size=(3, 3)) + 1j, "odd": rng.normal(size=(2, 3)) - 2j}
    columns = {"even": ([0, 2], [1]), "odd": ([1], [0])}  # numbers of moving modes and of waves
    members = {"even": [0, 2, 4], "odd": [1, 3, 5]}
    run = SimpleNamespace(
        hull=(None, areas), geometry=SimpleNamespace(copies=4, members=members.get), headings=[0, 1], omega=0.7,
        problem=SimpleNamespace(density=1000.0), prepared=SimpleNamespace(modes=modes), compression=1e-3,
        columns=columns, potentials=potentials,
    )  # fmt: skip
    radiation, excitation = CompressedRun.compression_errors.func(run)
    one = np.zeros((6, 6))
    forces = np.zeros((2, 6))

    def norm(values):
        return np.sqrt(4 * np.sum(areas * np.abs(values) ** 2))

    for i, row in ((0, 0), (2, 1)):
        for j in members["even"]:
            one[i, j] = norm(potentials["even"][row]) * norm(modes[:, j])
    for j in members["odd"]:
        one[1, j] = norm(potentials["odd"][0]) * norm(modes[:, j])
        forces[0, j] = 0.7 * norm(potentials["odd"][1]) * norm(modes[:, j])
    for j in members["even"]:
        forces[1, j] = 0.7 * norm(potentials["even"][2]) * norm(modes[:, j])
    assert radiation == pytest.approx(np.maximum(one, one.T)) and excitation == pytest.approx(forces)
