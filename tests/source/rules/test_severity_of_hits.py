"""Where a rule is less sure than its severity says, its hit is a note."""

import pytest

from roslens.model.finding import Severity
from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import match_file
from roslens.source.settings import MacroSettings

CPP = (
    "#include <rclcpp/rclcpp.hpp>\nvoid A::f() {{\n  sensor_msgs::msg::{0} m;\n  m.{1} = 1;\n  pub_->publish(m);\n}}\n"
)
PYTHON = "import rclpy\ndef f(self):\n    m = {0}()\n    m.{1} = 1\n    self.pub.publish(m)\n"

LATE = """import rospy
class Sensor:
    def __init__(self):
        self.handle = rospy.{0}
        {1}
        self.scale = 2
    def read(self, message):
        return self.scale
"""
CLOCK = "#include <rclcpp/rclcpp.hpp>\nvoid f() {{ {0} = std::chrono::system_clock::now(); }}\n"
TIMER, HEARD = "Timer(rospy.Duration(1), self.read)", "Subscriber('a', String, self.read)"
RATE = "import rospy\nwhile not done():\n    {0}(10).sleep()\n"


@pytest.mark.parametrize(
    ("rule", "language", "text", "severity"),
    [
        ("node.stamp_missing", Language.CPP, CPP.format("Range", "range"), None),
        ("node.stamp_missing", Language.CPP, CPP.format("JointState", "position"), Severity.NOTE),
        ("node.stamp_missing_python", Language.PYTHON, PYTHON.format("Range", "range"), None),
        ("node.stamp_missing_python", Language.PYTHON, PYTHON.format("JointState", "position"), Severity.NOTE),
        ("cpp.swallowed", Language.CPP, "void f() { try { g(); } catch (...) { } }\n", None),
        ("cpp.swallowed", Language.CPP, "void f() { try { a = g(); } catch (...) { } }\n", Severity.NOTE),
        ("cpp.swallowed", Language.CPP, "void f() { try { a = g(); h(a); } catch (...) { } }\n", None),
        ("cpp.swallowed", Language.CPP, "void f() { try { a = g(); ROS_WARN(a); } catch (...) { } }\n", Severity.NOTE),
        ("cpp.swallowed", Language.CPP, "void f() { try { ROS_WARN(a); } catch (...) { } }\n", None),
        ("node.credential", Language.CPP, 'const char * key = "AKIAABCDEFGHIJKLMNOP";\n', None),
        ("python.python2_name", Language.PYTHON, "known = {}\nknown.has_key(1)\n", None),
        ("python.python2_name", Language.PYTHON, "self.known.has_key(1)\n", Severity.NOTE),
        ("cpp.using_namespace", Language.CPP, "using namespace std;\n", None),
        ("cpp.using_namespace", Language.CPP, "using namespace std::placeholders;\n", Severity.NOTE),
        ("cpp.self_assignment", Language.CPP, "void f(int a) { g(a) ? a = 0 : a = a; }\n", Severity.NOTE),
        ("cpp.self_assignment", Language.CPP, "void f(int a) { a = a; }\n", None),
        ("node.attribute_after_subscriber", Language.PYTHON, LATE.format(TIMER, "self.a = 1"), Severity.NOTE),
        ("node.attribute_after_subscriber", Language.PYTHON, LATE.format(TIMER, "self.a = look()"), None),
        ("node.attribute_after_subscriber", Language.PYTHON, LATE.format(HEARD, "self.a = 1"), None),
        ("node.system_time", Language.CPP, CLOCK.format("message.header.stamp"), None),
        ("node.system_time", Language.CPP, CLOCK.format("const auto start_timestamp"), Severity.NOTE),
        ("node.rate_in_loop_python", Language.PYTHON, RATE.format("rospy.Rate"), Severity.NOTE),
        ("node.rate_in_loop_python", Language.PYTHON, RATE.format("node.create_rate"), None),
        ("node.credential", Language.CPP, 'const char * password = "r0bot-4711";\n', Severity.NOTE),
    ],
)
def test_it_is_a_note(rule, language, text, severity):
    matched = match_file(parse_file(text.encode(), language, MacroSettings()).view(), frozenset({rule}))
    assert [(one.rule, one.severity) for one in matched.hits] == [(rule, severity)]
