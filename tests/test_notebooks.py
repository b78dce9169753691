"""The notebooks of the guide run, cell by cell, with the public names alone."""

import ast
import json
import re
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[1] / "docs" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def cells(path):
    """[text] of the code cells"""
    found = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in found if cell["cell_type"] == "code"]


def run(code, names):
    """The value of a cell's last line, as a notebook shows it"""
    tree = ast.parse(code)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    return None if last is None else eval(compile(ast.Expression(last.value), "cell", "eval"), names)


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """A function of a notebook's name: [value of each code cell], run in an empty folder"""
    made = {}

    def of(name):
        if name not in made:
            with pytest.MonkeyPatch.context() as patch:
                patch.setenv("MPLBACKEND", "agg")
                patch.chdir(tmp_path_factory.mktemp(name))
                names = {}
                made[name] = [run(code, names) for code in cells(FOLDER / f"{name}.ipynb")]
        return made[name]

    return of


@pytest.mark.filterwarnings("ignore::UserWarning")  # what a study remarks
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_its_results_show_tables(path, shown):
    values = shown(path.stem)
    tables = [value for value in values if hasattr(value, "_repr_html_")]
    assert tables and all("<t" in value._repr_html_() for value in tables)


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_what_the_notebooks_say_of_their_numbers_holds(shown):
    motion, error = shown("body")[4]
    assert abs(motion[0] - 1) < 0.05 + error[0]  # ω = 0.42 rad/s, beam sea: the body follows the wave
    ratio = shown("sweep")[-1]
    assert ratio.max() / ratio.min() - 1 < 1e-12  # E = C_M C_e M v²/2
    assert abs(shown("berthing")[-1]) < 1e-3  # of the energy
    assert shown("extremes")[-1]


def test_the_notebooks_are_five_stripped_and_named_in_the_guide():
    guide = (FOLDER.parent / "library.md").read_text(encoding="utf-8")
    assert len(NOTEBOOKS) == 5
    for path in NOTEBOOKS:
        found = [c for c in json.loads(path.read_text(encoding="utf-8"))["cells"] if c["cell_type"] == "code"]
        assert f"notebooks/{path.name}" in guide
        assert not any(cell["outputs"] or cell["execution_count"] for cell in found)
        imported = re.findall(r"^\s*(?:from|import) .*", "\n".join(cells(path)), re.M)
        assert imported == ["import hakobune"]
