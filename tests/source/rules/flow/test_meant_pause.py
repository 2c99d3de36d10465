"""Pauses that are meant, by what stands beside them."""

from __future__ import annotations

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.calls import call_at
from roslens.source.rules.flow.meant_pause import is_meant
from roslens.source.settings import MacroSettings

PYTHON = """
class {name}(Node):
    def on_goal(self, goal):
        self.stop()
        {before}
        time.sleep(2){beside}
        {after}
"""
CPP = """
void {name}::on_goal(const Goal & goal) {{
  stop();
  {before}
  std::this_thread::sleep_for(2s);{beside}
  {after}
}}
"""


def meant(code: str, language: Language, **parts: str) -> bool:
    given = {"name": "Arm", "before": "", "beside": "", "after": "", **parts}
    view = parse_file(code.format(**given).encode(), language, MacroSettings()).view()
    word = b"sleep" if language is Language.PYTHON else b"sleep_for"
    at = view.source.index(b"." + word if language is Language.PYTHON else b"::" + word) + len(b".")
    at = view.source.index(word, at)
    node = view.node_at(at, at + len(word))
    assert node is not None
    call = call_at(node)
    assert call is not None
    return is_meant(call, view)


@pytest.mark.parametrize(
    ("parts", "is_one"),
    [
        ({}, False),
        ({"beside": "  # let the arm settle"}, True),
        ({"beside": "  # Make sure the robot moved"}, True),
        ({"beside": "  # noqa"}, False),
        ({"before": "# wait for the gripper\n        # to close"}, True),
        ({"before": "# open the gripper"}, False),
        ({"before": "self.get_logger().info('starting 4s work')"}, True),
        ({"before": "self.get_logger().info('goal taken')"}, False),
        ({"before": "self.wait_less = 1"}, False),
        ({"before": "self.pub.publish(turn)", "after": "self.pub.publish(stop)"}, True),
        ({"before": "self.pub.publish(turn)", "after": "self.other.publish(stop)"}, False),
        ({"before": "self.pub.publish(turn)"}, False),
        ({"before": "self.halt()", "after": "self.pub.publish(a); self.pub.publish(b)"}, False),
        ({"after": "os.system('sudo shutdown -h now')"}, True),
        ({"after": "rclpy.shutdown()"}, True),
        ({"after": "self.exit_code = 1"}, False),
        ({"name": "TimerExample"}, True),
        ({"name": "Sampler"}, False),
    ],
)
def test_what_tells_in_python(parts: dict[str, str], is_one: bool) -> None:
    assert meant(PYTHON, Language.PYTHON, **parts) is is_one


@pytest.mark.parametrize(
    ("parts", "is_one"),
    [
        ({}, False),
        ({"beside": "  // settle"}, True),
        ({"before": "/* assume that something\n   * happens here */"}, True),
        ({"before": "// assume that something logic happens here"}, True),
        ({"before": 'RCLCPP_INFO(get_logger(), "sleeping");'}, True),
        ({"before": 'RCLCPP_INFO(get_logger(), "stopped");'}, False),
        ({"before": "pub_->publish(turn);", "after": "pub_->publish(stop);"}, True),
        ({"before": "pub_->publish(turn);", "after": "other_->publish(stop);"}, False),
        ({"after": "rclcpp::shutdown();"}, True),
        ({"after": "finish(1);"}, False),
        ({"name": "DeadLockNode"}, True),
    ],
)
def test_what_tells_in_cpp(parts: dict[str, str], is_one: bool) -> None:
    assert meant(CPP, Language.CPP, **parts) is is_one
