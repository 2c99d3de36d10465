"""Rule ``cpp.function_macro``: a macro that could be a function."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each macro with parameters that is an expression."""
    value = view.text(node.child_by_field_name("value"))
    if value and not any(one in value for one in ("#", "__", "{", "do ", "class ", "struct ", "namespace", "template")):
        yield view.hit_at(
            "cpp.function_macro",
            view.place(node.start_byte)[0],
            f"`{view.text(node.child_by_field_name('name'))}` is a macro with parameters; expected a function",
        )


RULE = FileRule(
    id="cpp.function_macro",
    title="Macro like a function",
    finds="A macro with parameters. Write an `inline` or `constexpr` function, or a template; macros that paste "
    "or quote are let be.",
    why="Its arguments are evaluated as often as they are written, and no debugger stops in it.",
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
        "misra-cpp-2008 16-0-4",
        "misra-cpp-2023 19.0.2",
        "autosar-cpp14 A16-0-1",
        "jsf-av 29",
        "hicpp 16.1.1",
        "clang-tidy cppcoreguidelines-macro-usage",
    ),
    bad="#define TWICE(x) (2 * (x))\n",
    good="constexpr int twice(int x) { return 2 * x; }\n",
    syntax="cpp",
    kinds=("preproc_function_def",),
    found=found,
)
