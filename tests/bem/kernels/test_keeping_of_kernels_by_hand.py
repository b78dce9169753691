"""What is done with the file of a kernel: found, claimed, left to others, told where it cannot be kept."""

import pickle
import threading
import time
from types import SimpleNamespace

import pytest

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
