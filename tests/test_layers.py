"""The layers of the house, read from the imports."""

import ast
import subprocess
import sys
from collections import Counter
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parent.parent
PACKAGE = "hakobune."
LAYERS = ("meshing", "bem", "mooring", "pipelines")
WHERE_USED = ("pyvista", "matplotlib", "meshio", "scipy.linalg", "rich", "xarray")
FILES = sorted(file for layer in LAYERS for file in (ROOT / layer).rglob("*.py"))
FOLDERS = sorted({file.parent for file in FILES})


class Import(NamedTuple):
    """One statement: dots before the module, module of `from` or None, names, whether at the top of the file"""

    level: int
    module: str | None
    names: tuple
    top: bool


@cache
def imports(file):
    """Every `Import` of a file; the trees themselves, millions of nodes, are not kept"""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    top = set(map(id, tree.body))
    return [
        Import(
            getattr(node, "level", 0), getattr(node, "module", None), tuple(a.name for a in node.names), id(node) in top
        )
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
    ]


def modules(file):
    """(module, whether at top level) of every absolute import."""
    for one in imports(file):
        if one.module is None and not one.level:
            yield from ((name.removeprefix(PACKAGE), one.top) for name in one.names)
        elif not one.level:
            for name in (one.module, *(f"{one.module}.{part}" for part in one.names)):
                yield name.removeprefix(PACKAGE), one.top


@cache
def modules_imported(file):
    """Files of the modules below the root that a file imports, in its functions too"""
    package, found = file.relative_to(ROOT).parts[:-1], set()
    for one in imports(file):
        if one.module is None and not one.level:
            found |= {file_of(ROOT, name.removeprefix(PACKAGE)) for name in one.names}
            continue
        start = ROOT.joinpath(*package[: len(package) - one.level + 1]) if one.level else ROOT
        origin = (one.module or "").removeprefix(PACKAGE) if one.module != "hakobune" else ""
        for name in one.names:
            found.add(file_of(start, f"{origin}.{name}".lstrip(".")) or file_of(start, origin))
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


def test_packages_import_only_from_those_left_of_them():
    wrong = []
    for file in FILES:
        layer = file.relative_to(ROOT).parts[0]
        right = LAYERS[LAYERS.index(layer) + 1 :] + (() if file.name == "gmsh_session.py" else ("gmsh",))
        for module, top in modules(file):
            if any(is_or_in(module, other) for other in right):
                wrong.append(f"{file.relative_to(ROOT)} imports {module}")
            if top and any(is_or_in(module, other) for other in WHERE_USED):
                wrong.append(f"{file.relative_to(ROOT)} imports {module} at its head, not where it is used")
    assert wrong == []


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
        for one in (one for one in imports(file) if one.module is not None or one.level):
            name, folder = one.module or "", file.parents[one.level - 1] if one.level else ROOT
            if (one.level or name.startswith(PACKAGE)) and file_of(folder, name.removeprefix(PACKAGE)) is None:
                gone.append(f"{file.relative_to(ROOT)}: {name}")
    assert gone == []


def test_a_circle_of_modules_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    (tmp_path / "bem").mkdir()
    one, other = tmp_path / "bem" / "one.py", tmp_path / "bem" / "other.py"
    one.write_text("from .other import x\n")
    other.write_text("def f():\n    from hakobune.bem import one\n")
    assert circle_of({file: modules_imported(file) for file in (one, other)}) is not None


def test_no_module_imports_the_room_of_validation():
    room = ROOT / "pipelines" / "validation"
    users = {file for file in FILES if any(room in one.parents for one in modules_imported(file))}
    assert {file for file in users if room not in file.parents} == set()


def test_no_folder_has_more_than_fifteen_modules():
    counts = Counter(file.parent.relative_to(ROOT) for file in FILES if file.name != "__init__.py")
    assert {folder: count for folder, count in counts.items() if count > 15} == {}


@pytest.mark.parametrize("file", sorted((ROOT / "tests" / "exact").glob("*.py")), ids=lambda file: file.name)
def test_exact_solutions_share_no_code_with_what_they_judge(file):
    assert not [m for m, _ in modules(file) if any(is_or_in(m, layer) for layer in LAYERS)]


def test_only_the_mesher_sees_gmsh():
    users = [file.name for file in FILES if any(is_or_in(module, "gmsh") for module, _ in modules(file))]
    assert users == ["gmsh_session.py"]


@pytest.mark.parametrize("module", ["hakobune.bem.database", "hakobune.mooring", "hakobune.pipelines.scene.scene"])
def test_reading_and_mooring_load_nothing_heavy(module):
    heavy = ("numba", "gmsh", "pyvista", "matplotlib", "scipy.optimize", "scipy.interpolate", "scipy.spatial")
    code = f"import sys, {module}; print(*[m for m in {heavy} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.split() == []
