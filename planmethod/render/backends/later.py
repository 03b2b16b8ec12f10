"""What a library imports for what we never ask of it, imported when it is asked."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from importlib import import_module
from types import ModuleType
from typing import Any


class LateModule(ModuleType):
    """A module that is imported when something of it is asked for."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self._asked(name)

    def _asked(self, name: str) -> Any:
        return getattr(import_module(self.__name__), name)


class LateFunctions(LateModule):
    """A module of functions that is imported when one of them is called."""

    def _asked(self, name: str) -> Any:
        return lambda *args, **words: super(LateFunctions, self)._asked(name)(*args, **words)


def imported(name: str, later: Mapping[str, ModuleType]) -> Any:
    """Return a library that finds others in place of some modules, unless these are there."""
    new = {name: module for name, module in later.items() if name not in sys.modules}
    sys.modules.update(new)
    try:
        return import_module(name)
    finally:
        for module in new:
            del sys.modules[module]
