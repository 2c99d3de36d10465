"""What single statements of C++ are: conditions without effect, ends of cases, pointers that take an object."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.extract.ir.program import Call, Expression, Literal, Member, Name, Opaque, Operation

_SAYING_NOTHING = (Name, Opaque, Literal, Member)


def says_nothing(condition: Expression | None) -> bool:
    """Whether a condition calls nothing and compares nothing."""
    return condition is None or isinstance(condition, _SAYING_NOTHING)


def any_label(labels: list[Expression]) -> Expression:
    """Return that a choice is for one of several labels."""
    return labels[0] if len(labels) == 1 else Operation("or", tuple(labels))


def ends_case(nodes: list[Node]) -> bool:
    """Whether statements of a case end so that the next one does not follow."""
    last = next((one for one in reversed(nodes) if one.type != "comment"), None)
    if last is not None and last.type == "compound_statement":
        return ends_case(last.named_children)
    return last is not None and last.type in _ENDING


_ENDING = frozenset(
    {"break_statement", "return_statement", "throw_statement", "continue_statement", "goto_statement",
     "co_return_statement"}
)  # fmt: skip


def owned(call: Call, node: Node) -> tuple[Expression, Expression] | None:
    """Return the pointer and the object of ``pointer.reset(new Class(…))`` or ``reset(this)``, an assignment.

    What deletes the object may be given behind it.
    """
    function = call.function
    if isinstance(function, Member) and function.name == "reset" and 1 <= len(call.arguments) <= 2:
        written = node.child_by_field_name("arguments")
        given = [one.type for one in written.named_children if one.type != "comment"] if written is not None else []
        if given and given[0] in {"new_expression", "this"}:
            return function.of, call.arguments[0]
    return None
