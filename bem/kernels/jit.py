"""Compilation of kernels by numba, each kernel once, with a cache that detects changes of the sources of a kernel.

numba checks only the file of a cached function for changes. After an edit of another file, the old code of a callee, or
the old value of an imported constant, would remain in the machine code.  The folder name of a kernel therefore contains
a digest of the sources of its module and of all modules of this repository that this module imports directly or through
other modules (`sources`).  `kept` describes how kernels are stored and called by other kernels.  Without write access
kernels are compiled for one process only, and a message reports this.
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
    """Register a function to be called after numba is loaded, before numba compiles or loads the first kernel of this
    process"""
    _before_first.append(call)


def cache_folder(file, root):
    """Folder of the compiled kernels of a source file; HAKOBUNE_CACHE or XDG_CACHE_HOME change its place."""
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
    """Context in which kernels called from Python run as Python: a few calls are then quicker than the import of numba

    If Python raises an error of arithmetic, such as a division by zero, the compiled kernel is called.
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

    Kernels of `bem` write to given arrays, because an allocation or a direct array assignment takes a second to
    compile, due to its error message.  Kernels start no threads; `bem.kernels.threads.parallel_rows` starts them.
    inline : whether the kernel is always inlined into its callers; if False, the compiler decides
    counted : whether references to arrays are counted, which is necessary if the kernel makes or returns an array.
        For two bodies moored to each other, counting took two thirds of the time where loops make slices of arrays
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
        """The numba dispatcher of this kernel, for other kernels that call this kernel"""
        return self._called or self._made("_called", self._for_kernels)

    def compile_for(self, *arguments):
        """Compile this kernel for the types of the given arguments, without a call"""
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
