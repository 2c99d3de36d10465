"""A plug-in that was found, and how any process gets hold of it."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from enum import Enum
from hashlib import blake2b
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

import msgspec

from roslens.model.errors import PluginError
from roslens.plugins.hashed_modules import hashed_modules
from roslens.plugins.points import Manifest


class Source(str, Enum):
    """Where a plug-in is loaded from."""

    MODULE = "module"
    FILE = "file"
    HAROS = "haros"


class LoadSpec(msgspec.Struct, frozen=True, omit_defaults=True):
    """How a plug-in is loaded: ``module:attribute`` for a module, ``path`` for a file or folder.

    Of one with a path that a workspace names, ``hashes`` are those of its files by their real paths, and ``guarded`` is
    the folder in which nothing else is imported.
    """

    source: Source
    module: str = ""
    attribute: str = ""
    path: str = ""
    hashes: dict[str, str] = {}
    guarded: str = ""


class Member(msgspec.Struct, frozen=True):
    """A plug-in that may run.

    Attributes:
        manifest: what it declares.
        origin: where it comes from, for readers.
        spec: how to load it, in this process or another.
        hooks: names of the hooks it has.
        fingerprint: changes when its files change; part of the key of cached results.
        builtin: whether it comes with roslens.
    """

    manifest: Manifest
    origin: str
    spec: LoadSpec
    hooks: tuple[str, ...]
    fingerprint: str = ""
    builtin: bool = False

    @property
    def name(self) -> str:
        """The name of the manifest."""
        return self.manifest.name


def load_plugin(spec: LoadSpec) -> object:
    """Import a plug-in and return the object that has its manifest and hooks.

    A module without ``manifest`` may offer the object as ``plugin``.

    Raises:
        PluginError: there is no such module, attribute or file.
        BaseException: whatever the plug-in raises while it is imported.
    """
    if spec.source is Source.MODULE:
        module = importlib.import_module(spec.module)
    else:
        if spec.guarded:
            hashed_modules().add(spec.guarded, spec.hashes)
        with _no_bytecode():
            if spec.source is Source.HAROS:
                from roslens.plugins.haros.plugin import load_haros_plugin

                return load_haros_plugin(Path(spec.path))
            module = _import_path(Path(spec.path), guarded=bool(spec.guarded))
    if not spec.attribute:
        return module if hasattr(module, "manifest") else getattr(module, "plugin", module)
    found: object = module
    for name in spec.attribute.split("."):
        if not hasattr(found, name):
            raise PluginError(
                f"no {spec.attribute!r} in module {spec.module!r}",
                expected="the plug-in object that the entry point names",
            )
        found = getattr(found, name)
    return found


@contextmanager
def _no_bytecode() -> Iterator[None]:
    """Leave no ``__pycache__`` in a folder of the user's."""
    before, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        yield
    finally:
        sys.dont_write_bytecode = before


def _import_path(path: Path, *, guarded: bool) -> ModuleType:
    """Import a file, or a folder with ``__init__.py``, under a name of its own; ``guarded`` from hashed bytes only."""
    target = path / "__init__.py" if path.is_dir() else path
    name = f"roslens_plugin_{blake2b(str(path).encode('utf-8', 'surrogateescape'), digest_size=6).hexdigest()}"
    if name in sys.modules:
        return sys.modules[name]
    found: ModuleSpec | None
    if guarded:
        found = hashed_modules().spec_of(name, str(target))
    else:
        places = [str(path)] if path.is_dir() else None
        found = importlib.util.spec_from_file_location(name, target, submodule_search_locations=places)
    if found is None or found.loader is None:
        raise PluginError(f"{path.name!r} is not a Python file", expected="a file that ends in .py or a package folder")
    module = importlib.util.module_from_spec(found)
    sys.modules[name] = module
    try:
        found.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def fingerprint_of(spec: LoadSpec) -> str:
    """Return a hash of the files a loaded plug-in is made of: its top-level package, or its file."""
    home = Path(spec.path) if spec.source is not Source.MODULE else _home_of(spec.module)
    digest = blake2b(digest_size=8)
    for file in _files_of(home):
        digest.update(file.name.encode("utf-8", "surrogateescape"))
        digest.update(file.read_bytes())
    return digest.hexdigest()


def _home_of(module: str) -> Path:
    for name in (module.partition(".")[0], module):
        if file := getattr(sys.modules.get(name), "__file__", None):
            path = Path(file)
            return path.parent if path.name == "__init__.py" else path
    return Path()


def _files_of(home: Path) -> Iterator[Path]:
    if home.is_file():
        yield home
    elif home.parts:
        for file in sorted(home.rglob("*")):
            if "__pycache__" not in file.parts and file.is_file():
                yield file
