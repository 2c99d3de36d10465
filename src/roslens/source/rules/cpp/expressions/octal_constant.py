"""Rule ``cpp.octal_constant``: a number that is octal because it begins with 0."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_OCTAL = re.compile(rb"0[0-7](?<![\w.\x80-\xff]0[0-7])[0-7]*[uUlL]*(?![\w.\x80-\xff])")
_TAKE_MODES = re.compile(r"(?:chmod|mkdir|open|umask|creat|mkfifo|mode|perm)\w*$", re.IGNORECASE)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each number that begins with 0 and has more digits."""
    for match, node in places(_OCTAL, view):
        text = view.text(node)
        if node.type != "number_literal" or text.strip("0uUlL") == "" or text.encode() != match[0]:
            continue
        call = above(
            node,
            "call_expression",
            "init_declarator",
            "field_initializer",
            "assignment_expression",
            "compound_statement",
        )
        if call is not None and call.type != "compound_statement":
            target = (
                call.child_by_field_name("function")
                or call.child_by_field_name("declarator")
                or call.child_by_field_name("left")
            )
            if _TAKE_MODES.search(view.text(target)):
                continue
        yield view.hit("cpp.octal_constant", node, f"`{text}` is octal; expected a decimal or hexadecimal number")


RULE = FileRule(
    id="cpp.octal_constant",
    title="Octal number",
    finds="A number that begins with 0: `010` is eight. Modes of files, as of `chmod` and `mkdir`, are let be. "
    "Write it in decimal or hexadecimal.",
    why="Aligning a table of joint offsets with zeros changes the numbers.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 2-13-2",
        "misra-cpp-2023 5.13.3",
        "autosar-cpp14 M2-13-2",
        "jsf-av 149",
        "hicpp 2.5.2",
    ),
    bad="int steps = 010;\n",
    good="int steps = 10;\n",
    syntax="cpp",
    whole=True,
    found=found,
)
