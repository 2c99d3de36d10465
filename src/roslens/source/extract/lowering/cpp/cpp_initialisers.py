"""What a constructor does before its body: it initialises members, calls bases or another constructor."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.extract.ir.program import Assign, Call, Evaluate, Member, Name, Sequence, Statement
from roslens.source.extract.lowering.cpp.cpp_expressions import Expressions
from roslens.source.extract.lowering.cpp.cpp_lowered import Lowered
from roslens.source.extract.lowering.cpp.cpp_types import name_and_templates

_SELF = Name("self")


def lower_initialisers(
    listed: Node, lowered: Lowered, expressions: Expressions, bases: tuple[str, ...]
) -> tuple[Statement, ...]:
    """Return the initialisers of a constructor.

    One of a member is an assignment of its argument, or of the sequence of its arguments where there is not exactly
    one: what it constructs only the class says. One of a base, or of the class itself, is a call.

    Args:
        listed: the list of initialisers.
        lowered: where it is lowered.
        expressions: what lowers the values.
        bases: names of the class and its bases as far as the file knows them.
    """
    statements: list[Statement] = []
    for node in listed.named_children:
        children = [child for child in node.named_children if child.type != "comment"]
        if node.type != "field_initializer" or len(children) < 2:
            continue
        name, templates = name_and_templates(lowered.text(children[0]))
        if not name:
            continue
        arguments = expressions.several(children[1])
        row, column = node.start_point
        if name in bases or _looks_like_a_class(name, templates):
            statements.append(Evaluate(Call(Name(name), arguments, (), templates, row + 1, column + 1), row + 1))
        else:
            value = arguments[0] if len(arguments) == 1 else Sequence(arguments)
            statements.append(Assign(Member(_SELF, name), value, "", "=", row + 1))
    return tuple(statements)


def _looks_like_a_class(name: str, templates: tuple[str, ...]) -> bool:
    """Return whether a name is that of a base by its look: bases are often declared in another file."""
    return bool(templates) or "." in name or (name[:1].isupper() and not name.endswith("_") and not name.isupper())
