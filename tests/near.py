"""Which tests are near a change, by the imports between tests and modules.

A test that imports a changed module, or names it in a text, has distance 1, one that imports a module that imports it
2, and so on; the conftest.py of a folder counts as imported by its tests.  Commands import everything: what mirrors
the folder of the change, and what names the changed function, comes before others at the same distance.
"""

import re
from functools import cache
from pathlib import Path

from hakobune.bem.kernels.sources import imported

ROOT = Path(__file__).parents[1]
PACKAGES = ("meshing", "bem", "mooring", "pipelines")
MIRRORED, NAMED = 3, 2  # imports that these are worth
NAMES = re.compile(rf'"(?:hakobune\.)?((?:{"|".join(PACKAGES)})\.[\w.]+)"')  # of modules, in texts of tests
ROOMS = re.compile(rf'f"(?:hakobune\.)?((?:{"|".join(PACKAGES)})(?:\.\w+)*)\.\{{\w+\}}')  # f"bem.panels.{name}"
WORDS = re.compile(r'"(\w+(?:\.\w+)*)"')


@cache
def test_files(root=ROOT):
    return tuple(sorted((root / "tests").rglob("test_*.py")))


@cache
def importers(root=ROOT):
    """{file: files that import it directly}, of packages and tests"""
    found = {}
    files = [file for package in (*PACKAGES, "tests") for file in (root / package).rglob("*.py")]
    for file in files:
        for other in _imports(file, root):
            found.setdefault(other, set()).add(file)
    return found


def _imports(file, root):
    tests = root / "tests"
    both = {*imported(file, root), *imported(file, tests)}
    if tests in file.parents:
        text = file.read_text(encoding="utf-8")
        names = [
            *NAMES.findall(text),
            *(f"{room}.{word}" for room in ROOMS.findall(text) for word in WORDS.findall(text)),
        ]
        both |= {module for name in names if (module := _module(name, root))}
        both |= {place / "conftest.py" for place in file.parents if tests == place or tests in place.parents}
    return both - {file}


def _module(name, root):
    """The file of a module, or of what is in it, by its name below `hakobune`; None for other names"""
    parts = name.split(".")
    paths = (root.joinpath(*parts[:n]).with_suffix(".py") for n in range(len(parts), 0, -1))
    return next((path for path in paths if path.is_file()), None)


def distances(changed, root=ROOT):
    """{file: number of imports to the nearest of the changed files}"""
    found, step, edge = {}, 0, set(changed)
    while edge:
        found |= dict.fromkeys(edge, step)
        edge = {file for other in edge for file in importers(root).get(other, ())} - found.keys()
        step += 1
    return found


def mirrored(file, root=ROOT):
    """The folder of tests that mirrors that of a file, or the next above: rooms within rooms have none of their own"""
    folder = root / "tests" / file.relative_to(root).parent
    return next(one for one in (folder, *folder.parents) if one.is_dir())


def nearest(changed, names=(), root=ROOT):
    """Test files that changed files can reach, the nearest first.

    changed : Paths below `root`; names : words, as of changed functions, whose mention brings a test nearer
    """
    far = distances(changed, root)
    folders = {mirrored(file, root) for file in changed}
    words = re.compile("|".join(rf"\b{re.escape(name)}\b" for name in names)) if names else None

    def rank(test):
        mentions = len(words.findall(test.read_text(encoding="utf-8"))) if words else 0
        distance = far[test] - MIRRORED * (test.parent in folders)
        return test not in changed, distance - NAMED * bool(mentions), -mentions, test

    return sorted((test for test in test_files(root) if test in far), key=rank)
