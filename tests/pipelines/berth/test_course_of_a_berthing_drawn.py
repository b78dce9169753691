"""The picture of a berthing, read back: reactions and deflections of each fender, and energies, in their units."""

from types import SimpleNamespace

import numpy as np

from hakobune.pipelines.berth import command


def legend(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_each_fender_has_its_own_course_and_energies_stand_beside_that_of_the_method(pictures, tmp_path):
    """N are kN, J are kJ; two fenders of one table at 20 m ahead and 15.5 m behind"""
    fender = SimpleNamespace(name="cell")
    course = SimpleNamespace(
        time=np.array([0.0, 1.0, 2.0]), reaction=np.array([[0.0, 0.0], [5e5, 2e5], [1e5, 9e5]]),
        deflection=np.array([[0.0, 0.0], [0.5, 0.2], [0.1, 0.9]]), taken=np.array([0.0, 3e5, 4e5]),
        lost=np.array([0.0, 1e4, 2e4]), virtual_mass=1.23456,
    )  # fmt: skip
    approach = SimpleNamespace(meetings=[(fender, 20.0, None), (fender, -15.5, None)], energy=6.5e5)
    command._draw(SimpleNamespace(detail=(approach, course)), tmp_path / "b.png")
    (figure,) = pictures
    force, deep, energy = figure.axes
    assert figure.get_size_inches().tolist() == [8.0, 8.0] and (tmp_path / "b.png").exists()
    for axes, wanted in ((force, course.reaction / 1e3), (deep, course.deflection)):
        assert [line.get_xdata().tolist() for line in axes.lines] == [[0, 1, 2]] * 2
        assert np.array([line.get_ydata() for line in axes.lines]).T.tolist() == wanted.tolist()
        assert [line.get_label() for line in axes.lines] == ["cell, x = 20 m", "cell, x = -15.5 m"]
    taken, lost, method = energy.lines
    assert taken.get_xydata().tolist() == [[0, 0], [1, 300], [2, 400]]
    assert lost.get_xydata().tolist() == [[0, 0], [1, 10], [2, 20]] and list(method.get_ydata()) == [650.0, 650.0]
    assert (method.get_linewidth(), method.get_linestyle(), method.get_color()) == (0.8, ":", "grey")
    assert legend(energy) == ["stored and dissipated in fenders", "in waves", "kinetic-energy method"]
    assert legend(force) == ["cell, x = 20 m", "cell, x = -15.5 m"] and deep.get_legend() is None
    assert force.get_title() == "C_M 1.235" and force.get_ylabel() == "reaction, kN"
    assert (deep.get_ylabel(), energy.get_ylabel(), energy.get_xlabel()) == (
        "deflection, m", "energy, kJ", "time from contact, s",
    )  # fmt: skip
    assert {text.get_fontsize() for axes in (force, energy) for text in axes.get_legend().get_texts()} == {8.0}
