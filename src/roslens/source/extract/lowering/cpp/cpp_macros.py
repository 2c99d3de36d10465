"""Constants defined by ``#define``, and the macros that register classes as plug-ins or components."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Tree

from roslens.source.extract.ir.program import Call, Evaluate, Expression, Literal, Name, Operation
from roslens.source.extract.lowering.cpp.cpp_literals import number_value, text_value
from roslens.source.extract.lowering.cpp.cpp_lowered import name_of, opaque
from roslens.source.extract.lowering.cpp.cpp_types import dotted
from roslens.source.syntax.cpp_names import text_of

_PART = re.compile(r'\s*(?:((?:u8|[uUL])?"(?:[^"\\]|\\.)*")|([A-Za-z_]\w*))')
_NUMBER = re.compile(r"([-+]?)\s*([0-9.][\w.']*)")
_NAME = re.compile(r"(?:::)?[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*")
_PARENTHESES = re.compile(r"\(*\([^()]*\)\)*")
_COMMENT = re.compile(rb"/\*.*?\*/|//[^\n]*", re.DOTALL)
_CONSTANTS = {"true": True, "false": False, "NULL": None, "nullptr": None}
_REGISTRATION = re.compile(
    rb"\b((?:RCLCPP_COMPONENTS_REGISTER|PLUGINLIB_(?:EXPORT|DECLARE|REGISTER)|NODELET_REGISTER|CLASS_LOADER_REGISTER)_\w+"
    rb"|RCLCPP_USING_CUSTOM_TYPE_AS_ROS_MESSAGE_TYPE)"
    rb"[ \t]*\(([^(){};]{1,500})\)"
)
_TEXT = re.compile(r'"(?:[^"\\]|\\.)*"')


def macro_value(written: bytes) -> Expression | None:
    """Return the value of a macro without parameters; None of one that is empty."""
    text = text_of(_COMMENT.sub(b" ", written).replace(b"\\\n", b" ")).strip()
    while _PARENTHESES.fullmatch(text):
        text = text[1:-1].strip()
    if not text:
        return None
    number = _NUMBER.fullmatch(text)
    if number:
        value = number_value(number[2])
        if value is not None:
            return Literal(-value if number[1] == "-" else value)
    if text in _CONSTANTS:
        return Literal(_CONSTANTS[text])
    if _NAME.fullmatch(text):
        return Name(dotted(text))
    return _joined(text) or opaque(text.encode())


def _joined(text: str) -> Expression | None:
    """Return texts and names side by side as one text; None where there is anything else."""
    parts: list[Expression] = []
    end = 0
    while end < len(text):
        match = _PART.match(text, end)
        if match is None:
            return None
        end = match.end()
        last = parts[-1] if parts else None
        if match[1] is None:
            parts.append(Name(match[2]))
        elif isinstance(last, Literal):
            parts[-1] = Literal(f"{last.value}{text_value(match[1])}")
        else:
            parts.append(Literal(text_value(match[1])))
    if not any(isinstance(part, Literal) for part in parts):
        return None
    return parts[0] if len(parts) == 1 else Operation("+", tuple(parts))


def is_registration(statement: bytes) -> bool:
    """Return whether a statement is the call of a macro that registers a class."""
    return _REGISTRATION.match(statement) is not None


def registrations(content: bytes, tree: Tree) -> Iterator[Evaluate]:
    """Yield the calls of macros that register classes, from the file as it is: before a parse they are blanked.

    Args:
        content: the bytes of the file.
        tree: of the same, to tell comments apart.
    """
    if b"_REGISTER" not in content and b"PLUGINLIB_" not in content and b"_CUSTOM_TYPE_AS_" not in content:
        return
    for match in _REGISTRATION.finditer(content):
        start = match.start()
        line_start = content.rfind(b"\n", 0, start) + 1
        if content[line_start:start].lstrip().startswith(b"#") or _in_comment(tree, start, match.end()):
            continue
        arguments = tuple(map(_argument, text_of(_COMMENT.sub(b" ", match[2])).split(",")))
        line = content.count(b"\n", 0, start) + 1
        yield Evaluate(Call(Name(text_of(match[1])), arguments, (), (), line, start - line_start + 1), line)


def _argument(written: str) -> Expression:
    text = written.strip()
    return Literal(text_value(text)) if _TEXT.fullmatch(text) else name_of(dotted(text))


def _in_comment(tree: Tree, start: int, end: int) -> bool:
    node = tree.root_node.descendant_for_byte_range(start, end)
    return node is not None and node.type in ("comment", "string_content", "string_literal", "raw_string_content")
