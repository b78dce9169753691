"""The stress campaign: what it draws, what it finds in answers that are wrong, and a short one of its own."""

import csv
import math
import shlex
from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.meshing.seals import text_damaged, text_sealed
from hakobune.pipelines.cli import main
from hakobune.pipelines.validation.stress import scenes
from hakobune.pipelines.validation.stress.campaign import roughest, row_of
from hakobune.pipelines.validation.stress.laws import ALLOWED, allowed, violations
from hakobune.pipelines.validation.stress.rotated import rotated
from hakobune.pipelines.validation.stress.scenes import drawn, irregular
from hakobune.pipelines.validation.stress.solved import solved

SEED = 7
DRAWN = [drawn(SEED, number) for number in range(3000)]
SHORT = [scene.number for scene in DRAWN if scene.k * scene.reach < 8][:40]


def ratios():
    """{name: values over all scenes}"""
    width = np.array([s.sizes.get("beam", s.sizes.get("radius")) / s.draft for s in DRAWN])
    slender = np.array([s.sizes["length"] / s.sizes["beam"] for s in DRAWN if s.shape == "box"])
    depth = np.array([s.depth / s.draft for s in DRAWN])
    kh = np.array([s.k * s.depth for s in DRAWN if math.isfinite(s.depth)])
    return {
        "width": (width, 0.2, 100),
        "slender": (slender, 1, 20),
        "depth": (depth, 1.005, math.inf),
        "kh": (kh, 1e-4, 200),
    }


@pytest.mark.parametrize("name", ["width", "slender", "depth", "kh"])
def test_scenes_fill_their_range_to_both_ends(name):
    values, low, high = ratios()[name]
    near = 1e-3  # relative, of numbers rounded to six digits
    assert values.min() == pytest.approx(low, rel=near) and values.min() > low * (1 - near)
    assert values.max() == high or values.max() == pytest.approx(high, rel=near)
    finite = values[np.isfinite(values)]
    decades = np.histogram(np.log10(finite), bins=8)[0]
    assert decades.min() > len(values) / 100, decades


def test_a_share_of_the_frequencies_is_irregular():
    def beside(scene):
        omegas = irregular(scene.shape, scene.sizes, scene.draft, scene.depth)[1]
        return np.abs(scene.omega / omegas - 1).min() < scenes.BESIDE[1]

    share = np.mean([beside(scene) for scene in DRAWN])
    assert share > 0.6 * scenes.IRREGULAR, share  # some lie above the highest kh


def test_a_scene_is_that_of_its_seed_and_number():
    assert drawn(SEED, 5) == DRAWN[5] != drawn(SEED + 1, 5)


def test_eigenvalues_of_a_buoy_are_zeros_of_bessel_functions():
    from scipy.special import jv

    kappa, _ = irregular("buoy", {"radius": 3.0}, 2.0, 10.0)
    assert np.all(np.diff(kappa) > 0)
    assert np.abs(jv(np.arange(9)[:, None], 3 * kappa)).min(axis=0).max() < 1e-9
    x = np.linspace(1e-3, 3 * kappa[-1] + 1e-6, 20001)
    crossings = sum(np.count_nonzero(np.diff(np.sign(jv(m, x)))) for m in range(12))
    assert crossings == len(kappa)  # none is left out


def test_the_command_line_solves_the_same_scene(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    scene = next(DRAWN[n] for n in SHORT if DRAWN[n].depth < 5 * DRAWN[n].draft)
    assert main(shlex.split(scene.command("contour", 0.05))[1:]) == 0
    db, here = open_database(f"scene_{scene.number}.h5"), solved(scene, "contour", 0.05)
    assert np.array_equal(db["added_mass"][0], here.result["added_mass"])


@pytest.mark.parametrize("number", SHORT)
def test_random_scenes_keep_the_laws(number):
    row = row_of(SEED, number, tolerance=0.05, every=16)
    assert not row.verdict, (row.verdict, row.command)
    assert row.estimate >= 0 and row.worst[0] <= 1


@pytest.fixture(scope="module")
def answer():
    scene = next(DRAWN[n] for n in SHORT if DRAWN[n].shape == "box" and DRAWN[n].depth < 5 * DRAWN[n].draft)
    return scene, solved(scene, "contour", 0.01)


def with_checks(answer, **checks):
    return replace(answer, result={**answer.result, "checks": {**answer.result["checks"], **checks}})


@pytest.mark.parametrize("law", ["reciprocity", "dissipation"])
def test_a_wrong_matrix_is_found(answer, law):
    _, right = answer
    if law == "dissipation":
        damping = right.Z.imag.diagonal() + 3 * allowed(right.estimate) * right.sizes[0].diagonal()
        found = violations(replace(right, Z=right.Z - 1j * np.diag(damping)))
    else:
        found = violations(with_checks(right, **{law: 2.1 * allowed(right.estimate)}))
    assert found[law] > 1
    assert all(found[name] <= 1 for name in ALLOWED if name != law)


@pytest.mark.parametrize("name", ["added_mass", "excitation_force", "kochin_radiation"])
def test_a_value_that_is_not_finite_is_found(answer, name):
    _, right = answer
    spoiled = right.result[name].copy()
    spoiled.flat[3] = np.nan
    with pytest.raises(ArithmeticError, match=rf"{name} has 1 of {spoiled.size} values"):
        violations(replace(right, result={**right.result, name: spoiled}))


@pytest.mark.parametrize("name", ["estimated_error", "Haskind", "energy"])
def test_an_answer_without_a_check_is_found(answer, name):
    _, right = answer
    with pytest.raises(ArithmeticError, match=f"{name} is nan"):
        violations(with_checks(right, **{name: math.nan}))


def test_a_jump_in_one_parameter_is_found(answer):
    scene, right = answer
    assert roughest(scene, right, "contour", 0.01) < 1
    jump = 1 + 10 * right.estimate
    leapt = replace(right, Z=right.Z * jump)
    assert roughest(scene, leapt, "contour", 0.01) > 1


def test_a_mesh_that_is_not_the_rotated_one_is_found(monkeypatch):
    scene = next(s for s in (DRAWN[n] for n in SHORT) if s.shape == "box" and rotated(s, SEED) >= 0)
    assert rotated(scene, SEED) < 1
    monkeypatch.setattr("hakobune.pipelines.validation.stress.rotated._rotation", lambda angle: np.eye(3))
    assert rotated(scene, SEED) > 100


def test_a_campaign_writes_a_row_for_every_scene(tmp_path, capsys):
    file = tmp_path / "stress.csv"
    status = main(["stress", "--scenes", "6", "--seed", "3", "--waves", "3", "--output", str(file)])
    with file.open() as lines:
        rows = list(csv.DictReader(line for line in lines if line[0] != "#" and line != "\n"))
    assert [int(row["scene"]) for row in rows] == list(range(6))
    assert status == (1 if any(row["scene.verdict"] for row in rows) else 0)
    said = capsys.readouterr()
    assert "6 scenes" in said.out and not said.err
    text = file.read_text()
    assert text_sealed(text) and not text_damaged(text) and text_damaged(text.replace("0", "1", 1))


def test_scenes_that_a_method_is_not_for_are_left_out(tmp_path, capsys):
    long = (s for s in DRAWN if math.isinf(s.depth) and s.omega**2 / 9.80665 * max(s.sizes.values()) < 1)
    deep = next(scene.number for scene in long)
    asked = ["--scenes", "1", "--first", str(deep), "--seed", str(SEED), "--output", str(tmp_path / "stress.csv")]
    assert main(["stress", *asked, "--method", "contour"]) == 0
    assert "1 scenes left out" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--scenes", "0"], "--scenes is '0'; allowed: a whole number from 1"),
        (["--scenes", "abc"], "--scenes is 'abc'; allowed: a whole number from 1"),
        (["--scenes", "2.5"], "--scenes is '2.5'; allowed: a whole number"),
        (["--seed", "-1"], "--seed is '-1'; allowed: a whole number from 0"),
        (["--method", "strip"], "--method is 'strip'; allowed: auto, panel, contour"),
        (["--tolerance", "2"], "--tolerance is 2.0; allowed"),
        (["--waves", "-1"], "--waves is -1.0; allowed: above 0"),
        (["--output", "nowhere/stress.csv"], "the folder nowhere does not exist"),
    ],
)
def test_a_wrong_argument_is_one_line(arguments, said, capsys):
    assert main(["stress", *arguments]) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1
