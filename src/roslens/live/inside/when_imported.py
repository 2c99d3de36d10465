"""Calls a function as soon as a module has been imported, without importing it."""

from __future__ import annotations

import contextlib
import importlib.abc
import importlib.machinery
import sys
from collections.abc import Callable, Sequence
from types import ModuleType


def when_imported(name: str, call: Callable[[ModuleType], None]) -> None:
    """Call ``call`` with the module ``name`` after its import, or now if it is there. Its errors are swallowed."""
    if name in sys.modules:
        _try(call, sys.modules[name])
    else:
        sys.meta_path.insert(0, _Finder(name, call))


def _try(call: Callable[[ModuleType], None], module: ModuleType) -> None:
    with contextlib.suppress(Exception):  # a node must run whatever becomes of its observer
        call(module)


class _Finder(importlib.abc.MetaPathFinder):
    """Finds the one module as if it were not there, and steps aside."""

    def __init__(self, name: str, call: Callable[[ModuleType], None]) -> None:
        self._name = name
        self._call = call

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        """Return the specification of the module with a loader that calls; None for every other module."""
        if fullname != self._name:
            return None
        if self in sys.meta_path:
            sys.meta_path.remove(self)
        for finder in sys.meta_path:
            find = getattr(finder, "find_spec", None)
            spec = find(fullname, path, target) if find is not None else None
            if spec is not None:
                if spec.loader is not None and hasattr(spec.loader, "exec_module"):
                    spec.loader = _Loader(spec.loader, self._call)
                return spec  # type: ignore[no-any-return]  # finders are not typed
        return None


class _Loader(importlib.abc.Loader):
    """Loads as the module's own loader does, puts that one back in its place, and calls."""

    def __init__(self, loader: importlib.abc.Loader, call: Callable[[ModuleType], None]) -> None:
        self._loader = loader
        self._call = call

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType | None:
        """Let the module's own loader make it."""
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        """Execute the module, then call."""
        if module.__spec__ is not None:
            module.__spec__.loader = self._loader
        module.__loader__ = self._loader
        self._loader.exec_module(module)
        _try(self._call, module)
