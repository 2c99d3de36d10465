"""Rule ``cpp.shadowed_name``: a name that hides another one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_declaration import declarations, hidden_by
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found_among(_nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each local name that stands in a block around its own, or among the parameters."""
    for declaration in declarations(view).values():
        for _, named, name in declaration.names:
            if named is not None and named.type == "identifier":
                hidden = hidden_by(name, declaration, view)
                if hidden is not None:
                    yield view.hit(
                        "cpp.shadowed_name",
                        named,
                        f"`{name}` hides the one of line {view.place(hidden.start_byte)[0]}; expected another name",
                    )


RULE = FileRule(
    id="cpp.shadowed_name",
    title="Name that hides another one",
    finds="A local variable whose name a parameter or a variable of a block around it has. Take another name; "
    "lambdas begin anew.",
    why="The outer variable is the one that was meant to be set: the result of the inner block is thrown away.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
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
    gathers=("function_definition",),
    found_among=found_among,
)
