"""Rule ``python.yaml_load``: yaml.load without a loader."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``yaml.load`` with nothing but the text."""
    attribute = node.parent
    call = attribute.parent if attribute is not None else None
    if attribute is None or call is None or call.type != "call" or view.text(attribute) != "yaml.load":
        return
    if b"ruamel" in view.code:
        return
    arguments = call.child_by_field_name("arguments")
    if arguments is None or arguments.type != "argument_list":
        return
    given = [child for child in arguments.children if child.is_named and child.type != "comment"]
    if len(given) == 1 and given[0].type not in ("list_splat", "dictionary_splat"):
        message = "yaml.load without a Loader raises a TypeError with PyYAML 6; expected yaml.safe_load"
        yield view.hit("python.yaml_load", call, message)


RULE = FileRule(
    id="python.yaml_load",
    title="YAML read without a loader",
    finds="`yaml.load(text)` without a `Loader`. Write `yaml.safe_load`.",
    why="PyYAML 6, which Ubuntu 24.04 and later have, raises a TypeError; older ones make any object that the file "
    "asks for, with whatever its constructor does.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    anchors=("yaml",),
    clauses=("bandit B506", "ruff S506"),
    bad="config = yaml.load(file)",
    good="config = yaml.safe_load(file)",
    found=found,
)
