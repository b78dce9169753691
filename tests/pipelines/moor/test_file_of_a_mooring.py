"""The file of results of `hakobune moor`: every number of a result that is made up, under its name, with its unit."""

import hashlib
from types import SimpleNamespace

import h5py
import numpy as np
import pytest

from hakobune.pipelines.moor import command

SIX = "m, m, m, rad, rad, rad"
UNITS = {
    "equilibrium": "m, m, rad", "heel": "rad, rad", "residual": "N, N, N m",
    "mooring_stiffness": "N/m, N/rad, N m/m, N m/rad", "motion_amplitude": SIX, "loads/wind": "N, N, N, N m, N m, N m",
    "loads/current": "N, N, N, N m, N m, N m", "waves/irregular/drift": "N, N, N m",
    "waves/irregular/motion_amplitude": SIX, "waves/irregular/drift_by_current": "N, N, N m",
    "waves/regular_wave/drift": "N, N, N m", "waves/regular_wave/motion_amplitude": SIX,
    "natural_periods/at_rest/period": "s", "natural_periods/at_rest/shape": "1",
    "natural_periods/at_equilibrium/period": "s", "natural_periods/at_equilibrium/shape": "1",
    "lines/pretension": "N", "lines/horizontal_pretension": "N", "lines/static_tension": "N",
    "lines/maximum_tension": "N", "lines/utilisation": "1", "lines/maximum_vertical_anchor_force": "N",
    "lines/maximum_horizontal_anchor_force": "N", "lines/grounded_length_at_rest": "m",
    "lines/grounded_length_at_maximum": "m", "lines/fairlead_outward": "m", "lines/fairlead_upward": "m",
    "lines/breaking_load": "N", "lines/length": "m", "lines/anchor": "m", "lines/fairlead": "m",
}  # fmt: skip


def lines(start):
    made = {"tension_b": 0, "horizontal_b": 2, "vertical_a": 4, "horizontal_a": 6, "grounded_length": 8}
    return SimpleNamespace(**{name: start + by + np.arange(2.0) for name, by in made.items()})


def periods(start):
    return SimpleNamespace(names=("surge", "sway", "yaw"), period=start + np.arange(3.0), scale=start,
                           shapes=start + np.arange(9.0).reshape(3, 3))  # fmt: skip


@pytest.fixture
def made(monkeypatch):
    ends = 900 + np.arange(6.0).reshape(2, 3), 950 + np.arange(6.0).reshape(2, 3)
    monkeypatch.setattr(command, "line_ends", lambda rest: ends if rest.kind == "rest" else None)
    irregular = SimpleNamespace(drift=100 + np.arange(3.0), amplitudes=110 + np.arange(6.0),
                                by_current=120 + np.arange(3.0))  # fmt: skip
    regular = SimpleNamespace(drift=130 + np.arange(3.0), amplitudes=140 + np.arange(6.0), by_current=None)
    equilibrium = SimpleNamespace(lines=lines(200), residual=210 + np.arange(6.0),
                                  stiffness=220 + np.arange(9.0).reshape(3, 3))  # fmt: skip
    system = SimpleNamespace(line_names=("bow", "stern"), breaking_load=np.array([500.0, np.inf]),
                             lines=[SimpleNamespace(length=61.0), SimpleNamespace(length=62.0)])  # fmt: skip
    return SimpleNamespace(
        allowable=0.4, conditions=SimpleNamespace(motion_factor=1.5, method="irregular"), warnings=("one", "two"),
        displacement=1 + np.arange(3.0), heel=np.array([5.0, 6.0]), equilibrium=equilibrium,
        amplitudes=10 + np.arange(6.0), loads={"wind": 20 + np.arange(6.0), "current": 30 + np.arange(6.0)},
        waves={"irregular": irregular, "regular_wave": regular}, at_rest=periods(40.0), at_equilibrium=periods(60.0),
        system=system, rest=SimpleNamespace(kind="rest", lines=lines(300)), extreme=lines(400),
        tension=np.array([71.0, 72.0]), utilisation=np.array([0.2, 0.3]), outward=np.array([81.0, 82.0]),
        upward=np.array([91.0, 92.0]),
    )  # fmt: skip


def test_every_number_is_written_under_its_name_with_its_unit(made, tmp_path):
    database = tmp_path / "box.h5"
    database.write_bytes(b"a database")
    command.write_result(tmp_path / "out.h5", made, "the study", database)
    with h5py.File(tmp_path / "out.h5") as file:
        held, units, attrs = {}, {}, dict(file.attrs)

        def keep(name, item):
            if isinstance(item, h5py.Dataset) and name != "lines/name":
                held[name], units[name] = item[()], item.attrs["units"]

        file.visititems(keep)
        names = list(file["lines/name"].asstr())
        method, modes = file["waves"].attrs["method"], list(file["natural_periods"].attrs["modes"])
        scales = [file[f"natural_periods/{one}"].attrs["rotation_scale"] for one in ("at_rest", "at_equilibrium")]
    assert units == UNITS
    first = {name: np.ravel(values)[0] for name, values in held.items()}
    assert [first[name] for name in UNITS] == [
        1, 5, 210, 220, 10, 20, 30, 100, 110, 120, 130, 140, 40, 40, 60, 60,
        300, 302, 200, 71, 0.2, -404, 406, 308, 408, 81, 91, 500, 61, 900, 950,
    ]  # fmt: skip
    assert held["residual"] == pytest.approx([210, 211, 215])  # of the plane: surge, sway, yaw
    assert {name: values.shape for name, values in held.items() if values.ndim > 1} == {
        "mooring_stiffness": (3, 3), "natural_periods/at_rest/shape": (3, 3), "lines/anchor": (2, 3),
        "natural_periods/at_equilibrium/shape": (3, 3), "lines/fairlead": (2, 3),
    }  # fmt: skip
    assert (names, method, modes, scales) == (["bow", "stern"], "irregular", ["surge", "sway", "yaw"], [40.0, 60.0])
    assert attrs == {
        "schema": command.SCHEMA, "study": "the study", "database": str(database), "allowable": 0.4,
        "database_sha256": hashlib.sha256(b"a database").hexdigest(), "motion_factor": 1.5, "warnings": "one\ntwo",
    }  # fmt: skip


def test_a_result_without_waves_has_none_in_its_file(made, tmp_path):
    made.waves = {}
    command.write_result(tmp_path / "out.h5", made, "", command.Path(__file__))
    with h5py.File(tmp_path / "out.h5") as file:
        assert "waves" not in file and "loads" in file
