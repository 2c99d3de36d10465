"""Modules of the workspace that a launch file in Python imports: by ``sys.path``, and those of packages."""

from __future__ import annotations

import ast
import re
import sys
import warnings
from collections.abc import Callable
from typing import Any, Protocol

import msgspec

from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.launch_python.python_value import Dotted, Unknown

MOST_MODULES = 20
_KNOWN = frozenset(
    {"launch", "launch_ros", "launch_xml", "launch_yaml", "launch_param_builder", "launch_testing", "nav2_common",
     "moveit_configs_utils", "ament_index_python", "rclpy", "xacro", "yaml"}
)  # fmt: skip
"""Modules of which the vocabulary knows what they have."""
_PACKAGE = re.compile(
    rb"(?:get_package_share_(?:directory|path)|FindPackageShare)\(\s*(?:package\s*=\s*)?['\"](\w+)['\"]"
)


class Module(msgspec.Struct, eq=False):
    """A module of the workspace, with what it defines."""

    path: str
    names: dict[str, Any]


class ClassOfFile(msgspec.Struct, eq=False):
    """A class of a launch file or of a module.

    Attributes:
        name: of it.
        path: of the file that it is in.
        names: what is assigned in its body and in those of its bases.
        plain: whether nothing but classes of the workspace says what that means.
    """

    name: str
    path: str
    names: dict[str, Any]
    plain: bool

    @property
    def unknown(self) -> Unknown:
        """An object of the class, or what it inherits: it is not evaluated."""
        return Unknown(f"class {self.name} of {self.path}")


class Modules:
    """The modules that one launch file imports, directly or not.

    Attributes:
        files: of the workspace.
    """

    def __init__(
        self, files: Files | None = None, read: Callable[[str, ast.Module, Modules], dict[str, Any]] | None = None
    ) -> None:
        """Begin without any.

        Args:
            files: of the workspace; None finds nothing.
            read: evaluates a module and returns what it defines.
        """
        self.files = files
        self._read = read
        self._loaded: dict[str, Module | None] = {}

    def module(self, name: str, path: str) -> Module | None:
        """Return the module that a file means by a name; None where it is none of the workspace."""
        first = name.partition(".")[0]
        if self.files is None or not first or first in _KNOWN or first in sys.stdlib_module_names:
            return None
        for folder in self._folders(first, path, self.files):
            found = self._load(f"{joined(folder, name.replace('.', '/'))}.py", self.files)
            if found is not None:
                return found
        return None

    def _folders(self, first: str, path: str, files: Files) -> list[str]:
        content = files.content(path) or b""
        found = []
        if b"sys.path" in content:
            found.append(path.rpartition("/")[0])
            for one in dict.fromkeys(_PACKAGE.findall(content)):
                folder = files.package(one.decode())
                found += [] if folder is None else [joined(folder, "launch"), folder]
        package = files.package(first)
        return found if package is None else [*found, package]

    def _load(self, path: str, files: Files) -> Module | None:
        if path in self._loaded or len(self._loaded) >= MOST_MODULES:
            return self._loaded.get(path)
        content = files.content(path)
        if content is None:
            return None
        self._loaded[path] = None
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                tree = ast.parse(content)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return None
        self._loaded[path] = Module(path, self._read(path, tree, self) if self._read else {})
        return self._loaded[path]


class Importing(Protocol):
    """What evaluates a launch file, as imports see it."""

    path: str
    modules: Modules

    def keep(self, name: str, value: Any) -> None:
        """Keep a value under a name."""


def bring(interpreter: Importing, statement: ast.Import) -> None:
    """Take modules by name."""
    for alias in statement.names:
        name = alias.name if alias.asname else alias.name.partition(".")[0]
        found = interpreter.modules.module(name, interpreter.path)
        interpreter.keep(alias.asname or name, Dotted(name) if found is None else found)


def bring_from(interpreter: Importing, statement: ast.ImportFrom) -> None:
    """Take names of modules."""
    name = statement.module or ""
    found = interpreter.modules.module(name, interpreter.path) if not statement.level else None
    for alias in statement.names:
        if found is not None and alias.name == "*":
            for one, value in found.names.items():
                interpreter.keep(one, value)
            continue
        inside = None if found is None else found.names.get(alias.name)
        whole = f"{name}.{alias.name}".strip(".")
        deeper = interpreter.modules.module(whole, interpreter.path) if inside is None and not statement.level else None
        interpreter.keep(alias.asname or alias.name, deeper or (Dotted(whole) if inside is None else inside))


def member(of: Module | ClassOfFile, name: str) -> Any:
    """Return what a module or class has under a name."""
    if name in of.names:
        return of.names[name]
    return of.unknown if isinstance(of, ClassOfFile) else Unknown(f"{name} of {of.path}")
