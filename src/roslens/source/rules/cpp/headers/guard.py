"""Rule ``cpp.guard``: a header that can be read twice."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec
from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import GUARD_NAME, GUARDED, Hit
from roslens.source.rules.rule import FileRule

_GUARD = re.compile(
    rb"#[ \t]*if(?:ndef[ \t]+(\w+)|[ \t]+!?[ \t]*!defined[ \t]*\(?[ \t]*(\w+)[ \t]*\)?)[^\n]*\n"
    rb"(?:[ \t]*\n)*[ \t]*#[ \t]*define[ \t]+(\w+)"
)
_BRANCH = re.compile(rb"^[ \t]*#[ \t]*(if|el|endif\b)", re.MULTILINE)
_ONCE = re.compile(rb"#[ \t]*pragma[ \t]+once\b")
_DEFINING = frozenset(
    (
        *("class_specifier", "struct_specifier", "namespace_definition", "enum_specifier", "template_declaration"),
        *("function_definition", "type_definition", "declaration"),
    )
)
_FIRST = re.compile(rb"\s*(\S)")

_SAYS_NOTHING = frozenset(
    (
        "comment",
        "preproc_def",
        "preproc_function_def",
        "preproc_include",
        "preproc_call",
        "expression_statement",
        "ERROR",
    )
)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield a file that nothing keeps from being read twice; whether it is a header, its name tells."""
    first = _FIRST.match(view.code)
    if first is None or (b"pragma" in view.words and _ONCE.search(view.code)):
        return
    guard = _GUARD.search(view.code) if b"define" in view.words else None
    if guard is None:
        if not _declares(view):
            return
        problem = "no `#pragma once` and no `#ifndef` … `#define` around the header"
        hit = view.hit_at(
            "cpp.guard",
            view.place(first.start(1))[0],
            f"{problem}; expected one of the two",
            only=GUARDED,
            edits=_around(first.start(1), view),
        )
        # What includes nothing needs what stands before its one `#include`: a piece of another file.
        yield hit if b"#include" in view.code else msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)
        return
    if not _is_around_the_rest(view.code, guard.end()):
        return
    tested = guard[1] or guard[2]
    # A guard around the whole file may be defined in a branch of another condition.
    if tested != guard[3] and not re.search(rb"#[ \t]*ifndef[ \t]+%s\b" % re.escape(guard[3]), view.code):
        line = view.place(guard.start(3))[0]
        wanted, got = tested.decode("utf-8", "replace"), guard[3].decode("utf-8", "replace")
        once = len(re.findall(rb"\b%s\b" % re.escape(guard[3]), view.content)) == 1
        yield view.hit_at(
            "cpp.guard",
            line,
            f"`#define {got}` below `#ifndef {wanted}`; expected `{wanted}`",
            only=GUARDED,
            edits=view.edits((guard.start(3), guard.end(3), wanted)) if once else (),
        )


def _is_around_the_rest(code: bytes, start: int) -> bool:
    """Return whether a condition that is open at ``start`` has one branch and ends where the file ends.

    A condition around some values, or around one of two definitions of a macro, is no guard.
    """
    depth = 1
    for branch in _BRANCH.finditer(code, start):
        if branch[1] == b"if":
            depth += 1
        elif branch[1] == b"el":
            if depth == 1:
                return False
        else:
            depth -= 1
            if not depth:
                return not code[branch.end() :].partition(b"\n")[2].strip()
    return True


def _declares(view: FileView) -> bool:
    """Return whether a second reading would declare something again.

    Macros alone may be said twice. A list of calls of macros is meant to be read more than once, with other
    definitions each time, and so is what takes its macros back by ``#undef``; the plug-ins of Eigen are read
    inside of a class.
    """
    if b"#undef" in view.code or (b"EIGEN_" in view.code and b"namespace" not in view.code):
        return False
    # One by one, as mostly the first that is neither comment nor directive does; all of a file are many.
    root = view.root
    nodes = (root.named_child(place) for place in range(root.named_child_count))
    return any(one is not None and one.type not in _SAYS_NOTHING for one in nodes)


def _around(first: int, view: FileView) -> tuple[Edit, ...]:
    """Return what puts a guard around the code of a header that defines something, so that it is read once anyway."""
    if b"#undef" in view.code or view.root.has_error or not _defines(view):
        return ()
    start = view.code.rfind(b"\n", 0, first) + 1
    # What stands right above the code is about it, unless it is where the file begins.
    above = view.content[:start].rstrip(b"\r\n")
    block = above.rfind(b"\n\n", 0, len(above)) + 2
    if block > 1 and len(view.content[:start]) - len(above) <= 2 and view.content[block:start].lstrip()[:1] == b"/":
        start = block
    tail = "" if view.content.endswith(b"\n") else "\n"
    end = len(view.content)
    name = GUARD_NAME
    return view.edits((start, start, f"#ifndef {name}\n#define {name}\n\n"), (end, end, f"{tail}\n#endif  // {name}\n"))


def _defines(view: FileView) -> bool:
    """Return whether something stands at the level of the file that can be defined once only."""
    root = view.root
    nodes = (root.named_child(place) for place in range(root.named_child_count))
    return any(one is not None and one.type in _DEFINING for one in nodes)


RULE = FileRule(
    id="cpp.guard",
    title="Header without a guard",
    finds="A header with neither `#pragma once` nor `#ifndef` and `#define` of one name around it. Add one of the two. "
    "Pieces that include nothing themselves are notes; lists of calls of macros are let be.",
    why="The day two headers include it, nothing compiles, with messages about another file.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "ros-style",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    tags=("header",),
    clauses=(
        "cpplint build/header_guard",
        "misra-cpp-2008 16-2-3",
        "misra-cpp-2023 19.2.1",
        "autosar-cpp14 M16-2-3",
        "jsf-av 27",
        "jsf-av 35",
        "hicpp 16.1.1",
        "paper2016 header_guard",
    ),
    fix="Puts a guard around, named by the profile: `PACKAGE__FOLDER__FILE_HPP_` in ROS 2, "
    "`PACKAGE_FOLDER_FILE_H` in ROS 1, `PACKAGE_FOLDER_FILE_H_` with `google`. A header with `#undef`, "
    "which may be read twice by intent, is left. Of two names, `#define` takes that of `#ifndef`.",
    bad="struct Pose { double x; };\n",
    good="#pragma once\nstruct Pose { double x; };\n",
    syntax="cpp",
    whole=True,
    found=found,
)
