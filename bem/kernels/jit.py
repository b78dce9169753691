"""The single way to compile a kernel: numba, each kernel once, with a cache that detects changes of its sources.

numba stamps a cached function with its own file only. A callee edited in another file would continue to return its old
values, and so would an imported constant, which is frozen into the machine code.  The folder of a kernel
therefore has a digest of the sources of its module and of all modules of this repository that it imports directly or
through others (`sources`).  `kept` describes how kernels are stored and called by others.  Without write access kernels
are compiled for the process alone, which a message reports.
"""

import gc
import os
import sys
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from functools import cache, update_wrapper
from pathlib import Path
from threading import RLock

from .in_memory import marked

# read when numba is loaded: where colorama is installed numba colours the words of every rule that does not apply to an
# operator, which takes a twelfth of the time of a compilation
os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")
ROOT = Path(__file__).parents[2]
_one_at_a_time = RLock()
_as_python = ContextVar("whether kernels run as Python", default=False)


def _collect_nothing_meanwhile():
    """While numba compiles, Python does not search its millions of objects for cycles: a seventh of the time"""
    from numba.core import event

    class Pause(event.Listener):
        depth, collects = 0, False

        def on_start(self, event):
            if not self.depth:
                self.collects = gc.isenabled()
                gc.disable()
            self.depth += 1

        def on_end(self, event):
            self.depth -= 1
            if not self.depth and self.collects:
                gc.enable()

    event.register("numba:compile", Pause())


_before_first = [_collect_nothing_meanwhile]


def before_first_kernel(call):
    """Have a function called once numba is loaded, before numba compiles or loads the first kernel of this process"""
    _before_first.append(call)


def cache_folder(file, root):
    """Folder of the compiled kernels of a source file; HAKOBUNE_CACHE or XDG_CACHE_HOME move it."""
    return _base() / _sources(str(root), _base()).digest(file)


@cache
def _sources(root, base):
    from .sources import Sources

    return Sources(root, base / f"sources{root.replace(os.sep, '+')}.json")


def _base():
    base = os.environ.get("HAKOBUNE_CACHE")
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "hakobune" if base is None else Path(base)


@contextmanager
def as_python():
    """Within this, kernels that Python calls run as Python: for a line or two that is quicker than numba's import

    Where Python refuses numbers, as a division by zero, the compiled kernel is called.
    """
    import numpy as np

    before = _as_python.set(True)
    try:
        with np.errstate(all="ignore"):
            yield
    finally:
        _as_python.reset(before)


def kernel(inline=False, counted=True):
    """Decorator: compile to machine code on the first call and keep the result on disk.

    Kernels of `bem` write to given arrays: an allocation, or a direct array assignment, takes a second to compile, for
    its error message.  Kernels start no threads themselves (`bem.kernels.threads.parallel_rows` does).
    inline : always inlined into the kernels that call it; by default as the compiler decides
    counted : whether it counts who refers to arrays, as it must where it makes or returns one.  Where arrays are cut in
    loops, counting took two thirds of the time of two bodies moored to each other
    """

    def decorator(function):
        plain = os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0")
        return function if plain else Kernel(function, inline, counted)

    return decorator


class Kernel:
    """A function that numba, whose import takes 0.25 s, compiles or loads on its first call"""

    def __init__(self, function, inline, counted):
        self.function, self.inline, self.counted = function, inline, counted
        self._entry = self._called = None
        update_wrapper(self, function)

    def __call__(self, *arguments):
        if _as_python.get():
            with suppress(ArithmeticError, ValueError):
                return self.function(*arguments)
        return (self._entry or self._made("_entry", self._for_python))(*arguments)

    @property
    def called(self):
        """Numba's dispatcher of this kernel, for other kernels that call it"""
        return self._called or self._made("_called", self._for_kernels)

    def compile_for(self, *arguments):
        """Compile, for kernels that call this one with such arguments, without a call"""
        compile_version = self.called.compile
        from numba import typeof

        compile_version(tuple(map(typeof, arguments)))

    def _made(self, name, make):
        """A dispatcher, made by the first of several threads that need it"""
        with _one_at_a_time:
            if getattr(self, name) is None:
                setattr(self, name, make())
        return getattr(self, name)

    def _for_python(self):
        return self._dispatcher("")

    def _for_kernels(self):
        """Dispatcher without the code for calls from Python, which unpacks arrays and named tuples of arguments"""
        made = self._dispatcher("called", no_cpython_wrapper=True)
        template = made.get_call_template
        made.get_call_template = lambda args, kws: template(*_without_values(args, kws))
        return made

    @property
    def _numba_type_(self):
        """Type under which numba sees this in kernels that call it"""
        from numba.core.types import Dispatcher

        return Dispatcher(self.called)

    def _dispatcher(self, version, **wrappers):
        """Numba's own dispatcher, with the options of all kernels; a `version` is kept in its own folder"""
        import numba

        while _before_first:
            _before_first.pop()()
        from .kept import Kept

        if marked:
            from .addresses import know

            while marked:
                know(marked.pop())

        # contract and reassoc only: NaN and infinity must stay visible
        made = numba.njit(
            forceinline=self.inline,
            error_model="numpy",
            fastmath={"contract", "reassoc"},
            nogil=True,
            no_cfunc_wrapper=True,
            _nrt=self.counted,
            **wrappers,
        )(self.function)
        folder = cache_folder(Path(self.function.__code__.co_filename), ROOT) / version
        made._cache = Kept(self.function, folder, self.inline or not version, _not_kept)
        return made


def _without_values(args, kws):
    """Types of arguments, those of constants without their values: one version of a kernel serves all"""
    from numba.core.types import Literal

    def plain(kind):
        return kind.literal_type if isinstance(kind, Literal) else kind

    return tuple(map(plain, args)), {name: plain(kind) for name, kind in kws.items()}


def _not_kept(error):
    _tell_not_kept(_base(), error.strerror)


@cache
def _tell_not_kept(base, reason):
    """On stderr, once per process: a warning would become a finding of the running study"""
    print(
        f"hakobune: compiled kernels cannot be stored in {base} ({reason}), so every command that needs them compiles "
        "them again, for up to two minutes; set HAKOBUNE_CACHE to a writable folder",
        file=sys.stderr,
    )
