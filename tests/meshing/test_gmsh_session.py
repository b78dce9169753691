import re
import signal
import subprocess
import sys
import threading
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing import gmsh_session
from hakobune.meshing.files import write_mesh
from hakobune.meshing.gmsh_session import filled, graded_patches, session
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import PanelMesh
from hakobune.meshing.shapes import box, buoy

SQUARE = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0.0]])


def test_a_session_is_closed_even_after_an_error():
    with pytest.raises(RuntimeError, match="on purpose"), session("a") as gmsh:
        raise RuntimeError("on purpose")
    assert not gmsh.isInitialized()


def test_a_session_of_the_caller_is_left_as_it_was():
    import gmsh

    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        for name in ("mine", "mine as well"):
            gmsh.model.add(name)
        gmsh.model.setCurrent("mine")
        gmsh.option.setNumber("General.Terminal", 1)
        box(10, 5, 2, panels=40)
        assert [name for name in gmsh.model.list() if name] == ["mine", "mine as well"]
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


def test_triangles_about_a_pole_have_it_as_their_last_corner_wherever_it_was():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 2, 0.0]])
    corners = [[0, 1, 2, 2], [2, 0, 1, 1], [1, 2, 0, 0], [1, 3, 2, 2], [0, 1, 3, 2]]
    found = gmsh_session._poles_last(PanelMesh(points, corners), [points[0]])
    assert found.corners.tolist() == [[1, 2, 0, 0], [1, 2, 0, 0], [1, 2, 0, 0], [1, 3, 2, 2], [0, 1, 3, 2]]


def test_every_point_and_panel_of_a_gmsh_file_has_a_number_of_its_own(tmp_path):
    """Format 4.1: numbers of nodes in lines of one integer, elements in lines that begin with theirs"""
    hull = buoy(10, 5, counts=(2, 2, 2))
    write_mesh(hull, tmp_path / "a.msh", lid(hull))
    lines = (tmp_path / "a.msh").read_text().splitlines()
    nodes = [int(row) for row in lines[lines.index("$Nodes") + 2 : lines.index("$EndNodes")] if row.isdigit()]
    rows = [row.split() for row in lines[lines.index("$Elements") + 2 : lines.index("$EndElements")]]
    tags, head = [], 0
    for row in rows:
        if head:
            tags.append(int(row[0]))
            head -= 1
        else:
            head = int(row[3])
    assert len(nodes) == len(set(nodes)) == len(hull.whole().points) + len(lid(hull).whole().points)
    assert len(tags) == len(set(tags)) == hull.total + lid(hull).total


@pytest.mark.skipif(not hasattr(signal, "SIGPIPE"), reason="needs SIGPIPE")
def test_a_closed_pipe_is_an_exception_after_meshing_and_not_the_end_of_the_program():
    code = (
        "import os\nfrom meshing.gmsh_session import session\nwith session('a'): pass\n"
        "read, write = os.pipe()\nos.close(read)\n"
        "try:\n    os.write(write, b'x')\nexcept BrokenPipeError:\n    print('told')\n"
    )
    made = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (made.returncode, made.stdout) == (0, "told\n")


def test_a_session_within_an_open_gmsh_takes_away_its_own_model_alone():
    """Whichever is current at its end; the one before is current again, and as loud as it was"""
    import gmsh

    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.add("mine")
        with session("ours") as inner:
            assert inner.model.getCurrent() == "ours"
            inner.model.add("beside")
        assert set(gmsh.model.list()) >= {"mine", "beside"} and "ours" not in gmsh.model.list()
        assert gmsh.model.getCurrent() == "mine" and gmsh.isInitialized()
    finally:
        gmsh.finalize()
    with session("alone") as inner:
        assert inner.model.getCurrent() == "alone"
    assert not gmsh.isInitialized()


def ignored(number):
    """Whether this process ignores a signal, as Linux has it in its mask; True where that is not known"""
    status = Path("/proc/self/status")
    found = re.search(r"SigIgn:\s*(\w+)", status.read_text() if status.exists() else "")
    return not found or bool(int(found[1], 16) >> (number - 1) & 1)


def test_a_closed_pipe_is_python_s_again_once_gmsh_is_open(monkeypatch):
    """gmsh takes SIGPIPE when it is initialised, and not when it is there already"""
    asked = []
    monkeypatch.setattr(gmsh_session, "_restore_sigpipe", lambda: asked.append("again"))
    with session("outer"):
        assert asked == ["again"]
        asked.clear()
    with session("next"):
        assert asked == ["again"]
    import gmsh

    asked.clear()
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        with session("within"):
            assert asked == []
    finally:
        gmsh.finalize()
    monkeypatch.undo()
    before = signal.getsignal(signal.SIGPIPE)
    with session("last"):
        assert signal.getsignal(signal.SIGPIPE) is before and ignored(signal.SIGPIPE)


def test_triangles_about_several_poles_have_them_last_whichever_corner_they_are():
    """Of two poles each with a triangle that has it first, second or third; quadrilaterals stay as they are"""
    points = np.array([[0.0, 0, 0], [5.0, 0, 0], [1.0, 1, 0], [2.0, 0, 0], [3.0, 1, 0], [4.0, 2, 0]])
    corners = [[0, 2, 3, 3], [2, 0, 3, 3], [2, 3, 0, 0], [1, 4, 5, 5], [4, 1, 5, 5], [4, 5, 1, 1], [0, 2, 3, 4]]
    found = gmsh_session._poles_last(PanelMesh(points, corners), [points[0], points[1]]).corners.tolist()
    assert found == [[2, 3, 0, 0], [3, 2, 0, 0], [2, 3, 0, 0], [4, 5, 1, 1], [5, 4, 1, 1], [4, 5, 1, 1], [0, 2, 3, 4]]


@pytest.mark.parametrize("up, order", [(1.0, [0, 1, 2, 3]), (-1.0, [0, 3, 2, 1])])
def test_panels_of_a_surface_that_faces_the_other_way_are_turned(up, order):
    """A square whose corners go round anticlockwise as seen from above, so that its normal points up"""
    of_kind = {gmsh_session.QUADRANGLE: [1, 2, 3, 4], gmsh_session.TRIANGLE: []}
    mesh = SimpleNamespace(getElementsByType=lambda kind, surface: (None, np.array(of_kind[kind])))
    gmsh, row = SimpleNamespace(model=SimpleNamespace(mesh=mesh)), np.arange(-1, 4)
    (corners,) = gmsh_session._surface_panels(gmsh, 1, row, SQUARE, np.array([0.0, 0.0, up]))
    assert corners.tolist() == order
