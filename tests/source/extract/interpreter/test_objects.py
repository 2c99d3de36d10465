"""Objects of classes of the workspace, and values as their declared type makes them."""

import pytest

PUB = "pub_ = create_publisher<std_msgs::msg::String>({}, 1);"
HELPER = """
struct Names { Names() : out("made") {} explicit Names(const std::string & t) : out(t) {} std::string out; };
"""


def test_a_declaration_constructs_what_is_held_by_value(node_of):
    body = 'Names one; Names two{"given"}; Names * none;\n' + "".join(
        PUB.format(f"{one}.out") for one in ("one", "two")
    )
    facts = node_of(body + PUB.format("none->out"), before=HELPER)
    assert [one.name.known for one in facts.endpoints] == ["made", "given", None]


def test_a_member_that_no_constructor_sets_is_not_known(node_of):
    (one,) = node_of(PUB.format("topic_"), members="std::string topic_;").endpoints
    assert str(one.name.holes[0].reason) == "topic_, which is not set"


def test_the_constructor_that_takes_so_many_arguments_is_meant(node_of):
    facts = node_of(PUB.format("held_.out"), members='Names held_ = Names("of a member");', before=HELPER)
    assert [one.name.known for one in facts.endpoints] == ["of a member"]


def test_a_list_in_braces_is_no_text_whose_signs_are_items(node_of):
    members = 'std::vector<std::string> ids_{"Grid"}, copies_;'
    body = 'declare_parameter("ids", ids_); for (size_t i = 0; i != ids_.size(); i++) {' + PUB.format("ids_[i]") + "}"
    facts = node_of(body, members)
    assert [one.name.known for one in facts.endpoints] == ["Grid"]
    assert str(facts.parameters[0].default) == "[Grid]"
    text = (
        'get_parameter("ids", copies_); for (size_t i = 0; i != copies_.size(); i++) {' + PUB.format("copies_[i]") + "}"
    )
    (one,) = node_of(text, members).endpoints
    assert str(one.name) == "{each of parameter ids}"


@pytest.mark.parametrize(
    "members", ["std::shared_ptr<tf2_ros::TransformListener> tf_;", "tf2_ros::TransformListener * tf_;"]
)
@pytest.mark.parametrize("first", ["", ", tf_()", ", tf_{}", ", tf_(nullptr)"])
def test_a_pointer_that_is_made_of_nothing_points_to_nothing(units, members, first):
    text = f'class A : public rclcpp::Node {{ public: A() : Node("a"){first} {{}} {members} }};'
    (facts,) = units(a_cpp="#include <tf2_ros/transform_listener.h>\n#include <rclcpp/rclcpp.hpp>\n" + text)
    assert not facts.endpoints


@pytest.mark.parametrize(
    "declared", ["tf2_ros::TransformListener * one{};", "std::unique_ptr<tf2_ros::TransformListener> one{};"]
)
def test_so_does_one_that_is_local(node_of, declared):
    assert not node_of(declared, before="#include <tf2_ros/transform_listener.h>\n").endpoints


def test_what_holds_pointers_is_no_pointer(units):
    text = """
#include <rclcpp/rclcpp.hpp>
struct Topics { Topics() : name("made") {} std::string name; std::map<std::string, std::shared_ptr<int>> all; };
class A : public rclcpp::Node { public:
  A() : Node("a"), held_() { pub_ = create_publisher<std_msgs::msg::String>(held_.name, 1); }
  Topics held_;
};
"""
    (facts,) = units(a_cpp=text)
    assert [one.name.known for one in facts.endpoints] == ["made"]


def test_lists_that_a_constructor_initialises(units):
    text = """
#include <rclcpp/rclcpp.hpp>
class A : public rclcpp::Node { public:
  A() : Node("a"), one_{"x"}, two_{"y", "z"}, copy_(one_) {
    for (auto & name : one_) { pub_ = create_publisher<std_msgs::msg::String>(name, 1); }
    for (auto & name : two_) { pub_ = create_publisher<std_msgs::msg::String>(name, 1); }
    for (auto & name : copy_) { pub_ = create_publisher<std_msgs::msg::String>("copy_" + name, 1); }
  }
  std::vector<std::string> one_, two_, copy_;
};
"""
    (facts,) = units(a_cpp=text)
    assert [one.name.known for one in facts.endpoints] == ["x", "y", "z", "copy_x"]


BASE = """
class Base { public: Base() : nh_("~") {}
  Base(const std::string & name) : nh_(name) {}
  void said(const std::string & topic) { pub_ = nh_.advertise<std_msgs::String>(topic, 1); }
  ros::NodeHandle nh_; ros::Publisher pub_; };
"""


@pytest.mark.parametrize(
    ("constructor", "name"),
    [
        ('Derived() { said("a"); }', "~/a"),
        ('Derived() : count_(1) { said("a"); }', "~/a"),
        ('Derived() : Base("other") { said("a"); }', "other/a"),
        ('Derived() : Derived(1) { said("a"); }\n explicit Derived(int count) : Base("third") {}', "third/a"),
    ],
)
def test_a_base_that_no_initialiser_names_is_constructed_by_default(units, constructor, name):
    text = "#include <ros/ros.h>\n" + BASE + f"class Derived : public Base {{ public: {constructor} int count_; }};\n"
    text += 'int main() { ros::init(0, 0, "n"); Derived one; }\n'
    facts = next(one for one in units(a_cpp=text) if one.unit == "main")
    assert [str(one.name) for one in facts.endpoints] == [name]


@pytest.mark.parametrize("keeps", ["node_handle_ = node_handle;", "name_ = ros::this_node::getName();"])
def test_what_is_kept_of_a_handle_or_name_is_known_though_its_function_makes_nothing(units, keeps):
    long = (
        "min_observations_per_point_ = 2; most_observations_per_point_ = 20; sensor_width_ = 640; sensor_height_ = 480;"
    )
    given = "ros::NodeHandle & node_handle" if "node_handle;" in keeps else "int sensor_of_the_camera"
    text = f"""
#include <ros/ros.h>
class Part {{ public:
  void keep({given}) {{ {long} {keeps} {long} }}
  void start() {{ pub_ = node_handle_.advertise<std_msgs::String>(name_ + "a", 1); }}
  ros::NodeHandle node_handle_; std::string name_ = "x/"; ros::Publisher pub_; }};
int main(int argc, char ** argv) {{ ros::init(argc, argv, "n"); ros::NodeHandle handle("inside"); Part part;
  part.keep({"handle" if "node_handle;" in keeps else "1"}); part.start(); }}
"""
    facts = next(one for one in units(a_cpp=text) if one.unit == "main")
    assert [str(one.name) for one in facts.endpoints] == [
        "inside/x/a" if "node_handle;" in keeps else "{full name of the node}a"
    ]


def test_a_static_member_has_the_value_of_its_definition(units):
    header = """
namespace m { class Monitor { public:
  static const std::string TOPIC; static const std::string SERVICE;
  explicit Monitor(const rclcpp::Node::SharedPtr & node);
  void start(const std::string & topic = TOPIC);
  rclcpp::Node::SharedPtr node_;
}; }
"""
    source = """
namespace m {
const std::string Monitor::TOPIC = "monitored";
const std::string Monitor::SERVICE = "monitor";
Monitor::Monitor(const rclcpp::Node::SharedPtr & node) : node_(node) {}
void Monitor::start(const std::string & topic) {
  pub_ = node_->create_publisher<std_msgs::msg::String>(topic, 1);
  serve_ = node_->create_service<std_srvs::srv::Empty>(SERVICE, nullptr);
}
}
"""
    main = """
#include <rclcpp/rclcpp.hpp>
int main() { auto node = rclcpp::Node::make_shared("n"); m::Monitor monitor(node); monitor.start(); }
"""
    (facts,) = units(m_hpp=header, m_cpp=source, main_cpp=main)
    assert [one.name.known for one in facts.endpoints] == ["monitored", "monitor"]


def test_a_constructor_calls_virtual_methods_of_its_own_class(units):
    text = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Root : public rclcpp::Node { public: Root() : Node("a") { hook(); }
  virtual void hook() { create_publisher<std_msgs::msg::String>("root", 1); } };
class A : public Root { public: A() { later(); } void later() { hook(); }
  void hook() override { create_publisher<std_msgs::msg::String>("own", 1); } };
"""
    facts = next(one for one in units(a_cpp=text) if one.unit == "A")
    assert sorted(str(one.name) for one in facts.endpoints) == ["own", "root"]


@pytest.mark.parametrize("written", ["PartPtr part{nullptr};", "PartPtr part;", "auto part = PartPtr(nullptr);"])
def test_another_name_for_a_pointer_makes_no_object(main_of, written: str):
    before = "class Part;\ntypedef Part * PartPtr;\nclass Part { public:\n"
    before += 'Part() { ros::NodeHandle n; pub = n.advertise<std_msgs::String>("part", 1); }\n'
    before += "PartPtr next{nullptr}; ros::Publisher pub; };\n"
    facts = main_of(f'{written} auto own = nh.advertise<std_msgs::String>("own", 1);', before)
    assert [str(one.name) for one in facts.endpoints] == ["own"]


def test_a_class_that_seems_to_hold_itself_ends(main_of):
    before = "struct B; struct A { B b; int x = 3; };\nstruct B { A a; };\n"
    facts = main_of('A a; auto own = nh.advertise<std_msgs::String>("own", 1);', before)
    assert [str(one.name) for one in facts.endpoints] == ["own"]
    assert not facts.unresolved
