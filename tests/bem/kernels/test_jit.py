"""The cache of kernels: what a kernel is made of changes where it is kept."""

import ast
import gc
import os
import runpy
import shutil
import sys
import time
from pathlib import Path

import forked
import numba  # loaded once: a second for each process that begins without it
import numpy as np
import pytest

from hakobune import bem
from hakobune.bem.kernels import jit, kept
from hakobune.bem.kernels.jit import as_python, kernel
from hakobune.bem.kernels.sources import Sources, imported

ROOT = Path(bem.__file__).parents[1]
COMPILED = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="as plain Python no kernel is compiled and kept")


def ended(script, cache, path, *words, before=""):
    """What a process of its own, which knows no kernel yet, makes of a script; path : where it finds its modules"""

    def work():
        os.environ["HAKOBUNE_CACHE"] = str(cache)
        sys.argv, sys.path[:0] = [str(script), *map(str, words)], [str(path)]
        exec(before, {})
        runpy.run_path(str(script), run_name="__main__")

    return forked.ended(work)


CALLEE = """from hakobune.bem.kernels.jit import kernel
from {constants} import STEP


@kernel()
def step(x):
    return x + STEP
"""
CALLER = """import sys
from hakobune.bem.kernels import jit
jit.ROOT = jit.Path(sys.argv[1])
from hakobune.bem.kernels.jit import kernel
from {callee} import step


@kernel()
def called(x):
    return 10 * step(x)


print(called(1.0))
"""


def test_a_second_change_in_one_tick_of_the_clock_is_seen(tmp_path):
    file, kept = tmp_path / "constants.py", tmp_path / "sources.json"

    def digest(text):
        file.write_text(text)
        os.utime(file, ns=(now, now))  # as a file system writes whose clock has not moved
        return Sources(tmp_path, kept).digest(file)

    now = time.time_ns()
    assert digest("STEP = 1.0\n") != digest("STEP = 2.0\n")


@COMPILED
def test_a_comment_or_a_docstring_compiles_nothing_again(tmp_path):
    (tmp_path / "constants.py").write_text("STEP = 1.0\n")
    callee, caller = tmp_path / "callee.py", tmp_path / "caller.py"
    callee.write_text(CALLEE.format(constants="constants"))
    caller.write_text(CALLER.format(callee="callee"))

    def kept():
        assert ended(caller, tmp_path / "cache", tmp_path, tmp_path).stdout == "20.0\n"
        return sorted(file.relative_to(tmp_path) for file in (tmp_path / "cache").rglob("*.kernel"))

    before = kept()
    callee.write_text(
        '"""A module"""\n# a comment\n\n' + callee.read_text().replace("(x):", '(x):\n    """x and one"""')
    )
    assert kept() == before and len(before) == 2


def test_a_changed_callee_or_constant_in_any_folder_changes_the_result_of_a_cached_caller(tmp_path):
    house = tmp_path / "house"
    for room in ("beside", "far/away"):
        (house / room).mkdir(parents=True)
    (house / "far/away/constants.py").write_text("STEP = 1.0\n")
    (house / "beside/callee.py").write_text(CALLEE.format(constants="far.away.constants"))
    (house / "caller.py").write_text(CALLER.format(callee="beside.callee"))

    def result():
        done = ended(house / "caller.py", tmp_path / "cache", house, house)
        assert done.status == 0, done.stderr
        return float(done.stdout)

    assert result() == result() == 20.0
    (house / "far/away/constants.py").write_text("STEP = 2.0\n")
    assert result() == 30.0
    callee = house / "beside/callee.py"
    callee.write_text(callee.read_text().replace("x + STEP", "x + 2 * STEP"))
    assert result() == 50.0


FULL = """import resource, signal
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))  # every write fails, as on a full disk
"""


@COMPILED
@pytest.mark.parametrize(("place", "before"), [("file/cache", ""), ("cache", FULL)], ids=["unwritable", "full"])
def test_kernels_that_cannot_be_kept_are_used_and_left_nowhere_else(tmp_path, place, before):
    (tmp_path / "file").write_text("")
    (tmp_path / "constants.py").write_text("STEP = 1.0\n")
    (tmp_path / "callee.py").write_text(CALLEE.format(constants="constants"))
    (tmp_path / "caller.py").write_text(before + CALLER.format(callee="callee"))
    done = ended(tmp_path / "caller.py", tmp_path / place, tmp_path, tmp_path)
    assert (done.status, done.stdout) == (0, "20.0\n"), done.stderr
    (line,) = done.stderr.splitlines()  # one for both kernels
    assert str(tmp_path / place) in line and "set HAKOBUNE_CACHE" in line
    assert not [*tmp_path.rglob("*.kernel")]


@pytest.mark.parametrize("package", ["bem", "mooring"])
def test_every_module_that_a_source_imports_is_found(package):
    for file in (ROOT / package).rglob("*.py"):
        assert set(imported(file, ROOT)) >= set(by_parsing(file)), file


def test_a_change_of_a_command_compiles_no_kernel_again():
    """Sources of kernels reach sources of `bem`, `mooring` and `meshing` alone, even through others"""
    sources, house = Sources(str(ROOT)), [ROOT / name for name in ("bem", "mooring")]
    kernels = [file for folder in house for file in folder.rglob("*.py") if "\n@kernel(" in file.read_text()]
    reached = {file for one in kernels for file in sources.of(one)}
    assert len(kernels) > 40 and len(reached) > len(kernels)
    assert {Path(file).relative_to(ROOT).parts[0] for file in reached} <= {"bem", "mooring", "meshing"}


def by_parsing(file):
    """Files of the modules that the syntax tree of a source imports"""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            folder = file.parents[node.level - 1] if node.level else ROOT
            places = [folder.joinpath(*(node.module or "").removeprefix("hakobune.").split("."))]
            places += [places[0] / alias.name for alias in node.names]
            yield from (
                place.with_suffix(".py") for place in places if place.name and place.with_suffix(".py").is_file()
            )


TWO_CALLERS = """import sys
from hakobune.bem.kernels import jit
jit.ROOT = jit.Path(sys.argv[1])
from hakobune.bem.kernels.jit import kernel


@kernel()
def inner(a):
    return 2 * a[0]


@kernel()
def outer(a):
    return inner(a) + 1


import numpy as np
a = np.ones(3)
print(*((outer(a), inner(a)) if sys.argv[2] == "outer" else (inner(a), outer(a))))
"""


@COMPILED
def test_a_kernel_called_by_python_and_by_another_has_a_version_for_each_in_any_order(tmp_path):
    (tmp_path / "two.py").write_text(TWO_CALLERS)

    def printed(order):
        return ended(tmp_path / "two.py", tmp_path / "cache", tmp_path, tmp_path, order).stdout

    assert [printed(order) for order in ("outer", "inner", "outer")] == ["3.0 2.0\n", "2.0 3.0\n", "3.0 2.0\n"]
    kept = [file for file in tmp_path.rglob("*.kernel") if "inner" in file.name]
    assert sorted(file.parent.name == "called" for file in kept) == [False, True], kept


LONG = """import sys
from hakobune.bem.kernels import jit
jit.ROOT = jit.Path(sys.argv[1])
from hakobune.bem.kernels.jit import kernel


@kernel()
def inner(x):
    total = 0.0
    for i in range(x.size):
        total += x[i]
{more}
    return total


@kernel()
def outer(x):
    return 2 * inner(x)


import numpy as np
print(outer(np.ones(100)))
"""


NOTHING_THERE = """
from hakobune.bem.kernels.kept import Kept
Kept.load_overload = lambda kept, signature, context: rtsys.initialize(context)
from numba.core.runtime import rtsys
"""  # as another process finds it that begins at the same time


@COMPILED
def test_a_long_kernel_is_kept_once_and_its_caller_always_fits_it(tmp_path):
    more = "".join(f"    total += np.sqrt(x[{i}]) / x[{i + 1}] * x[{i + 2}]\n" for i in range(24))
    (tmp_path / "long.py").write_text("import numpy as np\n" + LONG.format(more=more))
    script = tmp_path / "script.py"
    script.write_text("import long")

    def kept_after(before=""):
        """Files of both kernels, in which their caller is"""
        done = ended(script, tmp_path / "cache", tmp_path, tmp_path, before=before)
        assert (done.status, done.stdout) == (0, "248.0\n"), done.stderr
        return {file.name.partition("-")[0]: file for file in tmp_path.rglob("*.kernel")}

    files = kept_after()
    assert files.keys() == {"inner", "outer"} and files["inner"].parent.name == "called"
    assert b"llvm.sqrt" not in files["outer"].read_bytes()
    files["inner"].unlink()
    before = files["outer"].stat().st_mtime_ns
    assert kept_after()["outer"].stat().st_mtime_ns > before  # compiled again
    assert kept_after() == files
    files["outer"].unlink()
    begun_together = kept_after(NOTHING_THERE)["outer"].stat().st_mtime_ns  # its inner one is not the one that is kept
    assert kept_after()["outer"].stat().st_mtime_ns > begun_together
    assert kept_after() == files


COMPILED_MEANWHILE = """
import shutil
from hakobune.bem.kernels import jit, kept
def waited(file):
    shutil.copytree({kept!r}, {cache!r}, dirs_exist_ok=True)
kept.claimed, kept.Kept.save_overload = waited, None  # nothing is compiled
"""


@COMPILED
def test_a_kernel_that_another_process_has_compiled_meanwhile_is_taken_from_it(tmp_path):
    (tmp_path / "two.py").write_text(TWO_CALLERS)
    cache, aside = tmp_path / "cache", tmp_path / "aside"

    def kept_after(before=""):
        done = ended(tmp_path / "two.py", cache, tmp_path, tmp_path, "outer", before=before)
        assert (done.status, done.stdout) == (0, "3.0 2.0\n"), done.stderr
        return {file.relative_to(cache): file.read_bytes() for file in cache.rglob("*.kernel")}

    alone = kept_after()
    assert len(alone) == 3 and not [*cache.rglob("*.lock")]
    shutil.move(cache, aside)
    assert kept_after(COMPILED_MEANWHILE.format(kept=str(aside), cache=str(cache))) == alone


def test_a_kernel_is_claimed_by_one_process_until_this_ends_or_has_taken_too_long(tmp_path, monkeypatch):
    file, claimed = tmp_path / "folder" / "one.kernel", kept.claimed
    first = claimed(file)
    monkeypatch.setattr(kept, "PATIENCE", 0.02)
    assert first is not None and claimed(file) is None
    first.close()  # as the end of a process does
    second = claimed(file)
    assert second is not None
    second.close()
    (tmp_path / "no_folder").touch()
    assert claimed(tmp_path / "no_folder" / "one.kernel") is None


@COMPILED
def test_python_collects_no_garbage_while_kernels_compile_and_then_as_before():
    from numba.core import event

    assert adds.called is not None  # numba is loaded

    def compiled(collects):
        with event.trigger_event("numba:compile"):
            with event.trigger_event("numba:compile"):
                pass
            assert not gc.isenabled()
        assert gc.isenabled() is collects

    compiled(True)
    gc.disable()
    try:
        compiled(False)
    finally:
        gc.enable()


@kernel()
def adds(x):
    return x + 1.0


@kernel()
def part_of(x, y):
    return adds(x) / y


@COMPILED
def test_a_kernel_runs_as_python_where_asked_and_compiled_where_python_refuses():
    fresh = kernel()(part_of.function)
    with as_python():
        assert fresh(2.0, 4.0) == 0.75 and fresh._entry is None
        assert fresh(2.0, 0.0) == np.inf and fresh._entry is not None
        with pytest.raises(RuntimeError), as_python():
            raise RuntimeError
        assert kernel()(part_of.function)(2, 8) == 0.375  # still within the first
    after = kernel()(part_of.function)
    assert after(2.0, 4.0) == 0.75 and after._entry is not None


@pytest.mark.parametrize(("given", "folder"), [
    ({}, "home/.cache/hakobune"), ({"XDG_CACHE_HOME": "/xdg"}, "/xdg/hakobune"),
    ({"XDG_CACHE_HOME": "/xdg", "HAKOBUNE_CACHE": "/own"}, "/own"), ({"HAKOBUNE_CACHE": "/own"}, "/own"),
])  # fmt: skip
def test_kernels_are_kept_in_the_cache_of_the_user_unless_a_folder_is_named(monkeypatch, tmp_path, given, folder):
    for name in ("XDG_CACHE_HOME", "HAKOBUNE_CACHE"):
        monkeypatch.delenv(name, raising=False)
    for name, value in (given | {"HOME": str(tmp_path / "home")}).items():
        monkeypatch.setenv(name, value)
    assert jit._base() == tmp_path / folder


def test_the_sources_of_kernels_are_looked_for_beside_all_packages_of_the_house():
    assert jit.ROOT == ROOT and (jit.ROOT / "meshing" / "__init__.py").is_file()
