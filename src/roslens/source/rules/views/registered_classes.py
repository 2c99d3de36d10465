"""Which classes the sources of a package register: plug-ins of pluginlib, and components."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from roslens.model.source import Language, Role
from roslens.source.rules.views.package_files import PackageFiles

_COMMENT = re.compile(rb"//[^\n]*|/\*.*?\*/", re.DOTALL)
_PLUGIN = re.compile(
    rb"\b(?:PLUGINLIB_EXPORT_CLASS|CLASS_LOADER_REGISTER_CLASS)\s*\(\s*([\w:<>, ]+?)\s*,\s*([\w:<>, ]+?)\s*,?\s*\)"
)
_DECLARED = re.compile(rb"\bPLUGINLIB_DECLARE_CLASS\s*\(\s*\w+\s*,\s*\w+\s*,\s*([\w:]+)\s*,\s*([\w:]+)\s*\)")
_COMPONENT = re.compile(rb"\bRCLCPP_COMPONENTS_REGISTER_NODE\s*\(\s*([\w:<>, ]+?)\s*\)")
_MACROS = (b"PLUGINLIB_", b"RCLCPP_COMPONENTS_REGISTER", b"CLASS_LOADER_REGISTER")
_HIDDEN = re.compile(rb"#\s*define\b[^\n]*(?:PLUGINLIB_EXPORT_CLASS|RCLCPP_COMPONENTS_REGISTER_NODE)")


class Registered(msgspec.Struct, frozen=True):
    """A class that a macro registers: ``base`` is empty for components."""

    name: str
    base: str
    path: str
    line: int


def registered_classes(package: PackageFiles) -> tuple[tuple[Registered, ...], bool]:
    """Return the classes, and whether these are all: a macro of the package's own may register more."""
    found: list[Registered] = []
    complete = True
    for file in package.of_language(Language.CPP, Language.C, roles=(Role.OWN, Role.TEST)):
        content = package.read(file.path)
        if not any(word in content for word in _MACROS):
            continue
        complete = complete and not _HIDDEN.search(content)
        # Comments are blanked, so that lines stay.
        text = _COMMENT.sub(lambda match: re.sub(rb"[^\n]", b" ", match[0]), content)
        found.extend(_of_file(text, file.path))
    return tuple(found), complete


def _of_file(text: bytes, path: str) -> Iterator[Registered]:
    for pattern in (_PLUGIN, _DECLARED, _COMPONENT):
        for match in pattern.finditer(text):
            name = _plain(match[1])
            base = _plain(match[2]) if pattern is not _COMPONENT else ""
            yield Registered(name, base, path, text.count(b"\n", 0, match.start()) + 1)


def _plain(written: bytes) -> str:
    return written.decode("utf-8", "replace").replace(" ", "").removeprefix("::")


def same_class(one: str, other: str) -> bool:
    """Return whether two names may mean one class: ``Driver`` within ``namespace arm`` is ``arm::Driver``."""
    one, other = one.removeprefix("::"), other.removeprefix("::")
    return one == other or one.endswith(f"::{other}") or other.endswith(f"::{one}")
