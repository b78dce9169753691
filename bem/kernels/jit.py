"""The one way to compile a kernel: numba with a cache that notices every change of what a kernel is made of.

numba stamps a cached function with its own file only: a callee edited in another file would go on returning its old
values, and so would a constant imported from there, which is frozen into the machine code.  The cache folder of a
kernel therefore carries a hash of the sources of its module and of all modules of this repository that it
imports directly or through others, in any folder.  Where that folder cannot be written kernels are compiled for the
process alone, and this is said: numba would keep them beside the sources, without the hash.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
import tempfile
from functools import cache, wraps
from pathlib import Path
from types import FunctionType

ROOT = Path(__file__).parents[2]
PACKAGE = "hakobune."  # below which the folders of `ROOT` are imported
# `from X import a, (b)` and `import X`; ast.parse would take 3 ms a file, at every start
_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+(\.*[\w.]*)[ \t]+import[ \t]+(\([^)]*\)|[^\n#]*)|import[ \t]+([^\n#]*))", re.M
)
_NAME = re.compile(r"(\w[\w.]*)(?:\s+as\s+\w+)?\s*(?:#[^\n]*)?(?:,|$)")

_before_first = []


def before_first_kernel(call):
    """Have something called once numba is loaded, before it compiles or loads the first kernel of this process"""
    _before_first.append(call)


@cache
def cache_folder(file, root):
    """Where the kernels of a source file are kept compiled; HAKOBUNE_CACHE or XDG_CACHE_HOME move it."""
    digest = hashlib.sha256()
    for source in sorted(sources(file, root)):
        digest.update(str(source.relative_to(root)).encode() + _bytes(source))
    return _base() / digest.hexdigest()[:16]


def _base():
    base = os.environ.get("HAKOBUNE_CACHE")
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "hakobune" if base is None else Path(base)


def sources(file, root=ROOT):
    """Source files below `root` that a source file imports, directly or through others, and itself: a set of Paths"""
    found, waiting = set(), [Path(file)]
    while waiting:
        source = waiting.pop()
        if source not in found:
            found.add(source)
            waiting += imported(source, root)
    return found


@cache
def imported(file, root=ROOT):
    """Source files below `root` that one imports directly, as a tuple of Paths"""
    out = []
    for origin, names, plain in _IMPORT.findall(_bytes(file).decode()):
        if plain:
            out += [_module(root, name) for name in _NAME.findall(plain)]
            continue
        name = origin.lstrip(".")
        dots = len(origin) - len(name)
        folder = file.parents[dots - 1] if dots else root
        out.append(_module(folder, name))
        # what is imported may itself be a module
        out += [_module(folder, f"{name}.{part}".lstrip(".")) for part in _NAME.findall(names.strip("()"))]
    return tuple(source for source in out if source is not None)


def _module(folder, name):
    """The file of a dotted name below a folder, or None if there is none"""
    place = folder.joinpath(*name.removeprefix(PACKAGE).split(".")) if name else folder
    for source in (place.with_suffix(".py"), place / "__init__.py"):
        if source.is_file():
            return source
    return None


@cache
def _bytes(source):
    return source.read_bytes()


def kernel(inline=False):
    """Decorator: compile to machine code on the first call and keep the result on disk.

    Kernels of `bem` write to arrays that they are given: an allocation takes a second to compile, for its error
    message.  They start no threads themselves (`bem.kernels.threads.parallel_rows` does).
    inline : always inlined into the kernels that call it; else as the compiler decides
    """

    return lambda function: _dispatcher(function, inline)


def _dispatcher(function, inline):
    """Numba's dispatcher of a function; numba, which takes 0.25 s to import, is loaded by the first one."""
    made = _compiling(function, inline, no_cfunc_wrapper=True)
    if isinstance(made, FunctionType):  # NUMBA_DISABLE_JIT
        return made
    # Kernels that call it get a version of its own without the code by which Python calls a kernel: that takes apart
    # all arrays and named tuples of the arguments, and took a third of the time to compile kernels that call many.
    called = cache(lambda: _compiling(function, inline, "called", no_cfunc_wrapper=True, no_cpython_wrapper=True))
    made.get_call_template = lambda args, kws: called().get_call_template(args, kws)
    made.get_overload = lambda signature: called().get_overload(signature)
    return made


def _compiling(function, inline, version="", **wrappers):
    """Numba's own decorator with the options of all kernels; a `version` is kept in a folder of its own"""
    import numba
    from numba.core import config

    while _before_first:
        _before_first.pop()()
    kept, before = _writable(_base()), config.CACHE_DIR
    config.CACHE_DIR = str(_folder_of(function) / version)
    try:
        # contract and reassoc only: NaN and infinity must stay visible
        made = numba.njit(
            cache=kept,
            forceinline=inline,
            error_model="numpy",
            fastmath={"contract", "reassoc"},
            nogil=True,
            **wrappers,
        )(function)
    finally:
        config.CACHE_DIR = before
    if kept and not config.DISABLE_JIT:
        _load_alone(made)
        _save_if_possible(made)
    return made


def _load_alone(dispatcher):
    """Load a kernel that is on disk without what numba needs to compile one: a tenth of a second a process"""
    from numba.core.runtime import rtsys

    kept = dispatcher._cache

    def loaded(signature, context):
        rtsys.initialize(context)  # what machine code of arrays calls
        return kept._load_overload(signature, context)

    kept.load_overload = loaded


@cache
def _writable(base):
    """Whether kernels can be kept below a folder; says if not"""
    try:
        base.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=base).close()
    except OSError as error:
        _tell_not_kept(base, error.strerror)
        return False
    return True


@cache
def _tell_not_kept(base, reason):
    """On stderr, once a process: a warning would become a finding of the study that is at work"""
    print(
        f"hakobune: compiled kernels cannot be kept in {base} ({reason}), so every command that needs them compiles "
        "them anew, for up to a minute or two; set HAKOBUNE_CACHE to a folder that can be written",
        file=sys.stderr,
    )


def _save_if_possible(dispatcher):
    """Let a kernel that is compiled be used where saving it fails, as on a full disk"""
    kept = dispatcher._cache
    save = kept.save_overload

    @wraps(save)
    def saved(*overload):
        try:
            save(*overload)
        except OSError as error:
            _tell_not_kept(_base(), error.strerror)

    kept.save_overload = saved


def _folder_of(function):
    return cache_folder(Path(function.__code__.co_filename), ROOT)
