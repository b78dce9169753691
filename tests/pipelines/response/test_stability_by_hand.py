"""What a study of responses says of restoring and damping, and of a body on lines or before a quay, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor import quay
from hakobune.pipelines.response import study

WORDS = ("surge", "sway", "heave", "roll", "pitch", "yaw")


def test_the_least_eigenvalue_is_that_of_the_symmetric_part_with_ones_on_its_diagonal():
    """4 and 9 with 1 and 5 beside them are 1, 1 and ½; a third of 2 stands alone"""
    assert study._least(np.array([[4.0, 1, 0], [5, 9, 0], [0, 0, 2]]))[0] == pytest.approx(0.5)
    least, worst = study._least(np.array([[4.0, 0, 0], [0, 9, 0], [0, 0, -2]]))
    assert (least, worst) == (pytest.approx(-1.0), 2)


@pytest.mark.parametrize(("row", "word"), [(2, "heave"), (3, "roll"), (4, "pitch")])
def test_a_body_that_does_not_float_is_refused_by_its_motion(row, word):
    stiffness = np.diag([0.0, 0.0, 5.0, 6.0, 7.0, 0.0])
    study._check_stable(stiffness, WORDS, 6)
    stiffness[row, row] = -3.0
    with pytest.raises(
        StudyError, match=f"with body.stiffness the restoring of {word} is -3, so the body does not float"
    ):
        study._check_stable(stiffness, WORDS, 6)


def test_damping_that_gives_energy_is_refused_and_coupling_that_does_no_work_is_not():
    skew = np.diag([1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    skew[0, 5], skew[5, 0] = 100.0, -100.0
    study._check_damping(skew, WORDS)
    skew[1, 1] = -2.0
    with pytest.raises(
        StudyError,
        match=r"body\.damping would add energy to sway: its damping there is -2; allowed: "
        r"at least 0",
    ):
        study._check_damping(skew, WORDS)


def test_viscous_damping_is_told_as_a_share_of_critical():
    body = SimpleNamespace(names=("Heave", "Roll"), words=("heave", "roll"), critical_damping=lambda i: 10.0 * (i + 1))
    told = list(study.viscous_words(body, ["Roll", "Heave"], np.diag([2.0, 24.0])))
    assert told == [f"viscous damping of {word} in this sea is {share} % of critical"
                    for word, share in (("roll", 120), ("heave", 20))]  # fmt: skip


@pytest.mark.parametrize(
    ("left_out", "energy", "says"),
    [
        (0.049, 0.009, "by the far field; local waves near the hull are not included, although 4.9 % of their height"),
        (
            0.051,
            0.009,
            "; more than 5 %: forces and added mass have errors of about this size; hakobune simulate models the",
        ),
        (
            0.049,
            0.011,
            "; damping in front of it falls to -0.011 of its largest value, and must not be negative: solve with",
        ),
        (0.31, 0.0, None),
    ],
)
def test_what_decays_before_a_quay_is_told_and_refused_beyond_its_limits(monkeypatch, left_out, energy, says):
    where = "hakobune.bem.wave_field.before_wall."
    monkeypatch.setattr(f"{where}before_wall", lambda reader, y: "a body before it")
    monkeypatch.setattr(f"{where}neglected", lambda reader, y: left_out)
    monkeypatch.setattr(f"{where}given_back", lambda made: energy)
    db = SimpleNamespace(path="box.h5", header=(left_out, energy), reader=None)
    if says is None:
        with pytest.raises(StudyError, match=r"although 31 % of their height .*; allowed: up to 30 %; .* --wall -30"):
            quay.by_far_field(db, -30.0)
        return
    made, (line,) = quay.by_far_field(db, -30.0)
    assert (
        made == "a body before it"
        and line.startswith("the quay at y = -30 m is computed by the far field")
        and says in line
    )
    assert ("; more than" in line) == (left_out > 0.05) and ("; damping in front" in line) == (energy > 0.01)
    monkeypatch.setattr(f"{where}before_wall", lambda reader, y: pytest.fail("made twice"))
    assert quay.by_far_field(db, -30.0)[0] == "a body before it"


@pytest.mark.parametrize(
    ("wall", "given", "method"),
    [
        (None, None, "far-field"),
        (-30.0, None, "panels"),
        (-30.0 + 9e-7, "panels", "panels"),
        (None, "far-field", "far-field"),
    ],
)
def test_the_method_before_a_quay_is_that_of_the_database(wall, given, method):
    assert quay.method_of(SimpleNamespace(method=given, y=-30.0), wall, "box.h5") == method


@pytest.mark.parametrize(
    ("wall", "given", "says"),
    [
        (None, "panels", "box.h5 is of open water; solve it again with --wall -30"),
        (-30.0 + 2e-6, "panels", "box.h5 is for a wall at y = -30 m"),
        (-30.0, "far-field", "box.h5 is for a wall at y = -30 m; allowed: a database of open water"),
        (None, "images", "quay.method is 'images'; allowed: far-field, panels"),
    ],
)
def test_a_quay_that_the_database_is_not_of_is_refused(wall, given, says):
    with pytest.raises(StudyError) as refused:
        quay.method_of(SimpleNamespace(method=given, y=-30.0), wall, "box.h5")
    assert says in str(refused.value)
