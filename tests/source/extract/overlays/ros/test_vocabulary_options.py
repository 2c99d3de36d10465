"""Options that code gives nodes it makes, evaluated and put together with what launch files say."""

from pathlib import Path

import pytest

from roslens.source.extract.configuration.assemble_arguments import CommandLine
from roslens.source.extract.configuration.assemble_node import Given, assembled
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.facts.meant import Meant
from roslens.source.extract.facts.node_facts import Evidence, Inherits
from roslens.source.extract.symbolic.text import Text

OUT = 'node->create_publisher<std_msgs::msg::String>("out", 1);'
COSTMAP = Path(__file__).parents[4] / "fixtures" / "extract" / "options" / "costmap.cpp"


def others(facts):
    return [one for one in facts if one.line == 0 or one.unit in ("A", "main", "<module>")]


def made(units, body, before=""):
    text = (
        "#include <rclcpp/rclcpp.hpp>\n#include <std_msgs/msg/string.hpp>\n"
        f"{before}\nint main(int argc, char ** argv) {{ rclcpp::init(argc, argv);\n{body}\n}}"
    )
    return [one for one in units(a_cpp=text) if one.unit == "main"]


def test_a_costmap_that_a_server_makes_is_a_node_of_its_own(units):
    found = [one for one in units(a_cpp=COSTMAP.read_text()) if one.unit == "nav.Server"]
    (costmap,) = [one for one in found if str(one.name) == "local_costmap"]
    (server,) = [one for one in found if str(one.name) == "server"]
    words = " ".join(str(one) for one in costmap.arguments)
    assert words == (
        "--ros-args -r __ns:={namespace of the node that creates it}/local_costmap"
        " --ros-args -r local_costmap:__node:=local_costmap"
        " --ros-args -p use_sim_time:={parameter use_sim_time of the node that creates it}"
    )
    assert costmap.inherits is Inherits.ARGUMENTS
    assert [str(one.name) for one in costmap.endpoints] == ["costmap"]
    assert (server.arguments, server.inherits) == ((), Inherits.ALL)
    assert [str(one.name) for one in server.endpoints] == ["out"]


def test_options_that_are_set_one_by_one(units):
    (node,) = made(
        units,
        'rclcpp::NodeOptions options; options.arguments({"--ros-args", "-r", "a:=b"}).use_global_arguments(false);'
        'options.append_parameter_override("rate", 5).allow_undeclared_parameters(true);\n'
        'auto node = std::make_shared<rclcpp::Node>("a", "space", options);',
    )  # fmt: skip
    assert [str(one) for one in node.arguments] == ["--ros-args", "-r", "a:=b"]
    assert (node.global_arguments, str(node.namespace)) == (False, "space")
    assert [(str(name), str(value)) for name, value in node.settings] == [("rate", "5")]
    assert node.inherits is Inherits.NOTHING


def test_options_are_copied_and_read(units):
    found = made(
        units,
        'rclcpp::NodeOptions first; first.arguments({"--ros-args", "-r", "a:=b"});\n'
        'rclcpp::NodeOptions second(first); second.parameter_overrides({{"x", 1}}).use_global_arguments(false);\n'
        'auto node = std::make_shared<rclcpp::Node>("a", first);\n'
        'auto other = std::make_shared<rclcpp::Node>("b", second);\n'
        'auto third = std::make_shared<rclcpp::Node>("c", other->get_node_options());\n'
        'if (second.use_global_arguments()) { node->create_publisher<std_msgs::msg::String>("no", 1); }',
    )  # fmt: skip
    told = {
        str(one.name): (len(one.arguments), len(one.settings), one.global_arguments, len(one.endpoints))
        for one in found
    }
    assert told == {"a": (3, 0, True, 0), "b": (3, 1, False, 0), "c": (3, 1, False, 0)}


def test_options_that_are_not_known_leave_a_doubt(units):
    (node,) = made(
        units,
        "rclcpp::NodeOptions options; options.arguments(read_words()).use_global_arguments(asked());\n"
        'auto node = std::make_shared<rclcpp::Node>("a", options);',
    )
    assert ["may differ" in reason for _, reason in node.unresolved] == [True, True]


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("options", Inherits.ALL),
        ("rclcpp::NodeOptions()", Inherits.NOTHING),
        ("rclcpp::NodeOptions().arguments(options.arguments())", Inherits.ARGUMENTS),
        ("rclcpp::NodeOptions(options).arguments({})", Inherits.PARAMETERS),
    ],
)
def test_what_a_component_passes_on(units, given, expected):
    text = (
        "#include <rclcpp/rclcpp.hpp>\nclass A : public rclcpp::Node { public: explicit A(rclcpp::NodeOptions options) "
        f': Node("a", options) {{ inner_ = std::make_shared<rclcpp::Node>("inner", {given}); }} }};'
    )
    (inner,) = [one for one in units(a_cpp=text) if str(one.name) == "inner"]
    assert inner.inherits is expected


def test_options_of_rclpy(units):
    text = (
        "import rclpy\nrclpy.init()\n"
        "a = rclpy.create_node('a', namespace='ns', cli_args=['--ros-args', '-r', 'x:=y'])\n"
        "b = rclpy.create_node('b', use_global_arguments=False)\n"
        "def main():\n    rclpy.init()\n"
        "    a = rclpy.create_node('a', namespace='ns', cli_args=['--ros-args', '-r', 'x:=y'])\n"
        "    b = rclpy.create_node('b', use_global_arguments=False)\n"
        "if __name__ == '__main__':\n    main()\n"
    )
    found = [one for one in units(a_py=text) if one.name.parts]
    told = {str(one.name): (len(one.arguments), one.global_arguments, str(one.namespace)) for one in found}
    assert told == {"a": (3, True, "ns"), "b": (0, False, "")}


def test_signs_of_a_name_are_replaced(node_of, names):
    body = (
        'std::string name = "a/b/" + declare_parameter("of", "c/d");'
        "std::replace(name.begin(), name.end(), '/', '_');"
        "std::string known = \"a/b\"; std::replace(known.begin(), known.end(), '/', '_');\n"
        "create_publisher<std_msgs::msg::String>(name, 1); create_publisher<std_msgs::msg::String>(known, 1);"
    )
    facts = node_of(body)
    first, second = facts.endpoints
    assert (first.name.usual, second.name.known) == ("a_b_c_d", "a_b")
    assert first.name.holes[0].parameter == ""


LISTENER = """
#include <rclcpp/rclcpp.hpp>
#include <tf2_ros/transform_listener.h>
#include <tf2_ros/transform_broadcaster.h>
class A : public rclcpp::Node {
public:
  A() : Node("a"), buffer_(get_clock()), listener_(buffer_), sender_{*this} {}
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  tf2_ros::TransformBroadcaster sender_;
};
"""


def test_a_listener_to_transforms_without_a_node_is_one_itself(units):
    node, listener = sorted((one for one in units(a_cpp=LISTENER) if one.unit == "A"), key=lambda one: one.number)
    assert [(str(one.name), one.evidence.line) for one in node.endpoints] == [("/tf", 7)]
    assert listener.name.pattern == "transform_listener_impl_*"
    assert [(str(one.name), one.role.value, one.evidence.line) for one in listener.endpoints] == [
        ("/tf", "subscription", 7),
        ("/tf_static", "subscription", 7),
    ]


def test_what_is_made_where_it_is_declared_has_a_line(units):
    text = (
        "#include <ros/ros.h>\n#include <tf/transform_broadcaster.h>\n"
        "class A {\n  tf::TransformBroadcaster sender_;\n};\n"
        'int main(int argc, char ** argv) {\n  ros::init(argc, argv, "a");\n  ros::NodeHandle nh;\n  A a;\n'
        "  tf::TransformBroadcaster other;\n}"
    )
    (node,) = [one for one in units(a_cpp=text) if one.unit == "main"]
    assert [one.evidence.line for one in node.endpoints] == [4, 10]


@pytest.mark.parametrize(
    ("options", "declares"),
    [
        ("rclcpp::NodeOptions().automatically_declare_parameters_from_overrides(true)", True),
        ("rclcpp::NodeOptions().automatically_declare_parameters_from_overrides(false)", False),
        ("rclcpp::NodeOptions().automatically_declare_parameters_from_overrides(ask())", False),
        ("rclcpp::NodeOptions().allow_undeclared_parameters(true)", False),
    ],
)
def test_whether_a_node_declares_what_is_set_for_it(units, options, declares):
    (node,) = made(units, f'auto node = std::make_shared<rclcpp::Node>("a", {options});')
    assert node.declares_set is declares


def test_a_class_that_declares_what_is_set_for_it(units):
    text = """
#include <rclcpp/rclcpp.hpp>
class A : public rclcpp::Node { public: explicit A(const rclcpp::NodeOptions & options) : Node("a", changed(options)) {}
  static rclcpp::NodeOptions changed(rclcpp::NodeOptions options) {
    options.automatically_declare_parameters_from_overrides(true);
    return options;
  }
};
"""
    (node,) = units(a_cpp=text)
    assert (node.declares_set, node.inherits) == (True, Inherits.ALL)


def test_a_node_of_rclpy_that_declares_what_is_set_for_it(units):
    text = """
from rclpy.node import Node
class A(Node):
    def __init__(self):
        super().__init__('a', allow_undeclared_parameters=True, automatically_declare_parameters_from_overrides=True)
        self.declare_parameter('b', 1)
"""
    (node,) = units(a_py=text)
    assert (node.declares_set, node.arguments, len(node.parameters)) == (True, (), 1)


@pytest.mark.parametrize(
    ("made_by", "reason"),
    [
        ('std::make_shared<rclcpp::Node>("a", read_options())', "its options are {result of read_options()}"),
        ('std::make_shared<rclcpp::Node>("a", "ns", read_options())', "its options are {result of read_options()}"),
        (
            'std::make_shared<rclcpp::Node>("a", rclcpp::NodeOptions().arguments(read_words()))',
            "its arguments are {result of read_words()}",
        ),
        ('std::make_shared<rclcpp::Node>("a", rclcpp::NodeOptions())', ""),
        ('std::make_shared<rclcpp::Node>("a", "ns")', ""),
    ],
)
def test_options_that_nobody_knows_put_names_in_doubt(units, made_by, reason):
    (node,) = made(units, f"auto node = {made_by}; {OUT}")
    assert node.doubt == reason
    assert bool(node.unresolved) is bool(reason)
    launched = Launched(Text.of("p"), Text.of("e"), Evidence("a.launch.xml", 3))
    given = Given(launched, CommandLine(), "ros2")
    configured, _ = assembled(given, node, Meant((node,)))
    (endpoint,) = [one for one in configured.endpoints if not one.implicit]
    assert (endpoint.proof.sure, configured.proof.sure) == (("likely",) * 2 if reason else ("certain",) * 2)
