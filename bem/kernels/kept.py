"""Storage of kernels that numba has compiled on disk, and calls between kernels.

Numba links the code of a kernel into all callers, where the code is optimised and assembled again. A kernel six calls
deep is thus compiled six times.  Here a kernel of more than a few instructions is compiled once.  Callers use only the
symbol of the kernel, and the file of a caller lists the kernels that must be loaded first.  Processes share the work:
a process waits for a kernel that another process is compiling (`claimed`).
Processes do not wait for each other in a circle, because kernels wait only for their callees.
Only this module uses private parts of numba. `CompileResult._reduce` and `_rebuild` make the pickled form of a kernel;
callers link `CodeLibrary._shared_module`; numba calls `_reload_init` before it loads a kernel.
"""

import hashlib
import pickle
import sys
import time
from contextlib import suppress
from importlib import import_module
from itertools import islice

import numba
from llvmlite import binding
from numba.core.compiler import CompileResult
from numba.core.runtime import rtsys
from numba.core.serialize import dumps
from numba.core.types import Array

from .sources import put_file

SMALL = 100  # instructions: kernels up to this size, which the compiler may inline, are linked
PATIENCE = 60.0  # s, time given to another process for a kernel: the longest and its callees take 12 alone


class _StaleError(Exception):
    """A kernel calls one that has been recompiled since"""


class Callee:
    """Load a kernel before another kernel, whose file lists it as a callee"""

    def __init__(self, function, signature, symbol):
        self.module, self.name = function.__module__, function.__qualname__
        self.signature, self.symbol = signature, symbol

    def __call__(self):
        kernel = getattr(import_module(self.module), self.name).called
        kernel.compile(self.signature)
        if kernel.overloads[tuple(self.signature)].fndesc.llvm_func_name != self.symbol:
            raise _StaleError(self.symbol)


class Kept:
    """Replacement of the cache in numba's dispatcher, with a file for each signature of a kernel.

    folder : Path; failed : function called with an OSError if the folder is not writable
    linked : whether the kernel is linked into its callers, however long it is, or has no callers
    """

    def __init__(self, function, folder, linked, failed):
        self.function, self.folder, self.linked, self.failed = function, folder, linked, failed
        self.cache_path, self.worthless, self.claims = str(folder), set(), {}

    def load_overload(self, signature, context):
        """The kernel with this signature, or None for a kernel that this process has to compile"""
        rtsys.initialize(context)  # runtime called by machine code for arrays
        file = self._file(signature, context)
        result = self._loaded(file, signature, context)
        if result is None and file not in self.claims:
            self.claims[file] = claimed(file)
            result = self._loaded(file, signature, context)  # compiled by another process meanwhile
            if result is not None:
                self._leave(file)
        return result

    def _leave(self, file):
        """Let other processes have a kernel"""
        lock = self.claims.pop(file, None)
        if lock is not None:
            with suppress(OSError):
                file.with_suffix(".lock").unlink()
            lock.close()

    def _loaded(self, file, signature, context):
        try:
            apart, data = pickle.loads(file.read_bytes())
            result = CompileResult._rebuild(context, *data)
        except OSError:
            return None
        except (EOFError, pickle.UnpicklingError, _StaleError):
            self.worthless.add(file)
            return None
        self._called_by(signature, result, apart)
        return result

    def save_overload(self, signature, result):
        """Let other kernels call a newly compiled kernel by its symbol, and store the kernel unless another process has
        stored it"""
        file = self._file(signature, result.target_context)
        try:
            self._save(file, signature, result)
        except OSError as error:
            self.failed(error)
        finally:
            self._leave(file)

    def _save(self, file, signature, result):
        kind = result.signature.return_type
        if not result.target_context.enable_nrt and any(
            isinstance(one, Array) for one in getattr(kind, "types", [kind])
        ):
            raise TypeError(f"kernel {self.function.__qualname__} returns an array; allowed only with counted=True")
        apart = not (self.linked or _is_inner_loop(signature)) and _is_long(result)
        self._called_by(signature, result, apart)
        if not file.exists() or file in self.worthless:
            put_file(file, dumps((apart, result._reduce())))

    def _called_by(self, signature, result, apart):
        """What others link, and load before it: nothing and the kernel, or itself and what it calls"""
        library = result.library
        if not apart:
            library._reload_init.update(result.reload_init)
            return
        empty = library._codegen._create_empty_module(library.name)
        library._shared_module = binding.parse_assembly(str(empty))
        library._reload_init = {Callee(self.function, signature, result.fndesc.llvm_func_name)}

    def _file(self, signature, context):
        kinds = [kind.name for kind in signature]
        machine = f"{kinds} {context.codegen().magic_tuple()} {sys.version_info[:2]} {numba.__version__}"
        name, digest = self.function.__qualname__, hashlib.sha256(f"{self.function.__module__} {machine}".encode())
        return self.folder / f"{name}-{digest.hexdigest()[:16]}.kernel"


def claimed(file):
    """The open lock of a kernel that this process is to compile; a process that compiles the kernel now is waited for

    None if files cannot be locked, or if another process takes longer than PATIENCE; then both processes compile the
    kernel.  When a process ends, for any reason, its lock becomes free.
    """
    try:
        from fcntl import LOCK_EX, LOCK_NB, flock

        file.parent.mkdir(parents=True, exist_ok=True)
        lock = open(file.with_suffix(".lock"), "w")  # noqa: SIM115 - closed by whoever holds it
    except (ImportError, OSError):
        return None
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            flock(lock, LOCK_EX | LOCK_NB)
            return lock
        except BlockingIOError:
            time.sleep(0.005)
        except OSError:
            break
    lock.close()
    return None


def _is_inner_loop(signature):
    """Whether a kernel takes pointers or vectors (`simd`): called for every few numbers, it is faster when linked"""
    return any("*" in kind.name or "SimdVector" in kind.name for kind in signature)


def _is_long(result):
    function = result.library.get_function(result.fndesc.llvm_func_name)
    instructions = (one for block in function.blocks for one in block.instructions)
    return next(islice(instructions, SMALL, None), None) is not None
