"""Source as coloured pieces: comments, texts, numbers, words of the language, what is defined."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pygments.lexer import Lexer
    from pygments.token import _TokenType

Piece = tuple[str, str]
"""Class of a piece of source (empty for none) and its text, not yet escaped.

``c`` is a comment, ``s`` a text, ``m`` a number, ``k`` a keyword, ``t`` a type or what the language brings along,
``f`` a name that is defined here, ``p`` what is not of the language itself: a line of the preprocessor, a decorator.
"""

_LEXERS = {
    "c": "c",
    "cpp": "cpp",
    "python": "python",
    "launch_python": "python",
    "cmake": "cmake",
    "manifest": "xml",
    "launch_xml": "xml",
    "launch_yaml": "yaml",
    "yaml": "yaml",
    "xml": "xml",
    "urdf": "xml",
    "xacro": "xml",
}
_CLASSES = (
    ("Comment.Preproc", "p"),
    ("Comment", "c"),
    ("Keyword.Type", "t"),
    ("Keyword", "k"),
    ("Literal.String", "s"),
    ("Literal.Number", "m"),
    ("Name.Function", "f"),
    ("Name.Class", "f"),
    ("Name.Decorator", "p"),
    ("Name.Tag", "k"),
    ("Name.Attribute", "t"),
    ("Name.Builtin", "t"),
    ("Operator.Word", "k"),
)


def colour(lines: Sequence[str], language: str) -> list[tuple[Piece, ...]]:
    """Return each line as coloured pieces; plain where the language has no lexer."""
    lexer = _lexer(_LEXERS.get(language, ""))
    if lexer is None:
        return [(("", line),) if line else () for line in lines]
    coloured: list[list[Piece]] = [[]]
    # Some lexers know the end of a comment only by the end of its line, so the last line gets one too.
    for kind, text in lexer.get_tokens("\n".join(lines) + "\n"):
        name = _class_of(kind)
        if "\n" not in text:
            _append(coloured[-1], name, text)
            continue
        first, *others = text.split("\n")
        _append(coloured[-1], name, first)
        coloured.extend([(name, other)] if other else [] for other in others)
    return [tuple(coloured[place]) if place < len(coloured) else () for place in range(len(lines))]


def _append(line: list[Piece], name: str, text: str) -> None:
    if line and line[-1][0] == name:
        line[-1] = (name, line[-1][1] + text)
    elif text:
        line.append((name, text))


@lru_cache(maxsize=256)
def _class_of(kind: _TokenType) -> str:
    name = str(kind).removeprefix("Token.")
    return next((css for prefix, css in _CLASSES if name.startswith(prefix)), "")


@lru_cache(maxsize=16)
def _lexer(name: str) -> Lexer | None:
    if not name:
        return None
    from pygments.lexers import get_lexer_by_name

    return get_lexer_by_name(name, stripnl=False, ensurenl=False)
