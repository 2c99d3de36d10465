"""Rule ``node.parameter_type_as_default``: a parameter whose default is the number of its type."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, template_argument
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_NUMBER = re.compile(r"(?:std::)?(?:bool|int|unsigned|unsigned int|long|long long|double|float|size_t|u?int\d+_t)")
_TYPE = re.compile(r"(?:\w+::)*PARAMETER_[A-Z_]+")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a declaration of a number with an enumerator of ``ParameterType`` as its default."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or len(given) < 2 or not _TYPE.fullmatch(view.text(given[1])):
        return
    of = template_argument(call, view)
    if not _NUMBER.fullmatch(of):
        return
    name, kind = view.text(given[0]), view.text(given[1])
    yield view.hit(
        "node.parameter_type_as_default",
        call,
        f"`{view.short(call, 90)}` has the number of `{kind}` as the default of {name}; expected a value, or "
        f"`declare_parameter({name}, {kind})`, which has none",
    )


RULE = FileRule(
    id="node.parameter_type_as_default",
    title="Number of a type as the default of a parameter",
    finds="`declare_parameter<double>(name, rclcpp::PARAMETER_DOUBLE)`: with the type in angle brackets the second "
    "argument is the default, and the enumerator a number. Without them it is the type of a parameter that has to be "
    "set.",
    why="`PARAMETER_DOUBLE` is 3: where the file of parameters is missing, an arm is 3 m long and a speed 3 m/s.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("parameters",),
    bad="#include <rclcpp/rclcpp.hpp>\n"
    'void f(rclcpp::Node & node) { node.declare_parameter<double>("reach", rclcpp::PARAMETER_DOUBLE); }\n',
    good="#include <rclcpp/rclcpp.hpp>\n"
    'void f(rclcpp::Node & node) { node.declare_parameter("reach", rclcpp::PARAMETER_DOUBLE); }\n',
    syntax="cpp",
    anchors=("declare_parameter",),
    mentions=RCLCPP,
    found=found,
)
