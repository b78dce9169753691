"""The layers of the house, read from the imports."""

import ast
import subprocess
import sys
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGE = "hakobune."
LAYERS = ("meshing", "bem", "mooring", "pipelines")
WHERE_USED = ("pyvista", "matplotlib", "meshio", "scipy.linalg", "rich", "xarray")
FILES = sorted(file for layer in LAYERS for file in (ROOT / layer).rglob("*.py"))
FOLDERS = sorted({file.parent for file in FILES})


def imports(tree):
    """(module, whether at top level) of every absolute import."""
    top = set(map(id, tree.body))
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name.removeprefix(PACKAGE), id(node) in top
        elif isinstance(node, ast.ImportFrom) and not node.level:
            for name in (node.module, *(f"{node.module}.{alias.name}" for alias in node.names)):
                yield name.removeprefix(PACKAGE), id(node) in top


@cache
def tree_of(file):
    return ast.parse(file.read_text(encoding="utf-8"))


@cache
def modules_imported(file):
    """Files of the modules below the root that a file imports, in its functions too"""
    package, found = file.relative_to(ROOT).parts[:-1], set()
    for node in ast.walk(tree_of(file)):
        if isinstance(node, ast.Import):
            found |= {file_of(ROOT, alias.name.removeprefix(PACKAGE)) for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            start = ROOT.joinpath(*package[: len(package) - node.level + 1]) if node.level else ROOT
            name = (node.module or "").removeprefix(PACKAGE) if node.module != "hakobune" else ""
            for alias in node.names:
                found.add(file_of(start, f"{name}.{alias.name}".lstrip(".")) or file_of(start, name))
    return frozenset(found - {None, file})


def file_of(folder, name):
    """The file of a dotted name below a folder, None if there is none"""
    place = folder.joinpath(*filter(None, name.split(".")))
    return next((one for one in (place.with_suffix(".py"), place / "__init__.py") if one.is_file()), None)


def circle_of(needs):
    """The first circle in {node: nodes}, as names below the root, or None"""
    try:
        list(TopologicalSorter(needs).static_order())
    except CycleError as error:
        return [str(node.relative_to(ROOT)) for node in error.args[1]]
    return None


def is_or_in(module, package):
    return module == package or module.startswith(package + ".")


@pytest.mark.parametrize("file", FILES, ids=lambda file: f"{file.parent.name}/{file.name}")
def test_a_package_imports_only_from_those_left_of_it(file):
    layer = file.relative_to(ROOT).parts[0]
    right = LAYERS[LAYERS.index(layer) + 1 :]
    modules = list(imports(tree_of(file)))
    assert not [m for m, _ in modules if any(is_or_in(m, other) for other in right)]
    if file.name != "gmsh_session.py":
        assert not [m for m, _ in modules if is_or_in(m, "gmsh")]
    heavy = [m for m, top in modules if top and any(is_or_in(m, other) for other in WHERE_USED)]
    assert not heavy, f"import these where they are used: {heavy}"


def test_folders_import_in_one_direction():
    """Sorted so that each folder imports only from folders before it; a folder is its own files, not those below"""
    needs = {folder: set() for folder in FOLDERS}
    for file in FILES:
        needs[file.parent] |= {one.parent for one in modules_imported(file) if one.name != "__init__.py"}
        needs[file.parent].discard(file.parent)
    assert circle_of(needs) is None


def test_modules_import_in_one_direction():
    """Imports in functions and for annotations count too"""
    assert circle_of({file: modules_imported(file) for file in FILES}) is None


def test_modules_that_are_imported_are_there():
    """Also those that a function imports, which no other test may call"""
    gone = []
    for file in FILES:
        for node in (node for node in ast.walk(tree_of(file)) if isinstance(node, ast.ImportFrom)):
            name, folder = node.module or "", file.parents[node.level - 1] if node.level else ROOT
            if (node.level or name.startswith(PACKAGE)) and file_of(folder, name.removeprefix(PACKAGE)) is None:
                gone.append(f"{file.relative_to(ROOT)}: {name}")
    assert gone == []


def test_a_circle_of_modules_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    (tmp_path / "bem").mkdir()
    one, other = tmp_path / "bem" / "one.py", tmp_path / "bem" / "other.py"
    one.write_text("from .other import x\n")
    other.write_text("def f():\n    from hakobune.bem import one\n")
    assert circle_of({file: modules_imported(file) for file in (one, other)}) is not None


def test_only_the_command_line_imports_the_room_of_validation():
    room = ROOT / "pipelines" / "validation"
    users = {file for file in FILES if any(room in one.parents for one in modules_imported(file))}
    assert {file for file in users if room not in file.parents} == {ROOT / "pipelines" / "cli.py"}


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: str(folder.relative_to(ROOT)))
def test_no_folder_has_more_than_fifteen_modules(folder):
    assert len([file for file in folder.glob("*.py") if file.name != "__init__.py"]) <= 15


@pytest.mark.parametrize("file", sorted((ROOT / "tests" / "exact").glob("*.py")), ids=lambda file: file.name)
def test_exact_solutions_share_no_code_with_what_they_judge(file):
    modules = [m for m, _ in imports(ast.parse(file.read_text(encoding="utf-8")))]
    assert not [m for m in modules if any(is_or_in(m, layer) for layer in LAYERS)]


def test_only_the_mesher_sees_gmsh():
    trees = {file.name: tree_of(file) for file in FILES}
    users = [name for name, tree in trees.items() if any(is_or_in(m, "gmsh") for m, _ in imports(tree))]
    assert users == ["gmsh_session.py"]


@pytest.mark.parametrize("module", ["hakobune.bem.database", "hakobune.mooring", "hakobune.pipelines.scene.scene"])
def test_reading_and_mooring_load_nothing_heavy(module):
    heavy = ("numba", "gmsh", "pyvista", "matplotlib", "scipy.optimize", "scipy.interpolate", "scipy.spatial")
    code = f"import sys, {module}; print(*[m for m in {heavy} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.split() == []
