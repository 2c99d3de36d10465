"""Modules of plug-ins that a workspace brings, loaded by compiling the bytes that were hashed.

What is trusted is a text. Python would run another: the byte code in ``__pycache__`` beside it, or a module of the
workspace outside the plug-in. So below the workspace nothing is imported but the files of plug-ins, each compiled from
bytes whose hash is that which was taken before; byte code of the workspace is never looked at.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader, ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import spec_from_file_location
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

from roslens.children.guard.sitecustomize import GuardedFinder
from roslens.model.errors import PluginError


def hashes_of(path: Path) -> dict[str, str]:
    """Return the hashes of the files of a plug-in, by their real paths; none of byte code."""
    return {os.path.realpath(file): _hash(file) for file in files_of(path)}


def files_of(path: Path) -> Iterator[Path]:
    """Yield the files that are meant by a file or a folder, but for byte code."""
    found = sorted(path.rglob("*")) if path.is_dir() else [path]
    return (file for file in found if "__pycache__" not in file.parts and file.is_file())


def _hash(file: Path) -> str:
    try:
        return sha256(file.read_bytes()).hexdigest()
    except OSError:
        return "unreadable"


class _HashedSource(SourceFileLoader):
    """Loads a module from its source, never from byte code."""

    def __init__(self, fullname: str, path: str, expected: str) -> None:
        super().__init__(fullname, path)
        self._expected = expected

    def get_code(self, fullname: str) -> CodeType:
        """Return the compiled source, whose hash must be that which was taken."""
        path = self.get_filename(fullname)
        return self.source_to_code(_verified(path, self._expected), path)


class _HashedExtension(ExtensionFileLoader):
    """Loads a native module whose hash is that which was taken."""

    def __init__(self, fullname: str, path: str, expected: str) -> None:
        super().__init__(fullname, path)
        self._expected = expected

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Return the module."""
        _verified(self.path, self._expected)
        return super().create_module(spec)


def _verified(path: str, expected: str) -> bytes:
    content = Path(path).read_bytes()
    if sha256(content).hexdigest() != expected:
        raise PluginError(f"{path} changed since it was looked at", expected="the content that is trusted")
    return content


class HashedModules(GuardedFinder):
    """Finds modules as Python does, but below workspaces only those of plug-ins that were hashed."""

    def __init__(self) -> None:
        """Know no workspace yet."""
        searched = {os.path.realpath(place) for place in sys.path if os.path.isabs(place)}  # noqa: PTH117 - of an entry
        super().__init__(os.devnull, sorted(searched - {os.path.realpath(".")}))
        self._roots: tuple[str, ...] = ()
        self.hashes: dict[str, str] = {}

    def add(self, root: str, hashes: Mapping[str, str]) -> None:
        """Guard a workspace, in which the files of ``hashes`` may be loaded."""
        self._roots = tuple(dict.fromkeys((*self._roots, os.path.realpath(root).rstrip(os.sep) + os.sep)))
        self._searched = tuple(place for place in self._searched if place not in self._roots)
        self.hashes.update(hashes)
        self.invalidate_caches()

    def find_spec(self, fullname: str, path: Sequence[str] | None = None, target: Any = None) -> ModuleSpec | None:
        """Return where a module is.

        Raises:
            ModuleNotFoundError: it is nowhere but in the workspace, outside of what was hashed.
        """
        allowed = []
        outside = ""
        for place in sys.path if path is None else path:
            if self._is_allowed(place):
                allowed.append(place)
                found = PathFinder.find_spec(fullname, [place], target)
                if found is not None and found.loader is not None:
                    return found
                continue
            if file := self._hashed(fullname, place):
                return self.spec_of(fullname, file)
            outside = outside or next(filter(os.path.isfile, _candidates(fullname, place)), "")
        found = PathFinder.find_spec(fullname, allowed, target)
        if found is None and outside:
            raise ModuleNotFoundError(
                f"{outside} is not part of a trusted plug-in: move it into the plug-in's folder", name=fullname
            )
        return found

    def _hashed(self, fullname: str, place: str) -> str:
        """Return the file of a module in a folder if it was hashed; empty if not."""
        return next((file for file in _candidates(fullname, place) if os.path.realpath(file) in self.hashes), "")

    def spec_of(self, fullname: str, file: str) -> ModuleSpec:
        """Return how a file that was hashed is loaded as a module; as a package if it is called ``__init__``.

        Raises:
            PluginError: it was not hashed.
        """
        expected = self.hashes.get(os.path.realpath(file))
        if expected is None:
            raise PluginError(f"{file} is no file of the plug-in", expected="a file that was hashed")
        kind = _HashedExtension if file.endswith(tuple(EXTENSION_SUFFIXES)) else _HashedSource
        folder = [os.path.dirname(file)] if os.path.basename(file).startswith("__init__.") else None  # noqa: PTH119, PTH120
        found = spec_from_file_location(
            fullname, file, loader=kind(fullname, file, expected), submodule_search_locations=folder
        )
        assert found is not None  # noqa: S101 - a loader is given
        return found

    def _is_allowed(self, place: object) -> bool:
        if not isinstance(place, str):
            return False
        known = self._known.get(place)
        if known is None or not os.path.isabs(place):  # noqa: PTH117
            real = os.path.realpath(place or ".") + os.sep
            known = not real.startswith(self._roots) or real.startswith(self._searched)
            self._known[place] = known
        return known


def _candidates(fullname: str, place: str) -> Iterator[str]:
    base = os.path.join(place, fullname.rpartition(".")[2])  # noqa: PTH118 - an entry may be no path
    yield os.path.join(base, "__init__.py")  # noqa: PTH118
    yield from (base + suffix for suffix in EXTENSION_SUFFIXES)
    yield base + ".py"


_installed: list[HashedModules] = []


def hashed_modules() -> HashedModules:
    """Return the finder of this process, which takes the place of Python's own."""
    if not _installed:
        made = HashedModules()
        finder: Any = made
        sys.meta_path[:] = [finder if one is PathFinder else one for one in sys.meta_path]
        _installed.append(made)
    return _installed[0]
