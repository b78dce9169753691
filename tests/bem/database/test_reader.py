"""One reader of a database between its waves: motions, drift and periods of every study, with estimated errors."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database import between_headings, open_database
from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.waves import wavenumber
from hakobune.pipelines.cli import main
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.run import solve

BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --panels 120 --gyration 15.55,29.44,32.28"


def solved(folder, name, omega, heading, *more):
    path = folder / f"{name}.h5"
    assert main([*BOX.split(), "--omega", omega, "--heading", heading, "--output", str(path), *more]) == 0
    return open_database(path)


@pytest.fixture(scope="module")
def coarse(tmp_path_factory):
    return solved(tmp_path_factory.mktemp("reader"), "coarse", "0.25:1.05:13", "0:90:4")


@pytest.fixture(scope="module")
def fine(tmp_path_factory):
    return solved(tmp_path_factory.mktemp("fine"), "fine", "0.45,0.5,0.55,0.65,0.7,0.8", "0:90:9")


def test_a_stored_wave_has_its_stored_numbers(coarse):
    for name in ("rao", "drift_force", "excitation_force", "added_mass", "drift_force_fixed", "kochin_diffraction"):
        value, error = coarse.at(coarse.omega, name)
        assert np.array_equal(value, coarse[name]) and not error.any()


def test_an_answer_does_not_depend_on_what_else_is_asked_for(coarse):
    omega, headings = np.linspace(0.3, 1.0, 50), np.radians([10.0, 200.0, 77.0])
    for name in ("rao", "drift_force"):
        among = open_database(coarse.path).at(omega, name, headings)[0][30, 2]
        alone = open_database(coarse.path).at(omega[30], name, headings[2:])[0][0, 0]
        assert np.allclose(among, alone, rtol=1e-9, atol=1e-9 * np.abs(alone).max())


def test_mirrored_headings_have_mirrored_answers(coarse):
    drift = coarse.at(0.6, "drift_force", np.radians([20.0, -20.0, 160.0, 200.0]))[0][0]
    assert np.allclose(drift[1:], drift[0] * [[1, -1, -1], [-1, 1, -1], [-1, -1, 1]], rtol=1e-12)


BUOY = "buoy --radius 8 --draft 5 --depth 20 --omega 0.4:1.2:9 --center-of-gravity 0,0,-3 --gyration"


@pytest.fixture(scope="module")
def buoys(tmp_path_factory):
    """A buoy with one heading and with three, and two of unequal inertia, one of them turned"""
    folder = tmp_path_factory.mktemp("buoys")
    kinds = {"one": "4,4,5", "three": "4,4,5 --heading 20,75,130", "unequal": "4,6,5", "turned": "6,4,5"}
    for name, words in kinds.items():
        assert main([*f"{BUOY} {words}".split(), "--output", str(folder / f"{name}.h5")]) == 0
    return {name: open_database(folder / f"{name}.h5") for name in kinds}


@pytest.mark.parametrize(
    "name", ["excitation_force", "diffraction_force", "kochin_diffraction", "rao", "drift_force_fixed", "drift_force"]
)
def test_a_round_body_has_from_one_heading_what_is_solved_at_others(buoys, name):
    one, three = buoys["one"], buoys["three"]
    value, _ = one.at(three.omega, name, three.wave_direction)
    assert np.abs(value - three[name]).max() <= 1e-9 * np.abs(three[name]).max()
    (value, error), quarter = one.at(0.77, name, np.radians([10.0, 100.0])), len(one.reader.between.theta) // 4
    if name == "kochin_diffraction":
        assert np.allclose(np.roll(value[0, 0], quarter), value[0, 1], rtol=1e-9)
    else:
        assert np.allclose(value[0, 1, 1], value[0, 0, 0], rtol=1e-9)
    assert np.all(error > 0, where=np.abs(value) > 1e-6 * np.abs(value).max())
    if name.startswith("drift"):  # a body of revolution is its own image in the plane of the wave: no moment, surely
        assert np.abs(value[..., 2]).max() < 1e-9 * np.abs(value).max() and not error[..., 2].any()


def test_a_round_hull_of_unequal_inertia_has_forces_from_everywhere(buoys):
    """Waves towards 90° on a body are those towards 0° on the body turned by −90°: sway → surge, roll → −pitch"""
    db = buoys["unequal"]
    across, ahead = db.at(db.omega, "rao", np.radians([90.0]))[0][:, 0], buoys["turned"]["rao"][:, 0]
    assert np.allclose(across[:, [1, 2, 3]], ahead[:, [0, 2, 4]] * [1, 1, -1], rtol=1e-9)
    assert np.all(np.isfinite(db.at(db.omega, "drift_force", np.radians([33.0]))[0]))


@pytest.fixture(scope="module")
def walled(tmp_path_factory):
    """A box 40 m from a wall, with headings 15° apart and with others"""
    folder, few = tmp_path_factory.mktemp("walled"), "0.3,0.45,0.6,0.75,0.9"
    return [
        solved(folder, name, few, headings, "--wall", "-65", "--only", "radiation,excitation_force,motions")
        for name, headings in (("coarse", "-90:90:13"), ("other", "-37,-8,37,52,82"))
    ]


def test_beside_a_wall_a_heading_is_its_image_with_a_phase_and_no_mirror_of_the_hull(walled):
    """Waves towards −β are those towards β and their reflection, exp(−2ikw sin β) ahead: all forces are, too"""
    coarse, other = walled
    assert coarse.symmetry == "x" and not coarse.is_round
    k, F = wavenumber(other.omega, 20.0), other["excitation_force"]
    turn = np.exp(2j * k * 65.0 * np.sin(np.radians(37)))[:, None]
    assert np.abs(F[:, 0] - turn * F[:, 2]).max() < 1e-6 * np.abs(F).max()
    ahead = open_database(other.path).at(other.omega, "excitation_force", np.radians([143.0]))[0][:, 0]
    assert np.allclose(np.abs(ahead), np.abs(F[:, 2])) and np.allclose(ahead[:, 1], F[:, 2, 1])
    for name in ("excitation_force", "rao"):
        towards, away = (other.at(other.omega, name, np.radians([beta]))[0][:, 0] for beta in (82.0, -82.0))
        turn = np.exp(2j * k * 65.0 * np.sin(np.radians(82)))[:, None]
        assert np.allclose(away, turn * towards, atol=1e-9 * np.abs(towards).max())
    assert np.array_equal(other.at(other.omega, "rao", other.wave_direction)[0], other["rao"])


@pytest.mark.parametrize("name", ["excitation_force", "rao"])
def test_errors_between_headings_beside_a_wall_hold(walled, name):
    coarse, other = walled
    value, estimated = coarse.at(other.omega, name, other.wave_direction)
    wrong, scale = np.abs(value - other[name]), np.abs(other[name]).max(axis=(0, 1))
    nugget = np.sqrt(between_headings.NUGGET) * scale  # below it the regression resolves nothing
    assert np.all(scale > 0) and np.mean(wrong <= 3 * estimated + nugget) > 0.9
    assert wrong.max() > nugget.min() and (wrong / scale).max() < 0.02


@pytest.mark.parametrize("name", ["excitation_force", "rao", "drift_force_fixed", "drift_force"])
def test_estimated_errors_hold_against_a_finer_database(coarse, fine, name):
    """Gaps of 30° and 0.067 rad/s against solved waves: nine of ten within three standard deviations"""
    value, estimated = coarse.at(fine.omega, name, fine.wave_direction)
    wrong = np.abs(value - fine[name])
    scale = np.abs(fine[name]).max(axis=(0, 1))
    known = np.maximum(wrong, estimated) > 1e-9 * scale  # else symmetry makes it zero, or it is a stored wave
    assert np.mean((wrong <= 3 * estimated)[known]) > 0.9
    assert np.sqrt(np.mean((wrong / scale) ** 2)) < 0.03


def test_haskinds_relation_gives_forces_between_headings_without_interpolation(coarse, fine):
    some = np.isin(np.round(fine.omega, 9), np.round(coarse.omega, 9))
    assert some.any()
    value, _ = coarse.at(fine.omega[some], "excitation_force", fine.wave_direction)
    exact = fine["excitation_force"][some]
    assert np.all(np.abs(value - exact).max(axis=(0, 1)) < 1e-4 * np.abs(exact).max(axis=(0, 1)))


def test_added_mass_tends_to_its_limits_beyond_the_band(coarse):
    low, high = coarse.omega[[0, -1]]
    near, far = coarse.at([low * (1 - 1e-6), 1e-6 * low], "added_mass")[0][:, 0, 0]
    assert np.isclose(near, coarse["added_mass"][0, 0, 0], rtol=1e-5)
    assert np.isclose(far, coarse["added_mass_zero"][0, 0], rtol=1e-9)
    beyond = coarse.at([1e6 * high], "added_mass")[0][0]
    assert np.allclose(beyond, coarse["added_mass_infinity"], rtol=1e-6, atol=1e-6 * beyond[0, 0])


def test_imported_files_without_drift_have_their_motions_and_say_what_is_left_out(coarse):
    from hakobune.mooring.studies.conditions import Conditions, Waves
    from hakobune.mooring.studies.multi_point_findings import _of_the_sea
    from hakobune.mooring.studies.wave_effects import wave_effects

    waves = Waves(2.0, 2 * np.pi / coarse.omega[3], np.radians(30.0))
    others = SimpleNamespace(attributes={"imported": "wamit: a.1"}, bodies_reader=coarse.bodies_reader.without_drift())
    for method in ("irregular", "regular_wave"):
        conditions = Conditions(waves=waves, method=method)
        whole, bare = wave_effects(coarse, conditions), wave_effects(others, conditions)
        assert whole.keys() == bare.keys() == {"irregular", "regular_wave"}
        for name, one in bare.items():
            assert one.amplitudes == pytest.approx(whole[name].amplitudes, rel=1e-9)
            assert not one.drift.any() and one.slow is None
            assert one.warnings[0].startswith("left out: the drift of the waves, which the imported files do not")
            assert whole[name].drift.any()
        assert list(_of_the_sea(SimpleNamespace(waves=bare))) == list(bare["irregular"].warnings)
    others.attributes = {}
    with pytest.raises(BetweenError, match=r"^drift_force must be stored for waves"):
        wave_effects(others, Conditions(waves=waves, method="irregular"))


def test_a_current_that_holds_waves_back_is_told_for_imported_files_without_drift_too(coarse, monkeypatch):
    """The current changes the waves alike with and without drift, so the same words are due"""
    from hakobune.mooring.studies import wave_effects as effects
    from hakobune.mooring.studies.conditions import Conditions, Current, Waves

    monkeypatch.setattr(effects, "check_blocked", lambda *_: ["held back"])
    waves = Waves(2.0, 2 * np.pi / coarse.omega[3], 0.0)
    conditions = Conditions(waves=waves, method="regular_wave", current=Current(0.3, np.pi))
    reader = coarse.bodies_reader
    others = SimpleNamespace(attributes={"imported": "wamit: a.1"}, bodies_reader=reader.without_drift())
    whole = effects.wave_effects(coarse, conditions)["regular_wave"]
    bare = effects.wave_effects(others, conditions)["regular_wave"]
    assert "held back" in whole.warnings and bare.warnings[:2] == (effects.NO_DRIFT, "held back")
    assert bare.amplitudes == pytest.approx(whole.amplitudes, rel=1e-9) and not bare.drift.any()


def test_studies_read_the_same_numbers(coarse):
    """Multi-point mooring and irregular response, on and between stored waves, and periods with and without lines"""
    from hakobune.bem.database.natural_periods import natural_periods
    from hakobune.mooring.response.points import transfer_functions
    from hakobune.mooring.studies.conditions import Conditions, Waves
    from hakobune.mooring.studies.wave_effects import wave_effects

    body = coarse.reader.floating()
    for omega, degrees in ((coarse.omega[3], 30.0), (0.61, 30.0), (0.61, 212.0)):
        beta = np.radians(degrees)
        waves = Waves(2.0, 2 * np.pi / omega, beta)
        motion = transfer_functions(body, [waves.omega], [beta]).value[0, 0]
        assert np.allclose(motion, coarse.reader.motions([waves.omega], [beta])[0, 0], rtol=1e-12)
        assert np.allclose(motion, coarse.at(waves.omega, "rao", [beta])[0][0, 0], rtol=1e-12)
        drift = wave_effects(coarse, Conditions(waves=waves, method="regular_wave"))["regular_wave"].drift
        assert np.allclose(drift, body.drift([waves.omega], [beta])[0, 0], rtol=1e-12)
    K = np.diag([1e6, 1e6, 0, 0, 0, 1e9])
    with_lines = natural_periods(coarse.reader.restrained(stiffness=K))
    assert np.array_equal(with_lines.period, natural_periods(body.restrained(stiffness=K)).period)
    w = 2 * np.pi / with_lines.period[2]
    M = coarse.inertia_matrix + coarse.at(w, "added_mass")[0][0]
    assert abs(np.linalg.det((coarse.hydrostatic_stiffness + K - w**2 * M)[[2]][:, [2]])) < 1e-9 * w**2 * M[2, 2]


def test_refusals_name_the_number_the_range_and_the_way_out(coarse):
    for ask, words in (
        (lambda: coarse.at(2.0, "rao"), r"omega is 2 rad/s .* outside the stored 0.25 to 1.05 rad/s .* solve again"),
        (lambda: coarse.at(0.6, "pressure"), "pressure is not stored"),
        (lambda: coarse.at(0.6, "rao", [np.nan]), "wave direction is nan; allowed: finite"),
        (lambda: coarse.reader.restrained(damping=np.eye(3)), r"damping matrix has shape \(3, 3\)"),
    ):
        with pytest.raises(ValueError, match=words) as caught:
            ask()
        assert "\n" not in str(caught.value)
    assert issubclass(BetweenError, ValueError)


def viscous(folder, name, omegas):
    """The box with the roll damping of Yamashita in waves of 3 m"""
    hull = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [15.55, 29.44, 32.28]}
    raw = {
        "water": {"depth": 20.0},
        "bodies": [hull],
        "panels": 120,
        "viscous": {"wave_height": 3.0, "roll": "Yamashita"},
    }
    scene = make_scene(raw | {"waves": {"omegas": omegas, "headings_deg": [45.0, 90.0]}})
    assert solve(scene, folder / f"{name}.h5").exit_status == 0
    return open_database(folder / f"{name}.h5")


def test_viscous_motions_between_waves_are_linearised_at_the_wave_height_of_the_scene(tmp_path):
    """On stored waves the stored motion, between them that of a solve there; the damping counts in roll"""
    stored = viscous(tmp_path, "stored", np.linspace(0.35, 0.95, 10).tolist())
    between = viscous(tmp_path, "between", [0.45, 0.52, 0.58])
    found, again = stored.reader, replace(stored.reader, own=False)  # solved again
    assert np.array_equal(found.motions(stored.omega), stored["rao"])
    assert np.allclose(again.motions(stored.omega), stored["rao"], rtol=1e-12, atol=1e-12 * np.abs(stored["rao"]).max())
    value, estimated = stored.at(between.omega, "rao")
    scale = np.abs(between["rao"]).max(axis=(0, 1))
    moving = scale > 1e-6 * scale.max()
    assert np.all((np.abs(value - between["rao"]) <= 3 * estimated + 1e-9 * scale)[..., moving])
    roll = np.abs(found.floating().motions(stored.omega))[:, 1, 3].max()
    assert np.abs(stored["rao"])[:, 1, 3].max() < 0.9 * roll
