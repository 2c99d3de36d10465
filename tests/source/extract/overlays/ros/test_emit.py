import pytest

from roslens.source.extract.domain.abstract_value import Obj, Unknown
from roslens.source.extract.facts.node_facts import Sure
from roslens.source.extract.overlays.ros.emit import sure_of, value_text
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import IsTrue, Text, unknown


@pytest.mark.parametrize(
    ("name", "receiver", "sure"),
    [
        (Text.of("a"), Obj("rclcpp.Node"), Sure.CERTAIN),
        (Text.of("a"), None, Sure.LIKELY),
        (Text.of("a"), Unknown("whose"), Sure.LIKELY),
        (unknown(OfParameter("t"), default="x"), Obj("rclcpp.Node"), Sure.LIKELY),
        (unknown(OfParameter("t")), Obj("rclcpp.Node"), Sure.POSSIBLE),
        (unknown(OfParameter("t")), Unknown("whose"), Sure.POSSIBLE),
    ],
)
def test_how_sure_a_name_is(name, receiver, sure):
    assert sure_of(name, receiver) is sure


@pytest.mark.parametrize(
    ("value", "written"),
    [
        ([Text.of("left"), Text.of("right")], "[left, right]"),
        ([1.0, 2, True], "[1.0, 2, true]"),
        ([], "[]"),
        ([Text()], "['']"),
        ([[1, 2], [3]], "[[1, 2], [3]]"),
        ([Text.of("a"), Unknown("who knows")], None),
        (Text.of("a"), "a"),
    ],
)
def test_values_of_parameters_as_text(value, written):
    assert value_text(value).known == written


def test_a_list_is_the_default_of_a_parameter(units):
    text = 'import rospy\nrospy.init_node("a")\nrospy.get_param("~joints", ["left", "right"])\n'
    (found,) = units(a_py=text)
    assert [(one.type, one.default and one.default.known) for one in found.parameters] == [
        ("string_array", "[left, right]")
    ]


def test_a_name_that_is_empty_is_not_set(node_of):
    (one,) = node_of('pub_ = create_publisher<std_msgs::msg::String>("", 1);').endpoints
    assert str(one.name) == "{a name that is not set}"
    assert one.evidence.sure is Sure.POSSIBLE


def test_a_parameter_gives_what_was_declared(node_of):
    body = 'declare_parameter("t", "topic");\nstd::string t = get_parameter("t").as_string();\n'
    facts = node_of(body + "pub_ = create_publisher<std_msgs::msg::String>(t, 1);")
    (one,) = facts.endpoints
    assert (one.name.usual, one.name.holes[0].parameter, one.evidence.sure) == ("topic", "t", Sure.LIKELY)
    assert one.evidence.how == "parameter t"
    assert [(str(p.name), p.access, p.type, p.default and p.default.known) for p in facts.parameters] == [
        ("t", "declared", "string", "topic"),
        ("t", "read", "string", None),
    ]


def test_a_timer(node_of):
    facts = node_of("timer_ = create_wall_timer(std::chrono::milliseconds(500), [this]() {});")
    assert [one.period_s for one in facts.timers] == [0.5]


ADAPTED = "#include <std_msgs/msg/string.hpp>\n#include <rclcpp/type_adapter.hpp>"


def types(facts):
    return [str(one.type) for one in facts.endpoints]


def test_a_type_that_is_adapted_is_that_of_the_message(node_of):
    members = "using Own = rclcpp::TypeAdapter<std::string, std_msgs::msg::String>;"
    assert types(node_of('create_publisher<Own>("a", 1);', members, ADAPTED)) == ["std_msgs/msg/String"]
    before = f"{ADAPTED}\nRCLCPP_USING_CUSTOM_TYPE_AS_ROS_MESSAGE_TYPE(own::Text, std_msgs::msg::String);"
    assert types(node_of('create_publisher<own::Text>("a", 1);', "", before)) == ["std_msgs/msg/String"]


def test_a_class_is_no_interface(node_of):
    assert types(node_of('create_publisher<own::Text>("a", 1);')) == ["{the type own::Text}"]


def test_a_type_of_a_module_that_is_used_whole(units):
    text = "import rospy\nfrom std_msgs.msg import *\nfrom p.srv import *\nrospy.init_node('a')\n"
    text += "rospy.Publisher('x', String, queue_size=1)\nrospy.Service('y', Ask, print)\n"
    (facts,) = units(a_py=text)
    assert types(facts) == ["std_msgs/String", "p/Ask"]


def test_a_type_of_the_namespace_that_the_package_includes(units):
    header = "#include <own/Pose.h>\n"
    text = (
        '#include <ros/ros.h>\n#include "b.h"\nnamespace own { class A { public: A() { ros::NodeHandle nh;'
        ' pub_ = nh.advertise<Pose>("x", 1); } ros::Publisher pub_; }; }\n'
        'int main(int argc, char ** argv) { ros::init(argc, argv, "a"); own::A a; }'
    )
    found = [one for one in units(a_cpp=text, b_h=header) if one.unit == "main"]
    assert types(found[0]) == ["own/Pose"]


@pytest.mark.parametrize(
    ("argument", "before", "kind"),
    [
        ("const ros::MessageEvent<std_msgs::String const> & e", "", "std_msgs/String"),
        ("const ros::MessageEvent<ShapeShifter>& e", "using namespace topic_tools;", "topic_tools/ShapeShifter"),
        (
            "const StringConstPtr& m",
            "typedef boost::shared_ptr<std_msgs::String const> StringConstPtr;",
            "std_msgs/String",
        ),
        ("const StringConstPtr m", "using StringConstPtr = std_msgs::String::ConstPtr;", "std_msgs/String"),
        ("const Text& m", "typedef std_msgs::String Text;", "std_msgs/String"),
    ],
)
def test_the_type_of_a_subscription_by_what_its_callback_takes(units, argument, before, kind):
    text = (
        "#include <ros/ros.h>\n#include <std_msgs/String.h>\nnamespace topic_tools { class ShapeShifter {}; }\n"
        f"{before}\nvoid heard({argument}) {{}}\nint main(int argc, char ** argv) {{\n"
        'ros::init(argc, argv, "a"); ros::NodeHandle nh; auto s = nh.subscribe("a", 1, heard); }'
    )
    found = next(one for one in units(a_cpp=text) if one.unit == "main")
    assert [one.type.known for one in found.endpoints] == [kind]


def test_types_by_a_namespace_and_by_names_of_a_base(units):
    base = """
namespace base {
template<typename T> class Base : public rclcpp::Node {
public:
  typedef sensor_msgs::msg::PointCloud2 Cloud;
  using Image = sensor_msgs::msg::Image;
  Base() : Node("base") {}
};
class Middle : public Base<int> {};
}
"""
    text = """
#include <rclcpp/rclcpp.hpp>
#include <demo_msgs/msg/the_command.hpp>
using namespace demo_msgs::msg;
class Derived : public base::Middle {
public:
  Derived() {
    a_ = create_publisher<Cloud>("a", 1); b_ = create_publisher<Image>("b", 1);
    c_ = create_publisher<TheCommand>("c", 1); d_ = create_publisher<Missing>("d", 1);
  }
};
"""
    facts = next(one for one in units(base_hpp=base, a_cpp=text) if one.unit == "Derived")
    assert [(str(one.name), one.type.known) for one in facts.endpoints] == [
        ("a", "sensor_msgs/msg/PointCloud2"),
        ("b", "sensor_msgs/msg/Image"),
        ("c", "demo_msgs/msg/TheCommand"),
        ("d", None),
    ]


def test_what_is_made_at_one_place_under_several_conditions(node_of):
    members = 'void make() { pub_ = create_publisher<std_msgs::msg::String>("a", 1); }'

    def conditions(body):
        (one,) = node_of(body, members).endpoints
        return as_written(one.conditions)

    assert conditions("if (x()) { make(); } else { make(); }") == ()
    assert conditions("if (x()) { make(); } if (y()) { make(); }") == ("x() or y()",)
    assert conditions("if (x()) { make(); } make();") == ()
    assert conditions("if (x()) { make(); if (y()) { make(); } }") == ("x()",)
    assert conditions("if (x()) { if (y()) { make(); } if (z()) { make(); } }") == ("x()", "y() or z()")


def test_conditions_that_parameters_decide_are_kept(node_of):
    body = 'bool on = declare_parameter("on", true); if (on && read()) {} if (on) {'
    (one,) = node_of(body + 'pub_ = create_publisher<std_msgs::msg::String>("a", 1); }').endpoints
    assert [(str(condition), type(test)) for condition, test in one.asked] == [("on", IsTrue)]
