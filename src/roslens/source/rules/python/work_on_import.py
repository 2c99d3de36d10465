"""Rule ``python.work_on_import``: importing the module starts a node."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_STARTS = frozenset({"rospy.init_node", "rospy.spin", "rclpy.init", "rclpy.spin"})
_HIDES = ("function_definition", "class_definition", "if_statement", "lambda")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first call at the top of a module that starts a node."""
    attribute = node.parent
    call = attribute.parent if attribute is not None else None
    if attribute is None or call is None or call.type != "call" or view.text(attribute) not in _STARTS:
        return
    if call.child_by_field_name("function") != attribute or above(call, *_HIDES) is not None:
        return
    earlier = view.code[: call.start_byte]
    if re.search(rb"^(?:\w+\s*=\s*)?(?:rospy\.init_node|rclpy\.init)\(", earlier, re.MULTILINE) is None:
        expected = "if __name__ == '__main__'"
        message = f"{view.text(attribute)}() runs when the module is imported; expected it below {expected}"
        yield view.hit("python.work_on_import", call, message)


RULE = FileRule(
    id="python.work_on_import",
    title="Node that starts when its module is imported",
    finds="`rospy.init_node`, `rclpy.init` or `spin` at the top of a module, outside of functions and of `if "
    '__name__ == "__main__"`. The first of a file is reported.',
    why="Tests, documentation and every tool that imports the module start the node, and wait in it.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    anchors=("init_node", "spin", "rclpy.init"),
    bad='rospy.init_node("driver")\nrospy.spin()',
    good='def main():\n    rospy.init_node("driver")\n    rospy.spin()\n\n\nif __name__ == "__main__":\n    main()',
    found=found,
)
