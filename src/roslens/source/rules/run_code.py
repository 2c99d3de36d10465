"""Which code of a Python file runs when it is started: its top level, its ``main``, and what these name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.calls import body_of
from roslens.source.rules.file_view import FileView

_WORD = re.compile(rb"\w+")
_ALWAYS = (b"__init__", b"__new__", b"__enter__")
_MAIN = b"main"
"""A function that entry points name, and the file itself need not."""


def run_code(view: FileView) -> bytes:
    """Return the code of what runs, as far as names tell: a function or class that is named there runs as well."""
    waiting = list(_defined(view.root, view))
    first = [_own(view.root, view), *(_text(one, view) for name, one in waiting if name == _MAIN)]
    run = b"\n".join(first)
    grows = True
    while grows:
        words = {*_WORD.findall(run), *_ALWAYS}
        reached = [(name, one) for name, one in waiting if name in words]
        waiting = [pair for pair in waiting if pair not in reached]
        for _, one in reached:
            if one.type == "class_definition":
                waiting.extend(_defined(body_of(one), view))
        run = b"\n".join((run, *(_text(one, view) for _, one in reached)))
        grows = bool(reached)
    return run


def _defined(block: Node | None, view: FileView) -> Iterator[tuple[bytes, Node]]:
    """Yield the functions and classes that stand in a block, with their names; below conditions, too."""
    waiting = list(block.named_children) if block is not None else []
    while waiting:
        one = waiting.pop()
        if one.type in ("function_definition", "class_definition"):
            name = one.child_by_field_name("name")
            yield view.code[name.start_byte : name.end_byte] if name is not None else b"", one
        elif one.type != "decorated_definition" or (inner := one.child_by_field_name("definition")) is None:
            waiting.extend(one.named_children)
        else:
            waiting.append(inner)


def _text(definition: Node, view: FileView) -> bytes:
    """Return the code that a definition adds: of a class what stands outside of its methods, and its bases."""
    if definition.type == "function_definition":
        body = body_of(definition)
        return view.code[body.start_byte : body.end_byte] if body is not None else b""
    bases = definition.child_by_field_name("superclasses")
    listed = view.code[bases.start_byte : bases.end_byte] if bases is not None else b""
    return listed + b"\n" + _own(body_of(definition), view)


def _own(block: Node | None, view: FileView) -> bytes:
    """Return the code of a block without what its functions and classes hold, but for their decorators."""
    if block is None:
        return b""
    parts: list[bytes] = []
    at = block.start_byte
    for _, one in sorted(_defined(block, view), key=lambda pair: pair[1].start_byte):
        parts.append(view.code[at : one.start_byte])
        at = one.end_byte
    return b"\n".join((*parts, view.code[at : block.end_byte]))
