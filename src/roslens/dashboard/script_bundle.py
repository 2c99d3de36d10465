"""The modules of ``web/`` as one classic script, because browsers refuse modules to a page on disk.

Each module becomes a function that is called once and gives what it exports, so names of two modules never meet. The
modules keep to a few forms (named imports and exports of declarations), and anything else is refused rather than
guessed.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable, Iterable

ENTRIES = ("main.js", "package_graph.js", "computation_graph.js")
"""What pages that may show anything load: the script of every page, and those of pages with a graph."""

ReadModule = Callable[[str], str]
"""Gives the text of a module by its path below ``web/``."""

_IMPORT = re.compile(r'^import \{([^}]*)\} from "(\.[^"]+)";[ \t]*$', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function\*?|class|const|let) (\w+))", re.MULTILINE)
_LEFT_OVER = re.compile(r"^(?:import|export)\b.*$|\bimport\(.*$", re.MULTILINE)


def bundle(entries: Iterable[str], read: ReadModule) -> str:
    """Return one script that does what these modules do, one after the other, and all that they import.

    Raises:
        ValueError: a module imports or exports in a way that is not understood, or modules import each other.
    """
    order: list[str] = []
    for entry in entries:
        _collect(entry, read, order, ())
    parts = ['(function () {\n"use strict";\nconst modules = {};\n']
    parts += [_wrapped(path, read(path)) for path in order]
    parts.append("})();\n")
    return "".join(parts)


def _collect(path: str, read: ReadModule, order: list[str], open_modules: tuple[str, ...]) -> None:
    if path in order:
        return
    if path in open_modules:
        raise ValueError(f"{path!r} imports itself by way of {' and '.join(open_modules)}")
    for match in _IMPORT.finditer(read(path)):
        _collect(_resolve(path, match[2]), read, order, (*open_modules, path))
    order.append(path)


def _resolve(importer: str, target: str) -> str:
    return posixpath.normpath(posixpath.join(posixpath.dirname(importer), target))


def _wrapped(path: str, text: str) -> str:
    exported = [match[1] for match in _EXPORT.finditer(text)]
    body = _EXPORT.sub("", _IMPORT.sub(lambda match: _taken(path, match), text))
    left = _LEFT_OVER.search(body)
    if left:
        raise ValueError(f"{path!r} has {left[0]!r}; expected named imports and exports of declarations, one a line")
    return f'modules["{path}"] = (function () {{\n{body}\nreturn {{ {", ".join(exported)} }};\n}})();\n'


def _taken(path: str, match: re.Match[str]) -> str:
    names = ", ".join(name.strip().replace(" as ", ": ") for name in match[1].split(",") if name.strip())
    return f'const {{ {names} }} = modules["{_resolve(path, match[2])}"];'


def inline(script: str) -> str:
    """Return the script so that it may stand inside a ``script`` element: nothing in it can end the element."""
    return re.sub(r"<(?=/script|!--)", r"\\x3c", script, flags=re.IGNORECASE)
