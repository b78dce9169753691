"""Repairs, scales and groups of files, and answers of one body and of a reader, each by what it says it is."""

from dataclasses import replace
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
from made_up_body import made_up_body
from test_database import HEADINGS, NAMES, OMEGAS, THETA, fill, header

from hakobune.bem.bodies.one_of_several import OneOfSeveral, each_body
from hakobune.bem.database import create, extend, open_database, pending, writing
from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.file import _reason, damage_named
from hakobune.bem.database.integrity import DamagedError, _wrong_coordinates, repair
from hakobune.bem.database.natural_periods import _own_frequencies
from hakobune.bem.database.resonances import about
from hakobune.bem.database.rows import Database
from hakobune.bem.database.schema import CELL_AXES, CHECKS, ESTIMATES, QUANTITIES, labels
from hakobune.bem.database.widening import content, read_group, write_group
from hakobune.bem.flexible.beams import Beam
from hakobune.bem.modes import Body, Mode
from hakobune.meshing.whole_files import NotWritten


@pytest.fixture
def path(tmp_path):
    create(tmp_path / "box.h5", header(), OMEGAS, HEADINGS, NAMES)
    fill(tmp_path / "box.h5")
    return tmp_path / "box.h5"


def test_a_frequency_whose_checks_have_changed_is_solved_again_and_no_other(path):
    """All its quantities, its checks and times are gone; the limits and the other frequencies stay"""
    before = open_database(path)
    wanted = {name: before[name] for name in NAMES}
    with h5py.File(path, "r+") as file:
        file["checks/energy"][1] = 0.5
        file["stored/drift_force"][1, 1] = 0  # not stored: nothing to take back
        found = repair(file)
        assert found == {"added_mass": 1, "excitation_force": 2, "drift_force": 1, "kochin_radiation": 1}
        assert list(file["solved"][()]) == [1, 0, 1] and file["wall_time"][1] == b"{}"
        assert file["wall_time"][0] != b"{}" != file["wall_time"][2]
        for name in CHECKS:
            assert np.isnan(file["checks"][name][1])
        assert file["checks/energy"][0] == pytest.approx(0.004) and file["checks/energy"][2] == pytest.approx(0.012)
        for name in found:
            for place in (name, f"estimated_error/{name}") if name in ESTIMATES else (name,):
                at = (1, 0) if name == "drift_force" else 1
                assert np.isnan(file[place][at]).all() and np.isfinite(file[place][0]).all()
    assert [(row.omega, row.want) for row in pending(path).rows] == [(0.8, set(NAMES) - {"added_mass_infinity"})]
    now = open_database(path)
    for name in NAMES:
        assert np.array_equal(now[name], wanted[name][[0, 2]] if "omega" in QUANTITIES[name][0] else wanted[name])


def test_every_dataset_has_its_axes_as_scales_and_its_unit(path):
    """What xarray and ncdump show beside the numbers; kg for kg m for kg m² of added mass"""
    with h5py.File(path) as file:
        axes = {name: QUANTITIES[name][0] for name in NAMES}
        axes |= {f"estimated_error/{name}": QUANTITIES[name][0] for name in NAMES if name in ESTIMATES}
        axes |= {f"stored/{name}": CELL_AXES[name] for name in NAMES}
        axes |= {"period": ("omega",), "wavenumber": ("omega",), "wave_direction_deg": ("wave_direction",)}
        axes |= {"mesh/points": ("mesh/point", "mesh/coordinate"), "mesh/corners": ("mesh/panel", "mesh/corner")}
        for name, own in axes.items():
            scales = [[scale.name for scale in dim.values()] for dim in file[name].dims]
            assert scales == [[f"/{axis}"] for axis in own], name
        units = {"omega": "rad/s", "wave_direction": "rad", "theta": "rad", "period": "s", "wavenumber": "rad/m",
                 "wave_direction_deg": "degree", "added_mass": "kg, kg m, kg m2", "excitation_force": "N/m, N m/m",
                 "drift_force": "N/m2, N m/m2", "estimated_error/drift_force": "N/m2, N m/m2",
                 "added_mass_infinity": "kg, kg m, kg m2", "mesh/points": "m"}  # fmt: skip
        assert {name: file[name].attrs["units"] for name in units} == units
        for name in ("drift_dof", "stored/added_mass", "mesh/corners"):
            assert "units" not in file[name].attrs
        assert file["period"][()] == pytest.approx(2 * np.pi / np.array(OMEGAS))
        assert file["wave_direction_deg"][()] == pytest.approx([0.0, 90.0])


def group_of(number):
    return {"pair": (("pair",), "", np.array([3.0, 5.0])), "xyz": (("xyz",), "m", np.array([1.0, 2.0, 3.0])),
            "qtf": (("pair", "xyz"), "N/m2", np.full((2, 3), number))}  # fmt: skip


def test_a_group_stays_when_another_is_written_or_frequencies_are_added(path):
    """Its numbers, axes, units and attributes; the rows too"""
    write_group(path, "qtf", group_of(1.0), {"range": 2.5})
    write_group(path, "qtf_sum", group_of(7.0), {"range": 3.5})
    write_group(path, "qtf", group_of(4.0), {"range": 4.5})
    assert extend(path, omega=(0.6,))
    db = open_database(path)
    assert db.omega.tolist() == list(OMEGAS) and db.asked.tolist() == [0.4, 0.6, 0.8, 1.2]
    for name, number, reach in (("qtf", 4.0, 4.5), ("qtf_sum", 7.0, 3.5)):
        datasets, attributes = read_group(db, name)
        assert attributes == {"range": reach} and list(datasets)[:2] == ["pair", "xyz"]
        for key, (axes, unit, values) in group_of(number).items():
            assert datasets[key][:2] == (axes, unit) and np.array_equal(datasets[key][2], values)
        with h5py.File(path) as file:
            scales = [[scale.name for scale in dim.values()] for dim in file[f"{name}/qtf"].dims]
            assert scales == [[f"/{name}/pair"], [f"/{name}/xyz"]]
            assert content(file, "nothing") is None


def test_pairs_of_another_scene_are_not_taken_over(path):
    """Nor where a quantity is computed anew"""
    write_group(path, "qtf", group_of(1.0), {})
    assert extend(path, omega=(0.6,), header=header(scene_hash="other"))
    assert read_group(open_database(path), "qtf") is None
    write_group(path, "qtf", group_of(1.0), {})
    assert extend(path, omega=(0.7,), anew=("drift_force",))
    assert read_group(open_database(path), "qtf") is None


BODIES = (Body("a"), Body("b", fixed=True), Body("c"))


class OfThree(dict):
    """Quantities of three bodies, of which the second is fixed: 18 forces, 12 motions"""

    bodies, modes = BODIES, ()

    def __init__(self):
        rng = np.random.default_rng(1)
        shapes = {"added_mass": (2, 18, 12), "excitation_force": (2, 3, 18), "rao": (2, 3, 12),
                  "drift_force": (2, 3, 3), "body_drift_force_fixed": (2, 3, 3, 3), "kochin_radiation": (2, 12, 8),
                  "kochin_diffraction": (2, 3, 8)}  # fmt: skip
        super().__init__({name: rng.normal(size=shape) for name, shape in shapes.items()})
        self.inertia = rng.normal(size=(18, 12))
        body = {"inertia_matrix": self.inertia, "mass": np.array([3.0, 4.0, 5.0]), "center_of_mass": np.eye(3)}
        self.header = SimpleNamespace(body=body)

    @property
    def names(self):
        return tuple(self)


@pytest.mark.parametrize("number, forces, motions", [
    (0, slice(0, 6), slice(0, 6)), (1, slice(6, 12), slice(0, 0)), (2, slice(12, 18), slice(6, 12)),
])  # fmt: skip
def test_one_body_of_several_has_the_forces_on_it_and_its_own_motions(number, forces, motions):
    whole = OfThree()
    one = each_body(whole)[number]
    assert np.array_equal(one["added_mass"], whole["added_mass"][:, forces, motions])
    assert np.array_equal(one["excitation_force"], whole["excitation_force"][:, :, forces])
    assert np.array_equal(one["rao"], whole["rao"][:, :, motions])
    assert np.array_equal(one["kochin_radiation"], whole["kochin_radiation"][:, motions])
    assert np.array_equal(one["kochin_diffraction"], whole["kochin_diffraction"])  # of all together
    assert np.array_equal(one["drift_force_fixed"], whole["body_drift_force_fixed"][:, :, number])
    own = ("excitation_force",) if number == 1 else ("added_mass", "excitation_force", "rao", "kochin_radiation")
    assert one.names == (*own, "drift_force_fixed") and one.fixed is (number == 1)
    assert np.array_equal(one.inertia_matrix, whole.inertia[forces, motions])
    assert one.mass == 3.0 + number and np.array_equal(one.center_of_mass, np.eye(3)[number])
    assert one.wetted_area is None and one.bodies is BODIES


def test_a_body_that_bends_is_one_of_one_and_a_rigid_one_itself():
    rigid = SimpleNamespace(bodies=(), modes=())
    assert each_body(rigid) == [rigid]
    bent = SimpleNamespace(bodies=(), modes=("first", "second"), header=SimpleNamespace(body={"mass": 7.0}))
    (one,) = each_body(bent)
    assert isinstance(one, OneOfSeveral) and one.number == 0 and one.mass == 7.0


def test_the_largest_error_counts_by_the_largest_stored_value_of_its_kind(monkeypatch):
    """Couplings by √(ii · jj), forces and motions by mode over all waves, drift by direction, Kochin functions by
    angle; a motion with less than 1e-4 of the largest translation or rotation moves no water and does not count"""
    A = np.zeros((2, 6, 6))
    A[:, range(6), range(6)] = [[1.0, 4, 9, 0.9e-8 * 100, 25, 100], [4.0, 1, 1, 0, 16, 1]]
    X = np.zeros((2, 1, 6), complex)
    X[1, 0] = [3j, 4.0, -5.0, 2.0, 20.0, 1.9e-3]
    drift, H = np.array([[[2.0, -4, 1]], [[1.0, 3, 8]]]), np.array([[[1.0, 4j]] * 6, [[-2.0, 3]] * 6])
    quantities = {"added_mass": A, "radiation_damping": A, "excitation_force": X, "drift_force": drift,
                  "kochin_radiation": H}  # fmt: skip
    one = Between(np.array([1.0, 2.0]), quantities, 10.0, 9.81, np.zeros(1), np.zeros(2), np.zeros((1, 2)))
    error = np.zeros((2, 6, 6))
    error[0, 0, 1], error[1, 4, 5], error[0, 3, 3] = 0.4, 5.0, 9.0  # of 2 · 2 and of 5 · 10; roll does not count
    assert one._relative(error, "added_mass") == pytest.approx([0.4 / 4, 5.0 / 50])
    force = np.zeros((2, 1, 6))
    force[0, 0, 1], force[1, 0, 4], force[1, 0, 5] = 1.0, 4.0, 3.0  # yaw is 0.95e-4 of pitch
    assert one._relative(force, "excitation_force") == pytest.approx([0.25, 0.2])
    assert one._relative(np.array([[[0.2, 0.2, 0.2]], [[0.0, 0, 4.0]]]), "drift_force") == pytest.approx([0.1, 0.5])
    assert one._relative(np.ones((2, 6, 2)) * [0.4, 0.4], "kochin_radiation") == pytest.approx([0.2, 0.2])
    given = {"added_mass": error, "excitation_force": force}
    monkeypatch.setattr(Between, "error", lambda self, omega, name: given[name])
    assert one.largest_error([1.0, 2.0], ("added_mass", "excitation_force")) == pytest.approx([0.25, 0.2])


def test_of_several_roots_the_first_among_the_places_is_the_natural_frequency():
    """λ − ω² = −(ω − 0.5)(ω − 0.7)(ω − 1.6) changes sign three times, as beside gap water; √λ(0) = 0.75 lies beyond two
    of them, and without places the search ends at the last"""

    def eigenvalues(w):
        w = np.asarray(w, float)
        bent = w**2 - (w - 0.5) * (w - 0.7) * (w - 1.6)
        return np.stack([bent, 4.0 + 0 * w, -1.0 + 0 * w], axis=-1)

    assert _own_frequencies(eigenvalues) == pytest.approx([1.6, 2.0, -1.0])
    for places in ([0.2, 0.65, 1.2, 1.8, 2.5], [0.65], [0.55, 0.6, 0.65, 3.5]):
        assert _own_frequencies(eigenvalues, np.array(places)) == pytest.approx([0.5, 2.0, -1.0])
    assert _own_frequencies(eigenvalues, np.array([1.2, 1.7, 1.8])) == pytest.approx([1.6, 2.0, -1.0])


def test_diffraction_is_what_excitation_has_beside_froude_krylov():
    """At a stored heading and at a mirrored one, at stored frequencies and between"""
    body = made_up_body()
    X = body.between.quantities["excitation_force"]
    parts = {"Froude_Krylov_force": 0.7 * X, "diffraction_force": 0.3 * X}
    body = replace(body, between=replace(body.between, quantities=body.between.quantities | parts))
    omega, headings = np.array([0.3, 0.513]), np.radians([30.0, -60.0, 41.0])
    both = body.forces(omega, headings)
    assert body.forces(omega, headings, "diffraction_force") == pytest.approx(0.3 * both, rel=1e-6)
    assert body.forces(omega, None, "diffraction_force")[0] == pytest.approx(0.3 * X[0])


def test_places_within_a_thousandth_of_the_least_width_of_one_that_is_known_tell_the_same():
    body, peak = SimpleNamespace(between=SimpleNamespace(span=(1.0, 3.0))), SimpleNamespace(omega=2.0, damping=0.01)
    wide = SimpleNamespace(omega=1.5, damping=0.2)
    alone = about(body, [peak, wide])
    for share, kept in ((0.97e-3, False), (1.03e-3, True)):
        found = about(body, [peak, wide], [2.0 * (1 + share * 0.01)])
        assert len(found) == len(alone) - (not kept) and (2.0 in found) is kept


@pytest.mark.parametrize("kind", ["vertical bending", "horizontal bending"])
def test_loads_in_a_beam_are_its_rigidity_times_the_second_and_the_third_difference(kind):
    one, x, h = Beam(kind, 2, -3.0, 7.0, 0.5, 2.5, 3.0), np.array([-1.0, 2.3, 5.0]), 2e-3
    w = [one.along(x + k * h) for k in (-2, -1, 0, 1, 2)]
    moment, shear = one.loads(x)
    assert moment == pytest.approx(2.5 * (w[1] - 2 * w[2] + w[3]) / h**2, rel=1e-4)
    assert shear == pytest.approx(2.5 * (w[4] - 2 * w[3] + 2 * w[1] - w[0]) / (2 * h**3), rel=1e-4)


def test_torsion_bears_its_rigidity_times_the_twist_per_metre():
    """θ = cos(nπ(1 + s)/2) but for the sign that makes the forward end 1"""
    one, x = Beam("torsion", 3, -3.0, 7.0, 0.5, 2.5, 3.0), np.array([-1.0, 2.3, 5.0])
    (moment,) = one.loads(x)
    assert one.along(7.0) == pytest.approx(1.0)
    assert moment == pytest.approx(2.5 * np.sin(3 * np.pi * (x + 3) / 10) * 3 * np.pi / 10)


def test_a_shape_of_a_body_that_stands_elsewhere_and_heads_elsewhere_moves_as_its_own_axes_say():
    """In its axes (x′, y′) the point is 3 m ahead and 1 m to port; there it moves by 2 along x′"""
    seen = []

    class Shape:
        def displacement(self, points):
            seen.append(points)
            return np.tile([2.0, 0.0, 5.0], (len(points), 1))

    mode = Mode("bow", shape=Shape(), place=(10.0, 20.0), heading=np.pi / 2)
    moved = mode.displacement(np.array([[9.0, 23.0, -1.0]]))
    assert seen[0] == pytest.approx(np.array([[3.0, 1.0, -1.0]])) and moved == pytest.approx(np.array([[0.0, 2, 5]]))


def test_angles_of_kochin_functions_are_those_of_the_file(path):
    assert open_database(path)["theta"] == pytest.approx(THETA)


def test_the_body_of_each_of_several_has_a_row_for_each_but_its_matrices(tmp_path):
    """Forces of all by motions of all that move; the rest one value or one point for each body"""
    whole = header()
    mesh = whole.mesh
    several = replace(mesh.whole(), body=np.arange(len(mesh.whole().corners)) % 2)
    body = {"mass": np.array([3.0, 4.0]), "center_of_mass": np.eye(3)[:2], "inertia_matrix": np.ones((12, 12))}
    given = header(mesh=several, lid=None, bodies=(Body("a"), Body("b")), body=body)
    create(tmp_path / "two.h5", given, OMEGAS, HEADINGS, ("added_mass",))
    with h5py.File(tmp_path / "two.h5") as file:
        for name, axes in (("mass", ["/body"]), ("center_of_mass", ["/body", "/xyz"]),
                           ("inertia_matrix", ["/influenced_dof", "/radiating_dof"])):  # fmt: skip
            assert [scale.name for dim in file[name].dims for scale in dim.values()] == axes
            assert np.array_equal(file[name][()], body[name])
        assert file["mass"].attrs["units"] == "kg" and file["center_of_mass"].attrs["units"] == "m"
        assert [name.decode() for name in file["body"][()]] == ["a", "b"]
    assert open_database(tmp_path / "two.h5").bodies == given.bodies


def test_frequencies_that_are_damaged_are_counted_and_the_first_is_named(path):
    for rows, words in (((1,), r"added_mass at ω = 0.8 rad/s has changed since"),
                        ((1, 2), r"added_mass at ω = 0.8 rad/s and 1 others has changed since"),
                        ((0, 1, 2), r"added_mass at ω = 0.4 rad/s and 2 others has changed since")):  # fmt: skip
        with h5py.File(path, "r+") as file:
            for row in rows:
                file["added_mass"][row, 2, 2] = 1e9
        with pytest.raises(DamagedError, match=words):
            open_database(path)["added_mass"]


def test_room_on_the_disk_is_asked_for_where_a_path_is_opened_not_an_open_file(path, monkeypatch):
    asked = []
    monkeypatch.setattr("hakobune.bem.database.rows.keep_room", asked.append)
    with writing(path) as file:
        assert asked == [path]
        with writing(file) as same:
            assert same is file and asked == [path]


class Attributed(dict):
    def __init__(self, **attrs):
        super().__init__()
        self.attrs = {"density": 1025.0, "gravity": 9.8, "water_depth": np.inf, "rotation_center": np.zeros(3)} | attrs


AXES = {"omega": np.array([0.5, 1.0]), "wave_direction": np.array([-1.0, 0.0]), "theta": np.array([-0.5, 0.5])}


@pytest.mark.parametrize("attrs, axes, problem", [
    ({}, {}, []), ({"water_depth": 10.0}, {}, []),
    ({"density": 0.0}, {}, ["density is 0.0"]), ({"gravity": -1.0}, {}, ["gravity is -1.0"]),
    ({"gravity": np.inf}, {}, ["gravity is inf"]), ({"density": np.nan}, {}, ["density is nan"]),
    ({"water_depth": np.nan}, {}, ["water_depth is nan"]), ({"water_depth": 0.0}, {}, ["water_depth is 0.0"]),
    ({"density": np.ones(2), "gravity": 0.0}, {}, ["density is [1. 1.]", "gravity is 0.0"]),
    ({"rotation_center": np.zeros(2)}, {}, ["rotation_center is [0. 0.]"]),
    ({"rotation_center": np.array([0, np.inf, 0])}, {}, ["rotation_center is [ 0. inf  0.]"]),
    ({}, {"omega": np.array([0.0, 1.0])}, ["omega does not increase from above 0"]),
    ({}, {"omega": np.array([1.0, 1.0])}, ["omega does not increase from above 0"]),
    ({}, {"wave_direction": np.array([1.0, 0.0])}, ["wave_direction does not increase"]),
    ({}, {"theta": np.array([0.0, 0.0])}, ["theta does not increase"]),
    ({}, {"theta": np.array([0.0, np.nan])}, ["theta is not a one-dimensional array of finite numbers"]),
    ({}, {"omega": np.array([1, 2])}, ["omega is not a one-dimensional array of finite numbers"]),
    ({}, {"omega": np.ones((1, 2))}, ["omega is not a one-dimensional array of finite numbers"]),
])  # fmt: skip
def test_coordinates_rise_and_the_water_is_heavy_and_deep(attrs, axes, problem):
    assert list(_wrong_coordinates(Attributed(**attrs), AXES | axes)) == problem


@pytest.mark.parametrize("missing, inertia, words", [
    (("rao",), None, "motions need the inertia of the body: give --gyration kxx,kyy,kzz (scene: gyration)"),
    (("rao", "added_mass"), None, "motions need the inertia of the body: give --gyration kxx,kyy,kzz "
     "(scene: gyration)"),
    (("rao",), np.eye(6), "repeat the command that made the database, with --only rao"),
    (("added_mass", "pressure"), None, "repeat the command that made the database, with --only added_mass,pressure"),
])  # fmt: skip
def test_what_is_missing_is_had_by_the_mass_or_by_asking_for_it(missing, inertia, words):
    assert Database._remedy(SimpleNamespace(inertia_matrix=inertia), missing) == words


@pytest.mark.parametrize("name", ["added_mass", "excitation_force", "drift_force"])
def test_errors_of_any_quantity_that_have_changed_are_not_shown(path, name):
    with h5py.File(path, "r+") as file:
        file[f"estimated_error/{name}"][2] = 7.0
    with pytest.raises(DamagedError, match=rf"{name} at ω = 1\.2 rad/s has changed"):
        open_database(path).estimated_errors()


@pytest.mark.parametrize("ask", [lambda db: db.checks(), lambda db: db.wall_times(),
                                 lambda db: db.interpolated_estimates()])  # fmt: skip
@pytest.mark.parametrize("name, value", [("checks/energy", 0.5), ("wall_time", b'{"factor": 9}')])
def test_checks_and_times_that_have_changed_are_not_shown(path, ask, name, value):
    """Of a frequency that is not solved they may be anything"""
    with h5py.File(path, "r+") as file:
        file[name][1] = value
    with pytest.raises(DamagedError, match=r"is damaged: the checks at ω = 0\.8 rad/s has changed since it was stored"):
        ask(open_database(path))
    with h5py.File(path, "r+") as file:
        file["stored/added_mass"][1] = 0
        file["solved"][1] = 0
    assert len(ask(open_database(path))) > 0


def test_checks_are_those_of_the_solved_frequencies(path):
    with h5py.File(path, "r+") as file:
        file["stored/added_mass"][0] = 0
        file["solved"][0] = 0
    db = open_database(path)
    assert db.checks()["energy"] == pytest.approx([0.008, 0.012]) and list(db.checks()) == list(CHECKS)
    assert np.isnan(db.checks()["reciprocity"]).all() and db.wall_times() == [{"factor": 0.25}] * 2
    assert db.interpolated_estimates().tolist() == [False, False] and not db.complete


@pytest.mark.parametrize("error, words", [
    (OSError(11, "locked"), "another process has opened it; wait until it ends, or give another file"),
    (OSError(35, "locked"), "another process has opened it; wait until it ends, or give another file"),
    (OSError("unable to lock file"), "another process has opened it; wait until it ends, or give another file"),
    (OSError("truncated file: eof = 3"), "the file is truncated; copy it again, or give another name"),
    (OSError(13, "whatever"), "Permission denied"), (OSError("one line\nand another"), "one line"),
])  # fmt: skip
def test_why_a_file_cannot_be_opened_is_told_in_one_line(error, words):
    assert _reason(error) == words


@pytest.mark.parametrize("error, kind, words", [
    (OSError("Can't synchronously read data (a cause)"), DamagedError, "is damaged: Can't synchronously read data"),
    (KeyError("Unable to synchronously open object (x)"), DamagedError, "is damaged: Unable to synchronously open"),
    (RuntimeError("Unspecified error (a cause)"), DamagedError, "is damaged: Unspecified error (a cause)"),
    (OSError("Can't synchronously write data (full)"), NotWritten, "cannot be written: Can't synchronously write data"),
    (KeyError("another"), KeyError, "another"), (RuntimeError("no brackets"), RuntimeError, "no brackets"),
])  # fmt: skip
def test_errors_of_hdf5_are_told_as_damage_or_as_a_full_disk_and_others_as_they_are(error, kind, words):
    with pytest.raises(kind) as told, damage_named("a.h5"):
        raise error
    assert words in str(told.value)
    if kind is NotWritten:
        assert str(told.value).endswith("; the data stored before is kept")


def test_forces_are_named_of_all_bodies_and_motions_of_those_that_move():
    """As in Capytaine; shapes by their body, or by themselves between several"""
    plain = labels(())
    assert plain["influenced_dof"] == plain["radiating_dof"] == ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
    assert plain["drift_dof"] == ("Surge", "Sway", "Yaw") and plain["xyz"] == ("x", "y", "z") and "body" not in plain
    bent = labels((), (Mode("bow"),))
    assert bent["influenced_dof"][6:] == bent["radiating_dof"][6:] == ("bow",)
    several = labels(BODIES, (Mode("bow", body=2), Mode("both", on=(0, 2))))
    assert several["body"] == ("a", "b", "c") and len(several["influenced_dof"]) == 20
    assert several["influenced_dof"][5:8] == ("a__Yaw", "b__Surge", "b__Sway")
    assert several["radiating_dof"][5:7] == ("a__Yaw", "c__Surge")
    assert several["radiating_dof"][12:] == several["influenced_dof"][18:] == ("c__bow", "both")
