"""Rule ``node.lifecycle_override``: a transition that may override nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.edits.override_edits import override_edits
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_SIGNATURE = re.compile(r"\(\s*const (?:rclcpp_lifecycle::)?State ?&[^,]*\)$")
_TRANSITIONS = ("on_configure", "on_activate", "on_deactivate", "on_cleanup", "on_shutdown", "on_error")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a transition declared in a class that derives, without ``override``, ``final`` or ``virtual``."""
    declarator = node.parent
    if declarator is None or declarator.type != "function_declarator" or node.type != "field_identifier":
        return
    member, of_class = declarator.parent, above(node, "class_specifier", "struct_specifier")
    if member is None or of_class is None or member.type not in ("field_declaration", "function_definition"):
        return
    bases = next((one for one in of_class.children if one.type == "base_class_clause"), None)
    if bases is None or "Lifecycle" not in view.text(bases) or "State" not in view.text(declarator):
        return
    head = view.text(declarator)
    if " override" in head or " final" in head or view.text(member).startswith("virtual "):
        return
    yield view.hit(
        "node.lifecycle_override",
        declarator,
        f"`{view.text(node)}` without `override`: with a parameter of another type it is never called; expected "
        "`override`",
        edits=override_edits(member, declarator, view) if _SIGNATURE.search(head) and _is_node(bases, view) else (),
    )


def _is_node(bases: Node, view: FileView) -> bool:
    return "LifecycleNode" in view.text(bases)


RULE = FileRule(
    id="node.lifecycle_override",
    title="Transition of a lifecycle node without override",
    finds="`on_configure` and its like declared in a lifecycle node without `override`. Add it.",
    why="A transition whose signature is a little off overrides nothing: the base class answers «success», and the "
    "node is "
    "active without its hardware.",
    consequence=Consequence.WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2",),
    tags=("lifetime",),
    clauses=("core-guidelines C.128",),
    fix="Adds `override` where the base is a `LifecycleNode` and the only parameter a `const State &`.",
    bad="class Arm : public rclcpp_lifecycle::LifecycleNode { Return on_configure(const State & state); };\n",
    good="class Arm : public rclcpp_lifecycle::LifecycleNode { Return on_configure(const State & state) override; };\n",
    syntax="cpp",
    anchors=_TRANSITIONS,
    mentions=("Lifecycle",),
    spares_tests=True,
    found=found,
)
