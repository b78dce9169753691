"""What is done with the file of a kernel: found, claimed, left to others, told where it cannot be kept."""

import pickle
import threading
import time
from types import SimpleNamespace

import pytest
from numba import config

from hakobune.bem.kernels import jit, kept, progress
from hakobune.bem.kernels.kept import Kept, claimed
from hakobune.bem.kernels.sources import put_file


@pytest.fixture
def held(tmp_path, monkeypatch):
    """A `Kept` whose kernel has the file one.kernel, what it told as failed, and whether numba's runtime was started"""
    monkeypatch.setattr(kept, "rtsys", SimpleNamespace(initialize=lambda context: context.append("started")))
    failures = []
    made = Kept(lambda: None, tmp_path, False, failures.append)
    monkeypatch.setattr(made, "_file", lambda signature, context: tmp_path / "one.kernel")
    return made, failures


def test_a_kernel_that_is_nowhere_is_claimed_once_and_left_when_it_is_stored(held, tmp_path, monkeypatch):
    made, failures = held
    context, lock = [], tmp_path / "one.lock"
    assert made.load_overload("signature", context) is None and context == ["started"]
    ((file, claim),) = made.claims.items()
    assert file == tmp_path / "one.kernel" and lock.exists() and not claim.closed
    assert made.load_overload("signature", context) is None and made.claims == {file: claim}  # not claimed again
    saved = []
    monkeypatch.setattr(made, "_save", lambda *them: saved.append(them))
    made.save_overload("signature", SimpleNamespace(target_context="context"))
    assert saved[0][:2] == (file, "signature") and not made.claims and not lock.exists() and claim.closed
    made._leave(file)  # nothing more to leave
    assert failures == []


def test_a_kernel_that_cannot_be_stored_is_told_and_left(held, monkeypatch):
    made, failures = held
    made.load_overload("signature", [])
    error = OSError(28, "No space left on device")

    def full(*arguments):
        raise error

    monkeypatch.setattr(made, "_save", full)
    made.save_overload("signature", SimpleNamespace(target_context="context"))
    assert failures == [error] and not made.claims


def test_a_kernel_that_another_process_stored_meanwhile_is_loaded_and_its_claim_left(held, tmp_path, monkeypatch):
    made, _ = held
    answers = iter([None, "kernel"])
    monkeypatch.setattr(made, "_loaded", lambda *them: next(answers))
    assert made.load_overload("signature", []) == "kernel"
    assert not made.claims and not (tmp_path / "one.lock").exists()


@pytest.mark.parametrize("data, worthless", [
    (None, False), (b"", True), (b"no pickle", True), (pickle.dumps((True, ("stale",))), True),
])  # fmt: skip
def test_a_file_that_holds_no_kernel_is_written_again_and_one_that_is_not_there_is_not_worthless(
    held, tmp_path, monkeypatch, data, worthless
):
    made, _ = held
    file = tmp_path / "one.kernel"
    if data is not None:
        file.write_bytes(data)

    def rebuilt(context, *parts):
        raise kept._StaleError(parts)

    monkeypatch.setattr(kept, "CompileResult", SimpleNamespace(_rebuild=rebuilt))
    assert made._loaded(file, "signature", "context") is None
    assert made.worthless == ({file} if worthless else set())


def test_a_kernel_that_another_compiles_is_waited_for(tmp_path):
    file = tmp_path / "one.kernel"
    first = claimed(file)
    threading.Timer(0.05, first.close).start()
    start = time.monotonic()
    second = claimed(file)
    assert second is not None and time.monotonic() - start > 0.03
    second.close()


def test_what_takes_vectors_or_pointers_is_linked_into_its_callers():
    kinds = [SimpleNamespace(name=name) for name in ("float64", "float64*", "SimdVector(4)")]
    assert [kept._is_inner_loop([kinds[0], kind]) for kind in kinds] == [False, True, True]
    assert not kept._is_inner_loop([])


def test_kernels_that_are_not_kept_are_told_once(monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("HAKOBUNE_CACHE", str(tmp_path / "nowhere"))
    for _ in range(2):
        jit._not_kept(OSError(30, "Read-only file system"))
    told = capsys.readouterr().err
    assert told.count("compiled kernels cannot be stored") == 1
    assert f"in {tmp_path / 'nowhere'} (Read-only file system)" in told


@pytest.mark.skipif(bool(config.DISABLE_JIT), reason="as plain Python no kernel is compiled")
def test_what_waits_for_the_first_kernel_is_called_before_it_and_once(monkeypatch):
    called = []
    monkeypatch.setattr(jit, "_before_first", [])
    jit.before_first_kernel(lambda: called.append("one"))
    jit.before_first_kernel(lambda: called.append("two"))
    first, second = (jit.Kernel(lambda x: x, False, True) for _ in range(2))
    assert called == [] and first._entry is None
    assert first._made("_entry", first._for_python) is first._entry and sorted(called) == ["one", "two"]
    assert second._made("_called", second._for_kernels) is second.called and len(called) == 2
    assert first._made("_entry", None) is first._entry  # made once


def test_a_file_that_cannot_be_replaced_leaves_nothing_beside_it(tmp_path):
    (tmp_path / "there.json").mkdir()
    with pytest.raises(OSError):
        put_file(tmp_path / "there.json", b"data")
    assert [path.name for path in tmp_path.iterdir()] == ["there.json"]
    put_file(tmp_path / "folder" / "one.json", b"data")
    assert (tmp_path / "folder" / "one.json").read_bytes() == b"data"
    assert len(list((tmp_path / "folder").iterdir())) == 1


def test_progress_is_told_to_whoever_asked_last_and_to_nobody_after():
    seen, inner = [], []
    progress.report_progress("waves", 1)
    with progress.progress_callback(lambda *them: seen.append(them)):
        progress.report_progress("waves", 3)
        with progress.progress_callback(lambda *them: inner.append(them)):
            progress.report_progress("matrices", 4)
        with progress.progress_callback(None):
            progress.report_progress("matrices", 5)
        progress.report_progress("factors", 6)
    progress.report_progress("waves", 7)
    assert seen == [("waves", 3), ("factors", 6)] and inner == [("matrices", 4)]


@pytest.mark.parametrize("linked, instructions, inner, apart", [
    (False, 101, False, True), (False, 100, False, False), (True, 500, False, False), (False, 500, True, False),
])  # fmt: skip
@pytest.mark.parametrize("there, worthless, written", [(False, False, True), (True, False, False), (True, True, True)])
def test_a_long_kernel_is_called_by_its_symbol_and_a_file_that_is_there_stays(
    tmp_path, monkeypatch, linked, instructions, inner, apart, there, worthless, written
):
    """More than a hundred instructions, unless it is linked at any length or takes vectors"""
    made, called, file = Kept(lambda: None, tmp_path, linked, None), [], tmp_path / "one.kernel"
    if there:
        file.write_bytes(b"before")
    if worthless:
        made.worthless.add(file)
    monkeypatch.setattr(made, "_called_by", lambda *them: called.append(them))
    monkeypatch.setattr(kept, "dumps", pickle.dumps)
    signature = [SimpleNamespace(name="float64*" if inner else "float64")]
    blocks = [SimpleNamespace(instructions=range(n)) for n in (60, instructions - 60)]
    result = SimpleNamespace(signature=SimpleNamespace(return_type="float64"), _reduce=lambda: "reduced",
                             target_context=SimpleNamespace(enable_nrt=True),
                             fndesc=SimpleNamespace(llvm_func_name="symbol"),
                             library=SimpleNamespace(get_function={"symbol": SimpleNamespace(blocks=blocks)}.get),
                             )  # fmt: skip
    made._save(file, signature, result)
    assert called == [(signature, result, apart)]
    assert file.read_bytes() == (pickle.dumps((apart, "reduced")) if written else b"before")


def test_a_kernel_that_returns_an_array_counts_who_refers_to_it(tmp_path):
    from numba.core import types

    array = types.Array(types.float64, 1, "C")
    made = Kept(lambda: None, tmp_path, True, None)
    for returned in (array, types.Tuple((types.float64, array))):
        result = SimpleNamespace(signature=SimpleNamespace(return_type=returned),
                                 target_context=SimpleNamespace(enable_nrt=False))  # fmt: skip
        with pytest.raises(TypeError, match="returns an array; allowed only with counted=True"):
            made._save(tmp_path / "one.kernel", [], result)
    assert not list(tmp_path.iterdir())


def test_others_link_a_short_kernel_with_what_it_needs_and_of_a_long_one_its_name(monkeypatch):
    """Loaded before a caller: what a linked kernel was compiled with, or the kernel that stands apart itself"""
    made = Kept(test_kernels_that_are_not_kept_are_told_once, None, False, None)
    library = SimpleNamespace(name="library", _reload_init={"own"}, _shared_module="code",
                              _codegen=SimpleNamespace(_create_empty_module=lambda name: f"empty {name}"))  # fmt: skip
    result = SimpleNamespace(library=library, reload_init=["more"], fndesc=SimpleNamespace(llvm_func_name="symbol"))
    made._called_by("signature", result, False)
    assert library._reload_init == {"own", "more"} and library._shared_module == "code"
    monkeypatch.setattr(kept, "binding", SimpleNamespace(parse_assembly=lambda text: ("parsed", text)))
    made._called_by("signature", result, True)
    (callee,) = library._reload_init
    assert library._shared_module == ("parsed", "empty library")
    assert (callee.module, callee.name) == (__name__, "test_kernels_that_are_not_kept_are_told_once")
    assert (callee.signature, callee.symbol) == ("signature", "symbol")


def test_a_kernel_that_was_compiled_again_since_is_stale_to_its_callers(monkeypatch):
    compiled, symbol = [], "symbol"
    overload = SimpleNamespace(fndesc=SimpleNamespace(llvm_func_name=symbol))
    dispatcher = SimpleNamespace(compile=compiled.append, overloads={("float64",): overload})
    monkeypatch.setattr(kept, "import_module", lambda name: SimpleNamespace(one=SimpleNamespace(called=dispatcher)))

    def one():
        pass

    one.__qualname__ = "one"
    kept.Callee(one, ["float64"], "symbol")()
    assert compiled == [["float64"]]
    with pytest.raises(kept._StaleError, match="another"):
        kept.Callee(one, ["float64"], "another")()


def test_files_of_kernels_are_told_apart_by_signature_machine_and_version(tmp_path, monkeypatch):
    made = Kept(test_kernels_that_are_not_kept_are_told_once, tmp_path, False, None)
    context = SimpleNamespace(codegen=lambda: SimpleNamespace(magic_tuple=lambda: ("machine",)))
    other = SimpleNamespace(codegen=lambda: SimpleNamespace(magic_tuple=lambda: ("other",)))
    kinds = [SimpleNamespace(name=name) for name in ("float64", "int64")]
    files = {made._file(kinds, context), made._file(kinds[:1], context), made._file(kinds[::-1], context),
             made._file(kinds, other)}  # fmt: skip
    monkeypatch.setattr(kept, "numba", SimpleNamespace(__version__="0.0"))
    files.add(made._file(kinds, context))
    assert len(files) == 5 and {file.parent for file in files} == {tmp_path}
    assert all(file.name.startswith("test_kernels_that_are_not_kept_are_told_once-") for file in files)
    assert {len(file.stem.rpartition("-")[2]) for file in files} == {16} and {f.suffix for f in files} == {".kernel"}


def test_modules_are_imported_by_name_and_names_from_modules_with_and_without_the_package(tmp_path):
    from hakobune.bem.kernels.sources import imported

    for name in ("one.py", "two.py", "room/__init__.py", "room/three.py", "room/inner/four.py", "room/five.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    source = tmp_path / "room" / "user.py"

    def of(text):
        source.write_text(text)
        return {str(path.relative_to(tmp_path)) for path in imported(source, tmp_path)}

    assert of("import hakobune.one, two, os") == {"one.py", "two.py"}
    assert of("def late():\n    import room.three") == {"room/three.py"}
    assert of("from hakobune.room import three, absent") == {"room/__init__.py", "room/three.py"}
    assert of("from . import five\nfrom .inner import four\nfrom .. import one") == {
        "room/__init__.py", "room/five.py", "room/inner/four.py", "one.py",
    }  # fmt: skip
    assert of("if True:\n    from .inner.four import name\nelse:\n    import two") == {"room/inner/four.py", "two.py"}
    assert of("import numpy\nfrom numpy import linalg") == set()
