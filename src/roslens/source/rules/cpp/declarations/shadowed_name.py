"""Rule ``cpp.shadowed_name``: a name that hides another one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.cpp_class import function_of, name_node, parameters_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_SCOPES = ("compound_statement", "for_statement", "for_range_loop", "if_statement", "while_statement")
_ENDS = ("function_definition", "lambda_expression", "class_specifier", "struct_specifier")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each local name that stands in a block around its own, or among the parameters."""
    around = node.parent
    if around is None or around.type not in _SCOPES:
        return
    for one in node.children_by_field_name("declarator"):
        named = name_node(one)
        if named is not None and named.type == "identifier":
            name = view.text(named)
            hidden = _hidden(name, node, view)
            if hidden is not None:
                yield view.hit(
                    "cpp.shadowed_name",
                    named,
                    f"`{name}` hides the one of line {view.place(hidden.start_byte)[0]}; expected another name",
                )


def _hidden(name: str, declaration: Node, view: FileView) -> Node | None:
    """Return the declaration of the same name in a scope around that of another one."""
    scope = declaration.parent
    inside = scope
    one = scope.parent if scope is not None else None
    while one is not None and inside is not None:
        if one.type in _ENDS:
            declared = _declared(one, view) if one.type == "function_definition" else ()
            return next((parameter for parameter, names in declared if name in names), None)
        if one.type in _SCOPES:
            for child, names in _declared(one, view):
                if child.start_byte >= inside.start_byte:
                    break
                if name in names:
                    return child
        inside, one = one, one.parent
    return None


def _declared(scope: Node, view: FileView) -> Sequence[tuple[Node, Sequence[str]]]:
    """Return the declarations of a block, or the parameters of a function, with their names."""
    key = ("declared", scope.id)
    known = view.kept.get(key)
    if known is None:
        if scope.type == "function_definition":
            declarator = function_of(scope, view).declarator
            known = [
                (one, (view.text(name_node(one.child_by_field_name("declarator"))).lstrip("&* "),))
                for one in (parameters_of(declarator) if declarator is not None else ())
            ]
        else:
            known = [
                (one, [view.text(name_node(each)) for each in one.children_by_field_name("declarator")])
                for one in scope.named_children
                if one.type == "declaration"
            ]
        view.kept[key] = known
    return cast("Sequence[tuple[Node, Sequence[str]]]", known)


RULE = FileRule(
    id="cpp.shadowed_name",
    title="Name that hides another one",
    finds="A local variable whose name a parameter or a variable of a block around it has. Take another name; "
    "lambdas begin anew.",
    why="The outer variable is the one that was meant to be set: the result of the inner block is thrown away.",
    severity=Severity.NOTE,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 2-10-2",
        "misra-cpp-2023 6.4.1",
        "jsf-av 135",
        "hicpp 3.1.1",
        "clang-tidy clang-diagnostic-shadow",
    ),
    bad="void f(int a) { int b = a; if (a) { int b = 3; g(b); } h(b); }\n",
    good="void f(int a) { int b = a; if (a) { int c = 3; g(c); } h(b); }\n",
    syntax="cpp",
    kinds=("declaration",),
    found=found,
)
