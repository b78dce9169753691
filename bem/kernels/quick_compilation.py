"""What spares numba a fifth of its time without a change of the machine code.

Shares of the processor time of a first `line-dynamics`, which compiles 127 kernels, stand at each function.  Private
parts of numba and llvmlite, used only here: `BaseFunction.get_call_type`, `CPUCodeLibrary._optimize_functions` with the
codegen that it asks, and the callbacks of llvmlite's lock.
"""

import gc
import os

# read when numba is loaded; where colorama is installed numba colours the words of every rule that does not apply: 8 %
os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")


def hasten():
    """Prepare numba before its first compilation in this process"""
    collect_nothing_meanwhile()
    remember_types()
    optimise_what_is_there()
    count_no_locks()


def collect_nothing_meanwhile():
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


def remember_types():
    """The type of x + y is asked thousands of times, and numba tries some twenty rules each time: 12 %"""
    from numba.core.types import Boolean, Literal, Number
    from numba.core.types.functions import BaseFunction

    asked, known = BaseFunction.get_call_type, {}

    def get_call_type(self, context, args, kws):
        if kws or not all(isinstance(one, (Number, Boolean, Literal)) for one in args):
            return asked(self, context, args, kws)
        if (self, context, args) not in known:
            known[self, context, args] = asked(self, context, args, kws)
        return known[self, context, args]

    BaseFunction.get_call_type = get_call_type


def optimise_what_is_there():
    """Numba prepares all passes of LLVM again for functions that are only declared, most of those of a module: 3 %"""
    from numba.core.codegen import CPUCodeLibrary

    def _optimize_functions(self, module):
        module.data_layout = self._codegen._data_layout
        for function in module.functions:
            if not function.is_declaration:
                passes, builder = self._codegen._function_pass_manager()
                passes.run(function, builder)

    CPUCodeLibrary._optimize_functions = _optimize_functions


def count_no_locks():
    """Numba times llvmlite's lock, twice at each of 60 000 calls, for every compilation that is under way: 8 %"""
    from llvmlite.binding import ffi

    ffi.lib._lock._cblist.clear()
