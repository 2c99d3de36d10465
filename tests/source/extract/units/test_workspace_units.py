"""Units of a workspace, on small programs."""

from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.ir.makes_endpoints import MAKE, STEMS, makes_endpoints
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.symbols.call_sites import without_endpoint
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.units.workspace_units import facts_of_workspace, unreached
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()


def index_of(*files):
    programs = {}
    for path, text in files:
        lower = program_of_python if path.endswith(".py") else lambda content: program_of_cpp(content, MACROS)
        programs[path] = lower(text.encode())
    return indexed(programs)


def facts_of(*files):
    return facts_of_workspace(index_of(*files))


NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Talker : public rclcpp::Node {
public:
  Talker() : Node("talker") { pub_ = create_publisher<std_msgs::msg::String>("chatter", 10); }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
"""
LOADED = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Listener {
public:
  void start(rclcpp::Node::SharedPtr node) {
    sub_ = node->create_subscription<std_msgs::msg::String>("heard", 10, [](std_msgs::msg::String::SharedPtr) {});
  }
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr sub_;
};
"""
TREE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Ask : public BT::SyncActionNode {
public:
  Ask(const std::string & name, const std::string & topic, const BT::NodeConfiguration & conf)
  : BT::SyncActionNode(name, conf)
  {
    auto node = config().blackboard->get<rclcpp::Node::SharedPtr>("node");
    pub_ = node->create_publisher<std_msgs::msg::String>(topic, 1);
  }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
BT_REGISTER_NODES(factory)
{
  BT::NodeBuilder builder = [](const std::string & name, const BT::NodeConfiguration & config)
    { return std::make_unique<Ask>(name, "asked", config); };
  factory.registerBuilder<Ask>("Ask", builder);
}
"""


def test_a_node_and_a_class_that_nobody_makes():
    found = facts_of(("p/talker.cpp", NODE), ("p/listener.cpp", LOADED))
    told = [(one.unit, one.kind, [str(end.name) for end in one.endpoints]) for one in found]
    assert told == [("Listener", "plugin", ["heard"]), ("Talker", "node", ["chatter"])]


def test_a_class_that_a_node_makes_is_no_unit_of_its_own():
    using = NODE.replace("};", "  Listener listener_;\n};").replace("{ pub_ =", "{ listener_.start(this); pub_ =")
    found = facts_of(("p/talker.cpp", LOADED + using))
    assert [(one.unit, [str(end.name) for end in one.endpoints]) for one in found] == [("Talker", ["heard", "chatter"])]


def test_nodes_of_behaviour_trees_are_made_as_they_are_registered():
    (found,) = facts_of(("p/ask.cpp", TREE))
    assert (found.unit, found.kind, found.generation) == ("Ask", "plugin", "ros2")
    assert [str(one.name) for one in found.endpoints] == ["asked"]


def test_what_is_reached_is_not_unreached():
    index = indexed({"p/listener.cpp": program_of_cpp(LOADED.encode(), MACROS)})
    (only,) = unreached(index, set())
    start = next(one for one in index.programs["p/listener.cpp"].functions if one.name == "start")
    assert only.what.name == "Listener"
    assert makes_endpoints(start)
    assert list(unreached(index, {("p/listener.cpp", start.line)})) == []


FAR = """
#include <ros/ros.h>
namespace far {
void reset(ros::NodeHandle & nh) { nh.advertise<std_msgs::Empty>("reset", 1); }
void ask(ros::NodeHandle & nh) { nh.serviceClient<std_srvs::Empty>("ask"); }
void count(int) {}
template<class T> void offer(ros::NodeHandle & nh) { nh.advertise<T>("offered", 1); }
ros::Publisher advertise(ros::NodeHandle & nh, std::string name) { return nh.advertise<std_msgs::Empty>(name, 1); }
}
TEST(Far, away) { ros::NodeHandle nh; nh.subscribe("tested", 1, heard); }
int main(int argc, char ** argv) {
  ros::init(argc, argv, "far");
  ros::NodeHandle nh;
  far::ask(nh);
}
"""


def test_functions_that_nothing_calls_are_units_of_their_own():
    index = index_of(("far/far.cpp", FAR))
    reached = Reached()
    facts = facts_of_workspace(index, reached)
    assert {one.unit for one in facts if one.kind == "function"} == {"far.reset", "far.offer", "far.advertise"}
    assert list(without_endpoint(index, facts, reached)) == []


def test_all_that_makes_endpoints_is_found_by_its_letters():
    assert [name for name in sorted(MAKE) if not any(stem.decode() in name for stem in STEMS)] == []
