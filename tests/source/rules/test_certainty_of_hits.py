"""Where a rule is less certain than it says, its hit says so."""

import pytest

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import match_file
from roslens.source.settings import MacroSettings

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
AGAIN = (
    '#include <ros/ros.h>\nvoid f() {{\nros::service::call("brake", s);\n{}\n'
    'if (ros::service::call("{}", s)) report(s.response.a);\n}}\n'
)
EXECUTORS = "rclcpp::executors"
HEADER = "#include <rclcpp/rclcpp.hpp>\nvoid f({0} & one);\n"
WAIT = 'ros::service::waitForService("spawn");'
SERVICE = "#include <ros/ros.h>\nvoid f() {{ ros::ServiceClient client; {0} client.call(s); {1} }}\n"
FAILED = (
    "#include <ros/ros.h>\nvoid f() {{ ros::ServiceClient client; if (!grasp()) {{ client.call(s); {} }}"
    " drive(s.response.a); }}\n"
)
EITHER = (
    "#include <ros/ros.h>\nvoid f() {{ ros::ServiceClient client; if (near()) {{ client.call(s); {} }}"
    " else if (far()) {{ stop(); }} else {{ turn(); }} {} }}\n"
)
CATCHES = "void f() {{ try {{ g(); }} catch ({0}) {{ h(); }} }}\n"
COMPARED = "#include <rclcpp/rclcpp.hpp>\nbool f() {{ return {0} > rclcpp::Time(0); }}\n"
CLOCK = "#include <rclcpp/rclcpp.hpp>\nvoid f() {{ {0} = std::chrono::system_clock::now(); }}\n"
SPINS = '#include <ros/ros.h>\nvoid f(A a) {{ {0} }}\nvoid g() {{ handle.subscribe("a", 1, f); }}\n'
SHARED = '#include <rclcpp/rclcpp.hpp>\nArm::Arm() : Node("arm") {{ {0} }}\n'
TIMER, HEARD = "Timer(rospy.Duration(1), self.read)", "Subscriber('a', String, self.read)"
ACTION = """import time, rclpy
class Turtle(Node):
    def __init__(self):
        self.server = ActionServer(self, Move, "move", {0})
    def move(self, goal):
        time.sleep(1)
"""
OLD_NODE = "from launch_ros.actions import Node\nnode = Node(package='arm', {0}='arm', executable='arm')\n"
FORMAT = "#include <string>\n{0}\nvoid f(const std::string& given) {{ {1} printf({2}.c_str()); {3} }}\n"
UNUSED = "import rospy\n\ndef move(a, b):\n    pass\n\ndef start():\n    move(1)\n\nrospy.init_node('arm')\n{0}\n"
ASSIGNED = "void f(int a, int b) {{ if ({0}) g(); }}\n"
SEQUENCE = """import time, rclpy
class Arm(Node):
    def __init__(self):
        self.sub = self.create_subscription(Goal, "goal", self.on_goal, 10)
    def on_goal(self, goal):
        {0}
"""
RATE = "import rospy\nwhile not done():\n    {0}(10).sleep()\n"


@pytest.mark.parametrize(
    ("rule", "language", "text", "certainty"),
    [
        ("node.stamp_missing_python", Language.PYTHON, PYTHON.format("Range", "range"), None),
        ("node.stamp_missing_python", Language.PYTHON, PYTHON.format("JointState", "position"), Certainty.HEURISTIC),
        ("node.deprecated_ros2", Language.CPP, HEADER.format("rclcpp::executor::Executor"), None),
        (
            "node.deprecated_ros2",
            Language.CPP,
            HEADER.format(f"{EXECUTORS}::StaticSingleThreadedExecutor"),
            Certainty.HEURISTIC,
        ),
        ("node.spin_in_callback", Language.CPP, SPINS.format("ros::spinOnce(); take(a);"), Certainty.HEURISTIC),
        ("node.spin_in_callback", Language.CPP, SPINS.format("take(a); ros::spinOnce();"), Certainty.HEURISTIC),
        ("node.spin_in_callback", Language.CPP, SPINS.format("take(a); ros::spinOnce(); return;"), Certainty.HEURISTIC),
        ("node.spin_in_callback", Language.CPP, SPINS.format("take(a); ros::spinOnce(); clear();"), Certainty.LIKELY),
        ("node.spin_in_callback", Language.CPP, SPINS.format("take(a); ros::spin();"), Certainty.LIKELY),
        ("node.shared_in_constructor", Language.CPP, SHARED.format("take(shared_from_this());"), None),
        (
            "node.shared_in_constructor",
            Language.CPP,
            SHARED.format("try { take(shared_from_this()); } catch (const E & e) { log(e); }"),
            Certainty.HEURISTIC,
        ),
        ("node.service_result_dropped", Language.CPP, SERVICE.format("", "drive();"), None),
        ("node.service_result_dropped", Language.CPP, SERVICE.format(WAIT, "drive();"), Certainty.HEURISTIC),
        ("node.service_result_dropped", Language.CPP, SERVICE.format(WAIT, "a = s.response.a;"), None),
        ("node.service_result_dropped", Language.CPP, FAILED.format("return;"), Certainty.HEURISTIC),
        ("node.service_result_dropped", Language.CPP, FAILED.format("throw s;"), Certainty.HEURISTIC),
        ("node.service_result_dropped", Language.CPP, FAILED.format("stop();"), None),
        ("node.service_result_dropped", Language.CPP, EITHER.format("", ""), Certainty.HEURISTIC),
        ("node.service_result_dropped", Language.CPP, EITHER.format("drive();", ""), None),
        ("node.service_result_dropped", Language.CPP, EITHER.format("", "drive();"), None),
        ("node.service_result_dropped", Language.CPP, AGAIN.format("a = b();", "brake"), Certainty.HEURISTIC),
        ("node.service_result_dropped", Language.CPP, AGAIN.format("drive();", "brake"), None),
        ("node.service_result_dropped", Language.CPP, AGAIN.format("a = b();", "lamp"), None),
        ("node.mixed_clocks", Language.CPP, COMPARED.format("get_node()->now()"), None),
        ("node.mixed_clocks", Language.CPP, COMPARED.format("this->node_->get_clock()->now()"), None),
        ("node.mixed_clocks", Language.CPP, COMPARED.format("steady_clock_->now()"), Certainty.HEURISTIC),
        ("cpp.catch_by_value", Language.CPP, CATCHES.format("std::exception e"), None),
        ("cpp.catch_by_value", Language.CPP, CATCHES.format("std::runtime_error e"), Certainty.HEURISTIC),
        ("cpp.catch_by_value", Language.CPP, CATCHES.format("tf2::TransformException ex"), Certainty.HEURISTIC),
        ("cpp.swallowed", Language.CPP, "void f() { try { g(); } catch (...) { } }\n", None),
        ("cpp.swallowed", Language.CPP, "void f() { try { a = g(); } catch (...) { } }\n", Certainty.HEURISTIC),
        ("cpp.swallowed", Language.CPP, "void f() { try { a = g(); h(a); } catch (...) { } }\n", None),
        (
            "cpp.swallowed",
            Language.CPP,
            "void f() { try { a = g(); ROS_WARN(a); } catch (...) { } }\n",
            Certainty.HEURISTIC,
        ),
        ("cpp.swallowed", Language.CPP, "void f() { try { ROS_WARN(a); } catch (...) { } }\n", None),
        ("node.credential", Language.CPP, 'const char * key = "AKIAABCDEFGHIJKLMNOP";\n', None),
        ("python.python2_name", Language.PYTHON, "known = {}\nknown.has_key(1)\n", None),
        ("python.python2_name", Language.PYTHON, "self.known.has_key(1)\n", Certainty.HEURISTIC),
        ("cpp.using_namespace", Language.CPP, "using namespace std;\n", None),
        ("cpp.using_namespace", Language.CPP, "using namespace std::placeholders;\n", Certainty.HEURISTIC),
        ("node.attribute_after_subscriber", Language.PYTHON, LATE.format(TIMER, "self.a = 1"), Certainty.HEURISTIC),
        ("node.attribute_after_subscriber", Language.PYTHON, LATE.format(TIMER, "self.a = look()"), None),
        ("node.attribute_after_subscriber", Language.PYTHON, LATE.format(HEARD, "self.a = 1"), None),
        ("node.system_time", Language.CPP, CLOCK.format("message.header.stamp"), None),
        ("node.system_time", Language.CPP, CLOCK.format("const auto start_timestamp"), Certainty.HEURISTIC),
        ("node.rate_in_loop_python", Language.PYTHON, RATE.format("rospy.Rate"), Certainty.HEURISTIC),
        ("node.rate_in_loop_python", Language.PYTHON, RATE.format("node.create_rate"), None),
        ("python.argument_count", Language.PYTHON, UNUSED.format("# start()"), Certainty.HEURISTIC),
        ("python.argument_count", Language.PYTHON, UNUSED.format("start()"), None),
        ("cpp.assignment_in_condition", Language.CPP, ASSIGNED.format("a = b"), Certainty.HEURISTIC),
        ("cpp.assignment_in_condition", Language.CPP, ASSIGNED.format("a = next(b)"), Certainty.HEURISTIC),
        ("cpp.assignment_in_condition", Language.CPP, ASSIGNED.format("a = 3"), None),
        ("cpp.assignment_in_condition", Language.CPP, ASSIGNED.format("a = Mode::OPERATING"), None),
        ("node.sleep_in_callback_python", Language.PYTHON, SEQUENCE.format("time.sleep(2)"), None),
        (
            "node.sleep_in_callback_python",
            Language.PYTHON,
            SEQUENCE.format("; ".join(f"self.joint({number}); time.sleep(2)" for number in range(4))),
            Certainty.HEURISTIC,
        ),
        ("node.sleep_in_callback_python", Language.PYTHON, ACTION.format("self.move"), Certainty.HEURISTIC),
        (
            "node.sleep_in_callback_python",
            Language.PYTHON,
            ACTION.format("goal_callback=self.look, execute_callback=self.move"),
            Certainty.HEURISTIC,
        ),
        ("node.sleep_in_callback_python", Language.PYTHON, ACTION.format("self.work, goal_callback=self.move"), None),
        ("launch.unknown_keyword", Language.PYTHON, OLD_NODE.format("node_name"), Certainty.LIKELY),
        ("launch.unknown_keyword", Language.PYTHON, OLD_NODE.format("nmae"), None),
        ("node.credential", Language.CPP, 'const char * password = "r0bot-4711";\n', Certainty.HEURISTIC),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format("", 'std::string text = "stop" " now";', "text", ""),
            Certainty.HEURISTIC,
        ),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format("", 'std::string text("stop");', "text", ""),
            Certainty.HEURISTIC,
        ),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format("", 'std::string text{"stop"};', "text", ""),
            Certainty.HEURISTIC,
        ),
        ("cpp.format_string", Language.CPP, FORMAT.format("", 'std::string text = "50 %d";', "text", ""), None),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format("", 'std::string text = "stop";', "text", "text += given;"),
            None,
        ),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format("", 'std::string text = "stop"; read(text);', "text", ""),
            None,
        ),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format("", 'const std::string text = "stop"; show(text);', "text", ""),
            Certainty.HEURISTIC,
        ),
        ("cpp.format_string", Language.CPP, FORMAT.format("", "std::string text = given;", "text", ""), None),
        ("cpp.format_string", Language.CPP, FORMAT.format("", "std::string text;", "text", ""), None),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format('static const std::string TEXT = "stop";', "", "TEXT", ""),
            Certainty.HEURISTIC,
        ),
        ("cpp.format_string", Language.CPP, FORMAT.format('std::string text = "stop";', "", "text", ""), None),
        ("cpp.format_string", Language.CPP, FORMAT.format('const std::string given = "stop";', "", "given", ""), None),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format('#define TEXT "stop" " now"  // all', "", "std::string(TEXT)", ""),
            Certainty.HEURISTIC,
        ),
        ("cpp.format_string", Language.CPP, FORMAT.format('#define TEXT "stop %s"', "", "std::string(TEXT)", ""), None),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format('#define TEXT "stop"\n#undef TEXT\n#define TEXT "%s"', "", "std::string(TEXT)", ""),
            None,
        ),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format('constexpr char TEXT[] = "stop";', "", '(std::string(TEXT) + " now")', ""),
            Certainty.HEURISTIC,
        ),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format('const char* TEXT = "stop";', "", "std::string(TEXT)", ""),
            None,
        ),
        ("cpp.format_string", Language.CPP, FORMAT.format("", "", '(std::string("stop") + given)', ""), None),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format('const std::string TEXT = "stop";', "for (auto TEXT : all()) {", "TEXT", "}"),
            None,
        ),
        (
            "cpp.format_string",
            Language.CPP,
            FORMAT.format('const std::string TEXT = "stop";', "auto g = [](const std::string& TEXT) {", "TEXT", "};"),
            None,
        ),
    ],
)
def test_it_is_a_note(rule, language, text, certainty):
    matched = match_file(parse_file(text.encode(), language, MacroSettings()).view(), frozenset({rule}))
    assert {(one.rule, one.certainty) for one in matched.hits} == {(rule, certainty)}
