"""Rule ``node.parameter_default_none_python``: parameters declared with None for their value and type, in rclpy."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_NOT_SET = ("Parameter.Type.NOT_SET", "ParameterType.PARAMETER_NOT_SET", "rclpy.Parameter.Type.NOT_SET")
_LISTS = ("list", "tuple", "list_comprehension", "generator_expression")
_EXPECTED = "expected a default value, `Parameter.Type.…`, or a descriptor with `dynamic_typing=True`"


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each declared parameter whose static type would be that of None."""
    call = call_at(node)
    if call is None:
        return
    if view.text(node) == "declare_parameter":
        given, named = arguments(call), keywords(call, view)
        value = given[1] if len(given) > 1 else named.get("value")
        descriptor = given[2] if len(given) > 2 else named.get("descriptor")
        # Without a descriptor rclpy takes it for a declaration by name alone.
        if value is not None and descriptor is not None and _is_refused(value, descriptor, view):
            yield _hit(call, view)
        return
    for one in _declared(call, view):
        items = [each for each in one.named_children if each.type != "comment"]
        descriptor = items[2] if len(items) > 2 else None
        if len(items) in (2, 3) and _is_refused(items[1], descriptor, view):
            yield _hit(one, view)


def _declared(call: Node, view: FileView) -> Iterator[Node]:
    """Yield the tuples that say which parameters a call of ``declare_parameters`` declares."""
    given, named = arguments(call), keywords(call, view)
    listed = given[1] if len(given) > 1 else named.get("parameters")
    for value in python_functions(view).values(listed) if listed is not None else ():
        if value.type in _LISTS:
            yield from (one for one in value.named_children if one.type in ("tuple", "list"))


def _is_refused(value: Node, descriptor: Node | None, view: FileView) -> bool:
    values = python_functions(view).values(value) if value.type in ("identifier", "attribute") else (value,)
    texts = {view.text(one) for one in values} | {view.text(value)}
    if not (values and all(one.type == "none" for one in values)) and texts.isdisjoint(_NOT_SET):
        return False
    if descriptor is None or descriptor.type == "none":
        return True
    made = python_functions(view).values(descriptor)
    is_plain = bool(made) and all(one.type == "call" and "**" not in keywords(one, view) for one in made)
    if not is_plain or (descriptor.type != "call" and b"dynamic_typing" in view.words):
        return False
    return not any("dynamic_typing" in keywords(one, view) for one in made)


def _hit(node: Node, view: FileView) -> Hit:
    return view.hit(
        "node.parameter_default_none_python",
        node,
        f"`{view.short(node)}` declares a parameter with None, and with that the type NOT_SET: rclpy raises a "
        f"ValueError since Galactic; {_EXPECTED}",
    )


RULE = FileRule(
    id="node.parameter_default_none_python",
    title="Parameter declared with a default that is no value (rclpy)",
    finds="`declare_parameters` with None for the value of a parameter, or `declare_parameter` with None and a "
    "descriptor. Give a default, its type (`Parameter.Type.DOUBLE`), or a descriptor with `dynamic_typing=True`.",
    why="Parameters have one type for good since ROS 2 Galactic, and the type of None is NOT_SET: rclpy refuses the "
    "declaration, or any value that a parameter file sets. Foxy accepts both.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters",),
    bad="import rclpy\nself.declare_parameters('', [('radius', None), ('track', None)])\n",
    good="import rclpy\nself.declare_parameters('', [('radius', 0.1), ('track', Parameter.Type.DOUBLE)])\n",
    syntax="python",
    anchors=("declare_parameters", "declare_parameter"),
    mentions=RCLPY,
    found=found,
)
