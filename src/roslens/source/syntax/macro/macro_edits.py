"""What happens to each kind of macro: bytes are replaced in place, lengths and line breaks stay.

Every edit takes the original content, the text to change, and the offsets of the macro's name; it returns the
offset behind what it dealt with, or -1 where the arguments are never closed.
"""

from __future__ import annotations

import re

from roslens.source.syntax.comments import blank_comments

_STEP = re.compile(rb"""[()\[\]{},]|"(?:[^"\\\n]|\\.)*"?|'(?:\\.[^'\n]{0,8}|[^'\\\n]{1,4})'|//[^\n]*""")
_ARGUMENTS = re.compile(rb"[ \t]*\(")
_DECLARATION_FOLLOWS = re.compile(rb"\s*(?:[A-Za-z_~]|::|\[\[)")
_NO_STATEMENT = re.compile(rb"\s*[;{\-.,)=:]")
_NAME_ONLY = re.compile(rb"\s*\w+\s*")
_STATEMENT = re.compile(
    rb"\s*(?:\{|(?:try|for|while|do|if|switch)\b|(?:const\s+)?[\w:]+(?:\s*<[^;(){}]*>)?[\s*&]+\w+\s*[({=;])"
)
_EXPRESSION = re.compile(rb"\s*(?:return|throw|new|delete|co_\w+)\b")
_SEMICOLON = re.compile(rb"\s*;")
_LINKAGE = re.compile(rb"[ \t]*#[ \t]*if[^\n]*__cplusplus[^\n]*\n")
_EXTERN_C = re.compile(rb'extern\s*"C"\s*\{')
_BLANK = bytes(byte if byte in b"\n\r" else 0x20 for byte in range(256))
_LONGEST_ARGUMENTS = 20_000
_LONGEST_SECTION = 4_000


def fill(text: bytearray, start: int, end: int, with_: bytes = b"") -> None:
    """Replace ``text[start:end]`` by ``with_`` and as many spaces as keep its length; line breaks stay."""
    rest = bytes(text[start + len(with_) : end]).translate(_BLANK)
    if len(with_) + len(rest) == end - start:
        text[start:end] = with_ + rest


def arguments_of(content: bytes, end: int) -> tuple[int, int, int] | None:
    """Return the offsets of ``(``, of the first comma between arguments (or -1) and of ``)``.

    None means that there are no arguments; a closing offset of -1 that they do not end.
    """
    opening = _ARGUMENTS.match(content, end)
    if not opening:
        return None
    comma, depth = -1, 1
    for step in _STEP.finditer(content, opening.end(), opening.end() + _LONGEST_ARGUMENTS):
        sign = step[0]
        if sign in b"([{":
            depth += 1
        elif sign in b")]}":
            depth -= 1
            if not depth:
                return opening.end() - 1, comma, step.start()
        elif sign == b"," and depth == 1 and comma < 0:
            comma = step.start()
    return opening.end() - 1, comma, -1


def behind_arguments(content: bytes, end: int) -> int:
    """Return the offset behind a name that ends at ``end`` or behind its arguments; -1 where they never end."""
    arguments = arguments_of(content, end)
    if arguments is None:
        return end
    return arguments[2] + 1 or -1


def _blank_before_declaration(content: bytes, text: bytearray, start: int, end: int) -> int:
    end = behind_arguments(content, end)
    if end > 0 and _DECLARATION_FOLLOWS.match(content, end):
        fill(text, start, end)
    return end


def _blank_anywhere(content: bytes, text: bytearray, start: int, end: int) -> int:
    end = behind_arguments(content, end)
    if end > 0:
        fill(text, start, end)
    return end


def _blank_statement(content: bytes, text: bytearray, start: int, end: int) -> int:
    end = behind_arguments(content, end)
    if end > 0 and not _NO_STATEMENT.match(content, end):
        fill(text, start, end)
    return end


def _blank_keyword(content: bytes, text: bytearray, start: int, end: int) -> int:
    if _DECLARATION_FOLLOWS.match(content, end):
        fill(text, start, end)
    return end


def _loop(content: bytes, text: bytearray, start: int, end: int) -> int:
    """Turn ``NAME(Type variable, container)`` into ``for (Type variable: container)``."""
    arguments = arguments_of(content, end)
    if arguments is None:
        return end
    opening, comma, closing = arguments
    if closing < 0 or comma < 0:
        return -1
    if _NAME_ONLY.fullmatch(content, opening + 1, comma):
        fill(text, start, opening + 1, b"for(int ")
    else:
        fill(text, start, opening, b"for")
    text[comma : comma + 1] = b":"
    return opening


def _blank_arguments(content: bytes, text: bytearray, _start: int, end: int) -> int:
    arguments = arguments_of(content, end)
    if arguments is None:
        return end
    opening, _, closing = arguments
    if closing > 0:
        fill(text, opening + 1, closing)
    return closing


def _block(content: bytes, text: bytearray, start: int, end: int) -> int:
    """Turn ``NAME(statement, more);`` into ``{statement; };`` where the statement is no expression."""
    arguments = arguments_of(content, end)
    if arguments is None:
        return end
    opening, comma, closing = arguments
    if closing < 0:
        return -1
    if not _STATEMENT.match(content, opening + 1, closing) or _EXPRESSION.match(content, opening + 1):
        return closing
    semicolon = _SEMICOLON.match(content, closing + 1)
    if comma > 0:
        fill(text, comma, closing + 1, b";")
        text[closing : closing + 1] = b"}"
    elif semicolon:
        text[closing : closing + 1] = b";"
        fill(text, closing + 1, semicolon.end())
        text[semicolon.end() - 1 : semicolon.end()] = b"}"
    else:
        return closing
    fill(text, start, opening + 1)
    text[opening : opening + 1] = b"{"
    return closing


def blank_linkage(content: bytes, text: bytearray, position: int) -> None:
    """Blank ``extern "C" {`` and ``}`` where each stands between its own ``#ifdef __cplusplus`` and ``#endif``."""
    line_start = content.rfind(b"\n", max(0, position - _LONGEST_SECTION), position) + 1
    condition = _LINKAGE.match(content, line_start)
    if not condition:
        return
    start = condition.end()
    end = content.find(b"#", start, start + _LONGEST_SECTION)
    if end < 0:
        return
    section = blank_comments(content[start:end], "cpp")
    if section.strip() == b"}":
        fill(text, start + section.index(b"}"), start + section.index(b"}") + 1)
    opening = _EXTERN_C.search(content, start, end)
    if opening and b"}" not in content[opening.end() : end]:
        fill(text, *opening.span())


EDITS = {
    "before_declaration": _blank_before_declaration,
    "anywhere": _blank_anywhere,
    "statement": _blank_statement,
    "keyword": _blank_keyword,
    "loop": _loop,
    "opaque": _blank_arguments,
    "block": _block,
}
"""Kind of macro to its edit."""
