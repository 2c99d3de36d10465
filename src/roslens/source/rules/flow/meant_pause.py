"""Pauses that whoever wrote them says are meant.

A comment beside a pause, or above it, says what is waited for, or that it stands for work; so does a message that is
logged before it. So does what ends the process or the computer after it. A command that is published right before a
pause holds as long as the pause is, where the function publishes by the same publisher again. In a class that is an
example there is nothing that could be late. A function that pauses again and again is a sequence of movements: its
author decided how long each takes.
"""

from __future__ import annotations

import re

from tree_sitter import Node

from roslens.source.rules.file_view import FileView, above

_SAID = re.compile(
    r"(?i)\b(?:wait|sleep|paus|settl|stabili[sz]|simulat|pretend|emulat|assum|delay|block|dead.?lock|warm|boot|hold"
    r"|mak(?:e|ing) sure|ensur|long[- ]running|heavy|work|slow|need|for \d|\d+(?:\.\d+)? ?s(?:ec(?:ond)?s?)?\b"
    r"|give\b.*\btime|time to|let\b|until|esper|pausa|warten|attend)|等|延[时時迟]|休眠|대기|待"
)
"""Words that tell of a pause, or of work that one stands for."""
_COMMENT = re.compile(r"(?:#|//|/\*|^\s*\*)(.*)")
_LOGS = re.compile(r"(?i)\b(?:\w*log\w*|ros_\w+|rclcpp_\w+|print\w*|info|warn\w*|debug|cout)\b")
_PUBLISHES = re.compile(r"([\w.>-]+?)(?:\.|->)publish\s*\(")
_EXAMPLE = re.compile(r"(?:[Ee]xample|[Dd]emo|[Tt]utorial|[Ss]ample|[Dd]ead_?[Ll]ock)(?![a-z])")
_ENDS = re.compile(r"(?i)\b(?:\w*shut_?down|power_?off|halt|reboot|s?exit|quit|kill|terminate)\b")
_ENDING = re.compile(r"(?i)shut_?down|power_?off|reboot")
_PAUSES = re.compile(r"\bsleep(?:_for)?\s*\(")
_SEQUENCE = {"function_definition": 4, "class_definition": 10}
"""Pauses of what is around a call from which on it is a sequence."""
_BODIES = frozenset(("block", "compound_statement", "module", "translation_unit", "case_statement"))


def is_meant(call: Node, view: FileView) -> bool:
    """Return whether a call that sleeps is said to be meant, or is how long a command holds."""
    statement = _statement_around(call)
    before = _statement_before(statement)
    return (
        _is_commented(call, view)
        or (before is not None and (_is_logged(before, view) or _is_held(before, call, view)))
        or _is_before_the_end(call, view)
        or _is_of_an_example(call, view)
        or _is_in_a_sequence(call, view)
    )


def _statement_around(node: Node) -> Node:
    while node.parent is not None and node.parent.type not in _BODIES:
        node = node.parent
    return node


def _statement_before(statement: Node) -> Node | None:
    before = statement.prev_named_sibling
    while before is not None and before.type == "comment":
        before = before.prev_named_sibling
    return before


def _is_commented(call: Node, view: FileView) -> bool:
    first, last = call.start_point[0], call.end_point[0]
    beside = view.lines[last].decode("utf-8", "replace") if last < len(view.lines) else ""
    texts = [beside[min(call.end_point[1], len(beside)) :]]
    for number in range(first - 1, max(first - 4, -1), -1):
        line = view.lines[number].decode("utf-8", "replace")
        if not _COMMENT.match(line.strip()):
            break
        texts.append(line)
    comments = (_COMMENT.search(text.strip()) for text in texts)
    return any(one is not None and _SAID.search(one[1]) is not None for one in comments)


def _is_logged(before: Node, view: FileView) -> bool:
    text = view.text(before)
    return _LOGS.match(text.removeprefix("self.")) is not None and _SAID.search(text) is not None


def _is_held(before: Node, call: Node, view: FileView) -> bool:
    """Return whether a command is published right before, and another one by the same publisher in the function."""
    published = _PUBLISHES.match(view.text(before))
    around = above(call, "function_definition")
    if published is None or around is None:
        return False
    code = view.source[around.start_byte : around.end_byte].decode("utf-8", "replace")
    again: list[str] = _PUBLISHES.findall(code)
    return again.count(published[1]) > 1


def _is_before_the_end(call: Node, view: FileView) -> bool:
    """Return whether the function around a call ends the process or the computer behind it, or has the name of that."""
    around = above(call, "function_definition")
    if around is None:
        return False
    name = view.text(around.child_by_field_name("name") or around.child_by_field_name("declarator")).partition("(")[0]
    if _ENDING.search(name):
        return True
    rest = view.code[call.end_byte : around.end_byte].decode("utf-8", "replace")
    return any(_ENDS.search(line) and "(" in line for line in rest.splitlines())


def _is_in_a_sequence(call: Node, view: FileView) -> bool:
    """Return whether the function, or the class, around a call pauses so often that it plays a sequence."""
    for kind, least in _SEQUENCE.items():
        around = above(call, kind)
        if around is not None:
            code = view.code[around.start_byte : around.end_byte].decode("utf-8", "replace")
            if len(_PAUSES.findall(code)) >= least:
                return True
    return False


def _is_of_an_example(call: Node, view: FileView) -> bool:
    """Return whether the class or the function around a call has the name of an example."""
    around = above(call, "function_definition")
    inside = above(call, "class_definition", "class_specifier", "struct_specifier")
    names = []
    if inside is not None:
        names.append(view.text(inside.child_by_field_name("name")))
    if around is not None:
        names.append(view.text(around.child_by_field_name("name") or around.child_by_field_name("declarator")))
    return any(_EXAMPLE.search(name.partition("(")[0]) is not None for name in names)
