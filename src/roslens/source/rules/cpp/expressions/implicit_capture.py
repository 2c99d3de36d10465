"""Rule ``cpp.implicit_capture``: a lambda that captures whatever it names."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each default capture."""
    yield view.hit(
        "cpp.implicit_capture", node, f"`[{view.text(node)}]` captures whatever is named; expected the names"
    )


RULE = FileRule(
    id="cpp.implicit_capture",
    title="Default capture of a lambda",
    finds="`[=]` and `[&]` capture whatever the body names, `this` included. Name what is captured.",
    why="A callback that outlives its function keeps references to variables that are gone.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "autosar-cpp14",
        "safety",
        "paper2016",
    ),
    clauses=(
        "hicpp 5.1.4",
        "autosar-cpp14 A5-1-2",
        "paper2016 default_lambda_captures",
    ),
    bad="auto f(int a) { return [=] { return a; }; }\n",
    good="auto f(int a) { return [a] { return a; }; }\n",
    syntax="cpp",
    kinds=("lambda_default_capture",),
    found=found,
)
