"""Rule ``cpp.static_object``: an object that lives longer than the program."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_OBJECT = re.compile(
    r"^(?:std::)?(?:string|wstring|vector|map|set|list|deque|unordered_map|unordered_set|multimap|stringstream|ofstream|ifstream|function|thread)\b"
    r"|^(?:ros::|tf::|tf2_ros::|image_transport::|actionlib::|rclcpp::|cv::Mat\b|Eigen::)"
)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each variable of a class that is built at start."""
    for node in view.top_level:
        if node.type != "declaration" or node.has_error:
            continue
        kind, declarator = view.text(node.child_by_field_name("type")), node.child_by_field_name("declarator")
        words = [view.text(one) for one in node.children if one.type in ("type_qualifier", "storage_class_specifier")]
        if declarator is None or "constexpr" in words or "extern" in words or not _OBJECT.search(kind):
            continue
        inner = declarator.child_by_field_name("declarator") if declarator.type == "init_declarator" else declarator
        if (
            inner is None
            or inner.type not in ("identifier", "array_declarator", "qualified_identifier")
            or kind.endswith("Ptr")
        ):
            continue
        yield view.hit(
            "cpp.static_object",
            node,
            f"`{view.text(inner)}` of class {shortened(kind, 40)} outlives `main`; expected a member or a local static",
        )


RULE = FileRule(
    id="cpp.static_object",
    title="Global object of a class",
    finds="A variable at the level of a file or namespace, or a static member, of a class of the standard "
    "library or of ROS that is built when the program starts. Use `constexpr`, a function with a local "
    "static, or a member.",
    why="Objects of different files are built in no order; those that need ROS are destroyed after it is "
    "gone, and the node crashes when it is shut down.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "hicpp",
        "autosar-cpp14",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/string",
        "hicpp 3.3.1",
        "paper2016 string_constants",
        "clang-tidy cert-err58-cpp",
    ),
    bad='std::string name = "a";\n',
    good='constexpr char name[] = "a";\n',
    syntax="cpp",
    whole=True,
    in_c=False,
    found=found,
)
