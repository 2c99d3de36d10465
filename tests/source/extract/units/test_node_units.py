from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbols.reached_functions import Reached
from roslens.source.extract.units.node_units import (
    facts_of_class,
    facts_of_main,
    facts_of_module,
    facts_of_plugin,
    node_classes,
    registered,
)
from roslens.source.extract.units.tree_nodes import facts_of_registration

COMPONENT = """
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <std_msgs/msg/string.hpp>
namespace n {
class Own : public rclcpp_lifecycle::LifecycleNode {
public:
  explicit Own(const rclcpp::NodeOptions & o) : LifecycleNode("own", "space", o) {}
  CallbackReturn on_configure(const rclcpp_lifecycle::State &) {
    pub_ = create_publisher<std_msgs::msg::String>("out", 1); return SUCCESS; }
  void late() { sub_ = create_subscription<std_msgs::msg::String>("in", 1, [](std_msgs::msg::String::SharedPtr) {}); }
};
class Loaded : public Layer {
public:
  void initialize(const std::string & name, const rclcpp::Node::SharedPtr & parent) {
    pub_ = parent->create_publisher<std_msgs::msg::String>(name + "/layer", 1); }
};
}
RCLCPP_COMPONENTS_REGISTER_NODE(n::Own)
PLUGINLIB_EXPORT_CLASS(n::Loaded, Layer)
"""
TREE = """
class Ask : public BT::ActionNodeBase { public: Ask(const std::string & n, const BT::NodeConfiguration & c) {
  auto node = c.blackboard->get<rclcpp::Node::SharedPtr>("node");
  client_ = node->create_client<std_srvs::srv::Trigger>("ask"); } };
BT_REGISTER_NODES(factory) { factory.registerNodeType<Ask>("Ask"); }
"""
PYTHON = """
import rospy
from std_msgs.msg import String
def start():
    rospy.init_node('started')
    rospy.Subscriber('in', String, print)
if __name__ == '__main__':
    start()
"""


def test_classes_that_are_nodes(index_of):
    index = index_of(a_cpp=COMPONENT)
    ((defined, generation, kind),) = node_classes(index)
    assert (defined.what.qualified_name, generation, kind) == ("n.Own", "ros2", "lifecycle")
    reached = Reached()
    (facts,) = facts_of_class(index, defined, generation, kind, reached)
    assert (facts.name.known, facts.namespace.known, facts.kind) == ("own", "space", "lifecycle")
    assert [(one.name.known, as_written(one.conditions)) for one in facts.endpoints] == [
        ("out", ()),
        ("in", ("late() is called",)),
    ]
    assert ("pkg/a.cpp", 8) in reached


def test_classes_that_are_registered(index_of):
    index = index_of(a_cpp=COMPONENT)
    assert {name: place.line for name, place in registered(index).items()} == {"n.Own": 18, "n.Loaded": 19}
    (facts,) = facts_of_plugin(index, index.class_of("n.Loaded", "pkg/a.cpp", ""), "ros2")
    assert [(str(one.name), one.evidence.sure.value) for one in facts.endpoints] == [
        ("{parameter name of initialize()}/layer", "possible")
    ]


def test_programs_and_scripts(index_of):
    main = '#include <rclcpp/rclcpp.hpp>\nint main() { auto n = std::make_shared<rclcpp::Node>("made"); }'
    index = index_of(a_cpp=main, b_py=PYTHON)
    assert [one.name.known for one in facts_of_main(index, "pkg/a.cpp")] == ["made"]
    assert facts_of_main(index_of(a_cpp="void f() {}"), "pkg/a.cpp") == []
    whole, entered = facts_of_module(index, "pkg/b.py"), facts_of_module(index, "pkg/b.py", "start")
    assert [[one.name.known, len(one.endpoints)] for one in (*whole, *entered)] == [["started", 1]] * 2
    assert [one.unit for one in (*whole, *entered)] == ["<module>", "start"]


def test_nodes_of_behaviour_trees(index_of):
    index = index_of(a_cpp=TREE)
    function = next(one for one in index.programs["pkg/a.cpp"].functions if one.name.startswith("BT_REGISTER"))
    (facts,) = facts_of_registration(index, "pkg/a.cpp", function)
    assert [(one.role.value, one.name.known) for one in facts.endpoints] == [("service_client", "ask")]


def test_state_that_a_callback_may_find_changed(units):
    text = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class A : public rclcpp::Node { public: A() : Node("a") {
  sub_ = create_subscription<std_msgs::msg::String>("in", 1, std::bind(&A::heard, this, std::placeholders::_1)); }
  void heard(std_msgs::msg::String::SharedPtr) {
    if (ready_) { pub_ = create_publisher<std_msgs::msg::String>("out", 1); } ready_ = true; }
  bool ready_ = false; };
"""
    (facts,) = units(a_cpp=text)
    assert [(one.name.known, as_written(one.conditions)) for one in facts.endpoints] == [
        ("in", ()),
        ("out", ("ready_",)),
    ]


def test_members_may_have_changed_when_a_callback_runs(units):
    text = (
        "#include <ros/ros.h>\n#include <std_msgs/String.h>\nclass A { public: A() : first_(true) {"
        ' sub_ = nh_.subscribe("in", 1, &A::heard, this); }\n'
        "void heard(const std_msgs::String::ConstPtr & msg) { if (first_) { first_ = false; return; }"
        ' pub_ = nh_.advertise<std_msgs::String>("out", 1); }\n'
        "bool first_; ros::NodeHandle nh_; ros::Subscriber sub_; ros::Publisher pub_; };\n"
        'int main(int argc, char ** argv) { ros::init(argc, argv, "a"); A a; ros::spin(); }'
    )
    (main,) = [one for one in units(a_cpp=text) if one.unit == "main"]
    assert [str(one.name) for one in main.endpoints] == ["in", "out"]


def test_each_further_node_does_what_its_class_does(units):
    text = (
        "#include <rclcpp_lifecycle/lifecycle_node.hpp>\n#include <std_msgs/msg/string.hpp>\n"
        "class Map : public rclcpp_lifecycle::LifecycleNode { public: explicit Map(std::string name)"
        " : rclcpp_lifecycle::LifecycleNode(name) {}\nReturn on_configure(const rclcpp_lifecycle::State &) {"
        ' pub_ = create_publisher<std_msgs::msg::String>("map", 1); } };\n'
        'class A : public rclcpp_lifecycle::LifecycleNode { public: A() : rclcpp_lifecycle::LifecycleNode("a") {'
        ' one_ = std::make_shared<Map>("one"); two_ = std::make_shared<Map>("two"); } };'
    )  # fmt: skip
    found = [one for one in units(a_cpp=text) if one.unit == "A"]
    assert [(str(one.name), len(one.endpoints)) for one in sorted(found, key=lambda one: one.number)] == [
        ("a", 0),
        ("one", 1),
        ("two", 1),
    ]


def test_a_managed_node_that_its_own_program_makes_is_followed_until_it_is_active(index_of):
    text = """
import rclpy
from rclpy.lifecycle import LifecycleNode
from std_msgs.msg import String
class A(LifecycleNode):
    def __init__(self):
        super().__init__('a')
    def on_configure(self, state):
        self.create_lifecycle_publisher(String, 'b', 1)
    def on_activate(self, state):
        self.heard = self.create_subscription(String, 'c', self.on_heard, 1)
    def on_deactivate(self, state):
        self.destroy_subscription(self.heard)
def main():
    rclpy.spin(A())
if __name__ == '__main__':
    main()
"""
    (facts,) = facts_of_module(index_of(a_py=text), "pkg/a.py", "main")
    assert [one.name.known for one in facts.endpoints] == ["b", "c"]


def test_a_script_is_followed_through_what_it_does_on_its_outermost_level(index_of):
    text = """
import rospy
from std_msgs.msg import String
rospy.init_node('a')
for topic, kind in {'b': String, 'c': String}.items():
    rospy.Subscriber(topic, kind, print)
last = rospy.Publisher('d', String, queue_size=1)
def heard(message):
    last.publish(message)
rospy.Subscriber('e', String, heard)
"""
    (facts,) = facts_of_module(index_of(a_py=text), "pkg/a.py")
    assert sorted(one.name.known for one in facts.endpoints) == ["b", "c", "d", "e"]
