"""The public names of `hakobune`: found, described, typed, and loaded when they are asked for."""

import inspect
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import hakobune

ROOT = Path(__file__).parents[1]
UNIT = r"(?<![\w'])(SI|units?)\b"
WITHOUT = ("read", "open_database")  # functions of a path alone
CLASSES = [hakobune.Database, hakobune.Quantity, hakobune.Result]
FUNCTIONS = [name for name in hakobune.__all__ if inspect.isfunction(getattr(hakobune, name))]


def python(*words):
    """What another process prints"""
    done = subprocess.run([sys.executable, *words], capture_output=True, text=True, check=True, cwd=ROOT)
    return done.stdout.split()


@pytest.mark.parametrize("name", hakobune.__all__)
def test_a_public_name_is_there_and_described(name):
    assert name in dir(hakobune)
    assert inspect.getdoc(getattr(hakobune, name))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_public_function_has_typed_arguments_and_says_its_units_and_what_it_returns(name):
    function = getattr(hakobune, name)
    signature = inspect.signature(function)
    assert all(one.annotation is not one.empty for one in signature.parameters.values())
    assert signature.return_annotation in ("Result", "Database")
    if name not in WITHOUT:
        assert re.search(UNIT, function.__doc__), f"{name} says no unit"
        missing = [one for one in signature.parameters if not re.search(rf"\b{one}\b", function.__doc__)]
        assert not missing, f"the docstring of {name} is silent on {missing}"


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.__name__)
def test_a_class_that_users_meet_has_typed_methods_that_say_what_they_give(kind):
    members = {name: inspect.getattr_static(kind, name) for name in vars(kind) if not name.startswith("_")}
    for name, one in members.items():
        function = getattr(one, "fget", None) or getattr(one, "func", None) or one
        if inspect.isfunction(function):
            assert "return" in function.__annotations__, name
            assert function.__doc__ or name == "numeric", name


def test_importing_hakobune_is_quick_and_loads_no_numpy():
    code = "import sys, time; import hakobune; print(time.process_time(), 'numpy' in sys.modules)"
    seconds, heavy = python("-c", code)
    assert float(seconds) < 0.3 and heavy == "False"  # with the start of Python


def test_the_version_is_told_by_the_package_and_by_the_module():
    assert python("-m", "hakobune", "--version") == [hakobune.__version__]


def test_an_unknown_name_is_an_attribute_error_that_tells_the_names():
    with pytest.raises(AttributeError, match=r"hakobune has no 'moored'; it has .*moor"):
        _ = hakobune.moored


def test_modules_and_tables_of_the_packages_are_in_the_distribution():
    """Folders of modules are packages, which setuptools finds, and other files match the globs of package-data"""
    data = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["package-data"]
    folders = {package: ROOT.joinpath(*package.split(".")[1:]) for package in data if package != "hakobune"}
    installed = {file for package, folder in folders.items() for glob in data[package] for file in folder.glob(glob)}
    for layer in ("meshing", "bem", "mooring", "pipelines"):
        files = [file for file in (ROOT / layer).rglob("*") if file.is_file() and "__pycache__" not in file.parts]
        assert all((file.parent / "__init__.py").is_file() for file in files if file.suffix == ".py")
        assert {file for file in files if file.suffix != ".py"} <= installed
    assert data["hakobune"] == ["py.typed"]
