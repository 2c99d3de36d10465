"""What a lambda of C++ has copies of: ``[a, this]``, ``[=]``; the rest of what it names it sees as it is then."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.extract.lowering.cpp.cpp_types import declared_name
from roslens.source.syntax.cpp_names import text_of


def held_copies(captures: Node | None, source: bytes, body: Node) -> tuple[str, ...]:
    """Return the variables of which a lambda has copies; ``=`` is all but those that stand behind it.

    Nothing is said of one that may change its copies (``mutable``).

    Args:
        captures: what it says between brackets.
        source: of the file.
        body: of the lambda.
    """
    if captures is None or b"mutable" in source[captures.end_byte : body.start_byte]:
        return ()
    all_ = reference = False
    copied: list[str] = []
    referred: list[str] = []
    for node in captures.children:
        kind, text = node.type, source[node.start_byte : node.end_byte]
        if kind == "lambda_default_capture":
            all_ = text == b"="
        elif kind == "identifier":
            (referred if reference else copied).append(text_of(text))
        elif kind == "lambda_capture_initializer" and text[:1] != b"&":
            # The value is made where the lambda is, of what stands there.
            all_ = True
        elif kind == "lambda_capture_initializer":
            referred.append(declared_name(text[: text.find(b"=")]))
        reference = kind == "&"
    return ("=", *referred) if all_ else tuple(copied)
