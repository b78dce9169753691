"""A database that grows, with the real solver: nothing stored is solved again, and the numbers are those of one run."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.database.schema import LIMITS, ONLY_BY_NAME, QUANTITIES
from hakobune.pipelines.executors.choice import Here
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve import plan
from hakobune.pipelines.solve.run import solve
from hakobune.pipelines.solve.work import solve_one

RADIATION = frozenset({"added_mass", "radiation_damping"})
FORCES = frozenset({"Froude_Krylov_force", "diffraction_force", "excitation_force"})


class Counting(Here):
    """Works here and notes the frequencies it is asked for, with their headings in degrees and products."""

    def __init__(self):
        self.asked = []

    def submit(self, function, problem, *arguments):
        if function is solve_one:
            omega, headings, want, _ = arguments
            self.asked.append((round(omega, 9), tuple(np.round(np.degrees(headings), 9)), want))
        else:
            self.asked.append(arguments[0])
        return super().submit(function, problem, *arguments)


def made(path, omegas, headings, want):
    """What was solved when the scene was asked for with these."""
    body = {"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0, "gyration": [6, 12, 13]}
    raw = {"water": {"depth": 20.0}, "bodies": [body], "panels": 40, "want": want}
    executor = Counting()
    scene = make_scene({**raw, "waves": {"omegas": omegas, "headings_deg": headings}})
    outcome = solve(scene, path, executor=executor)
    assert outcome.exit_status == 0 and outcome.jobs == len(executor.asked)
    return executor.asked


@pytest.fixture(scope="module")
def grown(tmp_path_factory):
    """A database grown in four steps, and what each of them solved."""
    path = tmp_path_factory.mktemp("grown") / "box.h5"
    steps = [
        ([0.4, 0.8], [0], ["radiation", "diffraction"]),
        ([0.4, 0.6], [0], ["radiation"]),
        ([0.4], [0, 30], ["radiation"]),
        ([0.4], [0], ["limits", "motions", "pressure"]),
        ([0.8], [30], ["added_mass", "pressure"]),
    ]
    return path, [made(path, *step) for step in steps]


def test_more_frequencies_are_solved_alone(grown):
    first, more, *_ = grown[1]
    assert [asked[0] for asked in first] == [0.4, 0.8]
    assert more == [(0.6, (0.0,), RADIATION | FORCES)]


def test_more_headings_are_solved_alone_and_radiation_is_not(grown):
    assert grown[1][2] == [(omega, (30.0,), FORCES) for omega in (0.4, 0.6, 0.8)]


def test_more_products_are_solved_alone(grown):
    *rows, zero, infinity = grown[1][3]
    assert rows == [(omega, (0.0, 30.0), {"rao", "pressure"}) for omega in (0.4, 0.6, 0.8)]
    assert (zero, infinity) == LIMITS


def test_what_is_stored_is_not_solved_again(grown):
    assert grown[1][4] == []


def test_a_grown_database_has_the_numbers_of_one_made_at_once(grown, tmp_path):
    whole = tmp_path / "box.h5"
    made(whole, [0.4, 0.6, 0.8], [0, 30], ["radiation", "diffraction", "limits", "motions", "pressure"])
    one, other = open_database(grown[0]), open_database(whole)
    assert one.complete and other.complete and one.names == other.names
    for name in one.names:
        # one or two right sides at a time: the rounding of the linear solver, times its condition
        size = np.abs(other[name][np.isfinite(other[name])]).max(initial=0.0)
        np.testing.assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-9 * size, err_msg=name)


def test_pressures_are_stored_only_when_they_are_named():
    assert not set(ONLY_BY_NAME) & set(scene_of(None).names())
    assert "pressure" in scene_of(["pressure"]).names()


def scene_of(want):
    body = {"shape": "buoy", "radius": 5.0, "draft": 5.0}
    raw = {"water": {"depth": 20.0}, "bodies": [body], "waves": {"omegas": [1.0]}}
    return make_scene(raw if want is None else {**raw, "want": want})


def test_pressures_integrated_over_the_hull_are_the_forces_and_stiffness_of_the_motion(grown):
    """∬ p n dS = −F on the moving hull: by Newton −ω²MX = F − CX, mode by mode."""
    db = open_database(grown[0])
    whole = db.mesh.whole()
    n = np.hstack([whole.area_vectors, np.cross(whole.centroids, whole.area_vectors)])
    force = -np.einsum("whp,pi->whi", db["pressure"], n)
    X, w2 = db["rao"], db.omega[:, None, None] ** 2
    inertia = np.einsum("ij,whj->whi", db.inertia_matrix, X)
    needed = -w2 * inertia + np.einsum("ij,whj->whi", db.hydrostatic_stiffness, X)
    for i, name in enumerate(("surge", "heave", "pitch")):
        i = 2 * i
        size = np.abs(needed[..., i]).max()
        # of a linear pressure times a linear arm, one value a panel of edge d misses (d/L)² of the moment
        missed = (db.mesh.sizes.max() / db.dimensions["length"]) ** 2
        np.testing.assert_allclose(force[..., i], needed[..., i], atol=missed * size, err_msg=name)


def test_xarray_selects_pressures_and_checks_by_label(grown):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    db = open_database(grown[0])
    with xarray.open_dataset(grown[0], engine="h5netcdf") as data:
        assert data["pressure"].dims == QUANTITIES["pressure"][0]
        assert data["pressure"].attrs["units"] == "Pa/m" and np.iscomplexobj(data["pressure"].values)
        chosen = data["pressure"].sel(omega=0.61, wave_direction=0.5, method="nearest").sel(panel=3)
        assert complex(chosen) == db["pressure"][1, 1, 3]
        assert data.sizes["panel"] == db.mesh.total
        surge = data["rao"].sel(radiating_dof="Surge", omega=0.4, method=None)
        np.testing.assert_array_equal(surge, db["rao"][0, :, 0])
        assert all(data[name].attrs["units"] for name in ("omega", "wave_direction", "rao", "added_mass"))
    with xarray.open_dataset(grown[0], engine="h5netcdf", group="checks") as checks:
        assert checks["residual"].dims == ("omega",) and float(checks["residual"].max()) < 1e-9
    with xarray.open_dataset(grown[0], engine="h5netcdf", group="mesh") as mesh:
        np.testing.assert_array_equal(mesh["points"], db.mesh.points)


def test_errors_of_coefficients_grow_with_the_database_and_are_those_of_one_made_at_once(tmp_path):
    def errors(name, *steps):
        for omegas, headings, want in steps:
            body = {"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0}
            waves = {"omegas": omegas, "headings_deg": headings}
            scene = make_scene({"water": {"depth": 20.0}, "bodies": [body], "waves": waves, "want": want})
            assert scene.solved_by == "contour"
            assert solve(scene, tmp_path / name, executor=Here()).exit_status == 0
        return open_database(tmp_path / name).estimated_errors()

    whole = errors("whole.h5", ([0.4, 0.6], [0, 30], ["radiation", "excitation_force"]))
    steps = ([0.4], [0], ["radiation"]), ([0.4, 0.6], [0], ["excitation_force"]), ([0.4], [30], ["excitation_force"])
    grown = errors("grown.h5", *steps)
    assert set(whole) == {"added_mass", "radiation_damping", "excitation_force"}
    for name, error in whole.items():
        assert np.isfinite(error).all() and error.max() > 0
        # differences of nearly equal numbers: rounding of these shows in them
        np.testing.assert_allclose(grown[name], error, rtol=1e-6, atol=1e-6 * error.max(), err_msg=name)


BARE = {"water": {"depth": 20.0}, "bodies": [{"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0}],
        "waves": {"omegas": [0.5]}}  # fmt: skip


@pytest.mark.parametrize("before", ["panel", "contour"])
def test_a_database_goes_on_by_its_method_where_that_can_and_the_choice_is_left_to_it(before):
    """With a number of panels the contour method, which has none, cannot go on; a method that is named is kept"""
    header = SimpleNamespace(attributes={"method": before})
    for method in ("panel", "contour"):
        scene = make_scene(BARE | {"method": method})
        assert plan._by_the_same_method(scene, header, "a.h5") is scene
    assert plan._by_the_same_method(make_scene(BARE), header, "a.h5").method == before
    meshed = make_scene(BARE | {"panels": 100})
    if before == "panel":
        assert plan._by_the_same_method(meshed, header, "a.h5").method == "panel"
        return
    said = (
        "has been solved by method contour so far, but method contour has no panels: leave panels out, or give a "
        "tolerance"
    )
    with pytest.raises(SceneError, match=f"^a.h5 {said}; give --fresh to replace it or another --output$"):
        plan._by_the_same_method(meshed, header, "a.h5")
