"""Modules with their kernels as plain Python: one of them can be called for itself without being compiled for it."""

import os
import sys
from importlib import import_module
from unittest import mock

from numba import config

_modules = {}


def plain(name):
    """A second copy of a module, by its name below `hakobune`, and of all that it imports, with kernels as functions"""
    compiled = {key: sys.modules.pop(key) for key in list(sys.modules) if key.split(".")[0] == "hakobune"}
    sys.modules.update(_modules)
    try:
        with mock.patch.dict(os.environ, NUMBA_DISABLE_JIT="1"), mock.patch.object(config, "DISABLE_JIT", 1):
            return import_module(f"hakobune.{name}")
    finally:
        for key in [key for key in sys.modules if key.split(".")[0] == "hakobune"]:
            _modules[key] = sys.modules.pop(key)
        sys.modules.update(compiled)
