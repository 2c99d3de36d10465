"""What a file is written in, by its name and, where the name leaves it open, by its content.

A header ``.h`` is C++, unless it lies in a package whose sources are all C (:func:`header_language`): in a mixed
package it has to be readable as C++ anyway, and a package of headers only is C++ far more often.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import msgspec

from roslens.model.source import Language, Role
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.roles import role_by_content, role_by_path


class Classified(msgspec.Struct, frozen=True):
    """What a file is written in and what it is to its package."""

    language: Language
    role: Role


def classify(path: str, content: bytes, settings: WorkspaceSettings) -> Classified:
    """Return language and role of a file; ``path`` is below the workspace root."""
    language = language_by_name(path)
    if language is None:
        language = language_by_content(path, content)
    role = role_by_path(path, settings)
    if role is None:
        role = role_by_content(content)
    return Classified(language, role)


def language_by_name(path: str) -> Language | None:
    """Return the language that a path determines; nothing if the content decides."""
    folder, _, name = path.rpartition("/")
    stem, dot, suffix = name.rpartition(".")
    if name in _BY_NAME:
        return _BY_NAME[name]
    if not dot or not stem:
        return None
    language = _BY_SUFFIX.get(suffix) or _BY_SUFFIX.get(suffix.lower(), Language.OTHER)
    if language in _LAUNCH_OF and suffix not in _XML_ONLY:
        return _launch_by_name(language, folder, stem)
    return None if suffix in _OPEN else language


def language_by_content(path: str, content: bytes) -> Language:
    """Return the language of a file whose name leaves it open."""
    name = path.rpartition("/")[2]
    suffix = name.rpartition(".")[2].lower() if "." in name else ""
    if suffix in ("py", "pyw", "pyi"):
        return Language.LAUNCH_PYTHON if _LAUNCH_DESCRIPTION.search(content) else Language.PYTHON
    if suffix in ("yaml", "yml"):
        return Language.LAUNCH_YAML if _LAUNCH_KEY.search(content) else Language.YAML
    if suffix in ("xml", "test"):
        return _xml(content, suffix)
    line = content[:200].partition(b"\n")[0]
    if line.startswith(b"#!") and b"python" in line:
        return Language.PYTHON
    return Language.CPP if b"-*- c++ -*-" in line.lower() else Language.OTHER


def header_language(paths: Iterable[str]) -> Language:
    """Return the language of the ``.h`` headers of a package with these files: C where all its sources are C."""
    found = {language_by_name(path) for path in paths if not path.endswith(".h")}
    return Language.C if Language.C in found and Language.CPP not in found else Language.CPP


_BY_NAME = {
    "package.xml": Language.MANIFEST,
    "CMakeLists.txt": Language.CMAKE,
    "setup.cfg": Language.OTHER,
    **dict.fromkeys(("Dockerfile", "Doxyfile", "LICENSE", "Makefile", "README"), Language.OTHER),
}

_BY_SUFFIX = {
    "c": Language.C,
    **dict.fromkeys(
        ("cpp", "cc", "cxx", "c++", "cp", "C", "h", "hpp", "hh", "hxx", "h++", "H", "ipp", "inl", "tpp", "txx", "tcc"),
        Language.CPP,
    ),
    **dict.fromkeys(("cppm", "ixx", "ino", "cu", "cuh"), Language.CPP),
    **dict.fromkeys(("py", "pyw", "pyi"), Language.PYTHON),
    "cmake": Language.CMAKE,
    "launch": Language.LAUNCH_XML,
    "msg": Language.MSG,
    "srv": Language.SRV,
    "action": Language.ACTION,
    "yaml": Language.YAML,
    "yml": Language.YAML,
    "xml": Language.XML,
    "sdf": Language.XML,
    "world": Language.XML,
    "xsd": Language.XML,
    "ui": Language.XML,
    "urdf": Language.URDF,
    "xacro": Language.XACRO,
}

_XML_ONLY = frozenset(("sdf", "world", "xsd", "ui"))

_OPEN = frozenset(("test", "cfg"))
"""Suffixes of rostest files and of dynamic_reconfigure's Python scripts, but of other things too."""

_LAUNCH_OF = {
    Language.PYTHON: Language.LAUNCH_PYTHON,
    Language.YAML: Language.LAUNCH_YAML,
    Language.XML: Language.LAUNCH_XML,
}

_LAUNCH_DESCRIPTION = re.compile(rb"^(?:async\s+)?def\s+generate_(?:launch|test)_description\b", re.MULTILINE)
_LAUNCH_KEY = re.compile(rb"^(?:launch|'launch'|\"launch\")[ \t]*:", re.MULTILINE)


def _launch_by_name(language: Language, folder: str, stem: str) -> Language | None:
    """Recognise launch files among others of the same suffix; nothing if the name is only a hint."""
    if stem.endswith(".launch"):
        return _LAUNCH_OF[language]
    if language is Language.XML:
        return None
    hinted = stem == "launch" or stem.endswith("_launch") or "launch" in folder.split("/")
    return None if hinted else language


def _xml(content: bytes, suffix: str) -> Language:
    root, tag = _root_element(content)
    if root == b"launch":
        return Language.LAUNCH_XML
    if root == b"robot":
        return Language.XACRO if b"xacro" in tag else Language.URDF
    return Language.OTHER if suffix == "test" and not root else Language.XML


_NAME = re.compile(rb"<([A-Za-z_][\w:.-]*)")

_SKIPPED = ((b"<?", b"?>"), (b"<!--", b"-->"), (b"<!", b">"))


def _root_element(content: bytes) -> tuple[bytes, bytes]:
    """Return the name of the root element and its whole start tag; empty where there is none."""
    at = 3 if content.startswith(b"\xef\xbb\xbf") else 0
    while (at := content.find(b"<", at)) >= 0:
        for opening, closing in _SKIPPED:
            if content.startswith(opening, at):
                end = content.find(closing, at)
                if end < 0:
                    return b"", b""
                at = end + len(closing)
                break
        else:
            match = _NAME.match(content, at)
            return (match.group(1), content[at : content.find(b">", at) + 1]) if match else (b"", b"")
    return b"", b""
