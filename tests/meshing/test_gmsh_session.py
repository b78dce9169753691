import signal
import sys
import threading

import numpy as np
import pytest

from hakobune.meshing import gmsh_session
from hakobune.meshing.gmsh_session import filled, graded_patches, session
from hakobune.meshing.shapes import box

SQUARE = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0.0]])


def test_a_session_is_closed_even_after_an_error():
    with pytest.raises(RuntimeError, match="on purpose"), session("a") as gmsh:
        raise RuntimeError("on purpose")
    assert not gmsh.isInitialized()


def test_a_session_of_the_caller_is_left_as_it_was():
    import gmsh

    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.model.add("mine")
        gmsh.option.setNumber("General.Terminal", 1)
        box(10, 5, 2, panels=40)
        assert gmsh.model.list() == ["", "mine"] or gmsh.model.list() == ["mine"]
        assert gmsh.model.getCurrent() == "mine"
        assert gmsh.option.getNumber("General.Terminal") == 1
    finally:
        gmsh.finalize()


def test_meshing_works_in_a_thread_and_leaves_the_interrupt_handler():
    before, made = signal.getsignal(signal.SIGINT), []
    threads = [threading.Thread(target=lambda: made.append(box(10, 5, 2, panels=40))) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [mesh.volume for mesh in made] == [pytest.approx(100)] * 3
    assert signal.getsignal(signal.SIGINT) is before


def test_meshing_prints_nothing(capfd):
    box(10, 5, 2, panels=40)
    out, err = capfd.readouterr()
    assert out == err == ""


def test_the_same_call_gives_the_same_mesh():
    first, second = (filled(SQUARE, size=0.3) for _ in range(2))
    np.testing.assert_array_equal(first.points, second.points)
    np.testing.assert_array_equal(first.corners, second.corners)


def test_patches_share_the_points_of_their_common_side():
    def side(*corners):
        return np.array(corners, float)

    left = [
        side((0, 0, 0), (1, 0, 0)),
        side((1, 0, 0), (1, 1, 0)),
        side((1, 1, 0), (0, 1, 0)),
        side((0, 1, 0), (0, 0, 0)),
    ]
    right = [edge + [1, 0, 0] for edge in left]
    mesh = graded_patches([left, right])
    assert len(mesh) == 2
    assert len(mesh.points) == 6


@pytest.mark.parametrize("turn", (1, -1))
def test_a_filled_polygon_faces_the_side_it_runs_round_counter_clockwise(turn):
    mesh = filled(SQUARE[::turn], size=0.5)
    np.testing.assert_allclose(mesh.area_vectors.sum(axis=0), (0, 0, turn * 4), atol=1e-12)
    assert np.all(np.sign(mesh.area_vectors[:, 2]) == turn)


def test_a_hole_is_not_filled():
    hole = np.array([[0.5, 0.5, 0], [1.5, 0.5, 0], [1.5, 1.5, 0], [0.5, 1.5, 0]])
    assert filled(SQUARE, [hole], size=0.3).areas.sum() == pytest.approx(4 - 1, rel=1e-12)


def test_a_missing_system_library_is_named_with_the_packages_that_hold_it(monkeypatch):
    class Broken:
        def find_spec(self, name, path=None, target=None):
            if name == "gmsh":
                raise OSError("libGLU.so.1: cannot open shared object file")

    monkeypatch.delitem(sys.modules, "gmsh", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Broken(), *sys.meta_path])
    with pytest.raises(ImportError, match=r"libGLU\.so\.1.*libglu1-mesa"), gmsh_session.session("a"):
        pass
