"""Where a time goes within one file: into the stamp of a message, or beside a time of the node's clock.

A time is followed through conversions, variables, members and functions of the file that return it. What happens to it
in functions that are not conversions is not known, and it is not followed there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec
from tree_sitter import Node

from roslens.source.rules.callbacks import callee_name, function_name
from roslens.source.rules.calls import function_around, number_of, statement_around, whole_name
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView, above

_STAMP = re.compile(r"(?:^|\.|->)stamp(?:_?\.(?:sec|secs|nanosec|nsec|nsecs))?$")
"""A stamp of a message, or a part of one; a variable such as ``timestamp`` may be anything."""

_ROS_TIME = re.compile(
    r"^(?:(?:this->|self\.)?(?:\w*node\w*(?:\(\))?(?:->|\.))?(?:get_clock\(\)(?:->|\.))?now\(\)(?:\.nanoseconds(?:\(\))?|"
    r"\.seconds\(\))?"
    r"|ros::Time::now\(\)(?:\.to\w+\(\))?|rospy\.Time\.now\(\)(?:\.\w+(?:\(\))?)?|rospy\.(?:get_rostime|get_time)\(\)"
    r"|(?:rclcpp::Time\(|Time\.from_msg\()?[\w.>()-]*header(?:\.|->)stamp\)?(?:\.to_sec\(\)|\.toSec\(\)|\.seconds\(\))?)$"
)
"""A time of the node's clock, or the stamp of a message."""

_CONVERSIONS = frozenset(
    (
        *("Time", "TimePoint", "from_sec", "fromSec", "from_msg", "to_msg", "toMsg", "from_seconds", "Stamp"),
        *("seconds", "nanoseconds", "toSec", "toNSec", "to_sec", "to_nsec", "time_since_epoch", "count", "timestamp"),
        *(
            "duration_cast",
            "time_point_cast",
            "static_cast",
            "int",
            "float",
            "round",
            "floor",
            "trunc",
            "modf",
            "divmod",
        ),
        *("int32_t", "uint32_t", "int64_t", "uint64_t", "double", "milliseconds", "microseconds"),
    )
)
"""What makes another form of the same time."""

_ARITHMETIC = frozenset(("/", "//", "*", "%"))
_COMPARED = frozenset(("-", "<", ">", "<=", ">=", "==", "!="))
_THROUGH = frozenset(
    (
        *(
            "parenthesized_expression",
            "argument_list",
            "initializer_list",
            "cast_expression",
            "compound_literal_expression",
        ),
        *("field_expression", "attribute", "subscript"),
    )
)
_DECLARATIONS = frozenset(("init_declarator", "declaration", "parameter_declaration"))
_MOST_STEPS = 6
_MOST_USES = 40


class Reached(msgspec.Struct, frozen=True):
    """Where a time leads.

    Attributes:
        node: the place.
        is_stamp: whether it is a message's stamp; otherwise it is compared with, or subtracted from, a time of ROS.
        by: the variable, member or function that carried it there last; empty where none did.
    """

    node: Node
    is_stamp: bool
    by: str = ""

    @property
    def carried(self) -> str:
        """What to add to a message on the time: empty where it stands at the place itself."""
        if not self.by:
            return ""
        line = self.node.start_point[0] + 1
        return f"; `{self.by}` {'makes a stamp of it' if self.is_stamp else 'meets a time of ROS'} in line {line}"


def reached(value: Node, view: FileView) -> Reached | None:
    """Return where a time becomes a stamp or meets a time of ROS, None where it does neither as far as is known.

    Args:
        value: the expression that reads a clock, or the parameter that ``T t(clock::now());`` is read as.
        view: the file.
    """
    waiting: list[tuple[Node, str, int]] = [(value, "", 0)]
    seen: set[tuple[str, int]] = set()
    while waiting:
        node, by, steps = waiting.pop(0)
        end = _climb(node, view)
        if isinstance(end, Reached):
            return Reached(end.node, end.is_stamp, by)
        if end is None or steps == _MOST_STEPS:
            continue
        name, scope, start = end
        if (name, scope.start_byte) in seen or _is_set_otherwise(name, node, scope, view):
            continue
        seen.add((name, scope.start_byte))
        waiting += ((use, name, steps + 1) for use in _uses(name, node, scope, start, view))
    return None


def _climb(value: Node, view: FileView) -> Reached | tuple[str, Node, int] | None:
    """Return where the expression around a value leads: a place, or a name with its scope and where that begins."""
    if value.type == "parameter_declaration":
        declared = above(value, "function_declarator")
        return _named(declared.child_by_field_name("declarator") if declared else None, value, view)
    node = value
    while (around := node.parent) is not None:
        end = _end(around, node, view)
        if end is not None or not _is_still_a_time(around, view):
            return end
        node = around
    return None


def _end(around: Node, node: Node, view: FileView) -> Reached | tuple[str, Node, int] | None:
    """Return where a time leads by what is directly around it; None where that is no end."""
    match around.type:
        case "assignment_expression" | "assignment":
            return _assigned(around, node, view)
        case "init_declarator" if around.child_by_field_name("value") == node:
            return _named(around.child_by_field_name("declarator"), around, view)
        case "return_statement":
            return _returned(around, view)
        case "keyword_argument" if view.text(around.child_by_field_name("name")) == "stamp":
            return Reached(around, is_stamp=True)
        case "binary_expression" | "binary_operator" | "comparison_operator":
            others = [one for one in around.named_children if one != node]
            is_met = _sign(around, view) in _COMPARED and len(others) == 1 and _ROS_TIME.match(view.text(others[0]))
            return Reached(around, is_stamp=False) if is_met else None
    return None


def _returned(statement: Node, view: FileView) -> tuple[str, Node, int] | None:
    function = function_around(statement)
    name = function_name(function, view) if function is not None and function.type == "function_definition" else ""
    return (re.split(r"::|\.", name)[-1], view.root, 0) if name else None


def _is_still_a_time(around: Node, view: FileView) -> bool:
    """Return whether an expression around a time is another form of it."""
    if around.type in ("call_expression", "call"):
        return callee_name(around, view) in _CONVERSIONS
    if around.type in ("binary_expression", "binary_operator"):
        sign = _sign(around, view)
        right = around.child_by_field_name("right")
        return sign == "+" or (sign in _ARITHMETIC and number_of(right, view) is not None)
    return around.type in _THROUGH


def _sign(operation: Node, view: FileView) -> str:
    return view.text(operation.child_by_field_name("operator") or operation.children[1])


def _assigned(assignment: Node, node: Node, view: FileView) -> Reached | tuple[str, Node, int] | None:
    left = assignment.child_by_field_name("left")
    if left is None or assignment.child_by_field_name("right") != node:
        return None
    if _STAMP.search(view.text(left)):
        return Reached(assignment, is_stamp=True)
    return _named(left, assignment, view)


def _named(target: Node | None, binding: Node, view: FileView) -> tuple[str, Node, int] | None:
    """Return the name of what is set, and where it is known: in its function, or in the file if it is a member."""
    name = view.text(target)
    plain = name.removeprefix("this->").removeprefix("self.")
    if not plain.isidentifier():
        return None
    function = function_around(binding)
    if (
        name != plain
        or function is None
        or (binding.type == "assignment_expression" and _is_member(plain, function, view))
    ):
        return (plain, view.root, 0)
    return (plain, function, binding.end_byte)


def _is_member(name: str, function: Node, view: FileView) -> bool:
    """Return whether a name of C++ is declared in no function around."""
    outer: Node | None = function
    while outer is not None:
        for at in word_places(name.encode(), view, outer.start_byte, outer.end_byte):
            found = view.node_at(at, at + len(name))
            around = found.parent if found is not None else None
            is_declared = around is not None and around.type in _DECLARATIONS
            if is_declared and around is not None and around.child_by_field_name("declarator") == found:
                return False
        outer = function_around(outer)
    return True


def _is_set_otherwise(name: str, value: Node, scope: Node, view: FileView) -> bool:
    """Return whether a name gets another time somewhere as well, so that nobody knows which one is used."""
    binding = statement_around(value)
    for at in word_places(name.encode(), view, scope.start_byte, scope.end_byte):
        if binding.start_byte <= at < binding.end_byte:
            continue
        found = view.node_at(at, at + len(name))
        whole = whole_name(found) if found is not None else None
        around = whole.parent if whole is not None else None
        if around is None or around.type not in ("assignment_expression", "assignment"):
            continue
        if around.child_by_field_name("left") == whole and _ROS_TIME.match(
            view.text(around.child_by_field_name("right"))
        ):
            return True
    return False


def _uses(name: str, value: Node, scope: Node, start: int, view: FileView) -> Iterator[Node]:
    """Yield where a name is read, or a function of that name called, at most so many places."""
    binding = statement_around(value)
    count = 0
    for at in word_places(name.encode(), view, max(start, scope.start_byte), scope.end_byte):
        if binding.start_byte <= at < binding.end_byte or count == _MOST_USES:
            continue
        found = view.node_at(at, at + len(name))
        if found is None or found.type not in ("identifier", "field_identifier"):
            continue
        whole = _of_this(found, view)
        if whole is None:
            continue
        count += 1
        around = whole.parent
        is_call = around is not None and around.type in ("call_expression", "call")
        called = is_call and around is not None and around.child_by_field_name("function") == whole
        yield around if called and around is not None else whole


def _of_this(node: Node, view: FileView) -> Node | None:
    """Return a name with ``this->`` or ``self.`` before it; None where it is the member of something else."""
    around = node.parent
    if around is None or around.type not in ("field_expression", "attribute"):
        return node
    if around.child_by_field_name("field") != node and around.child_by_field_name("attribute") != node:
        return node
    owner = around.child_by_field_name("argument") or around.child_by_field_name("object")
    return around if view.text(owner) in ("this", "self") else None
