TREE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Ask : public BT::SyncActionNode {{ public: Ask(const std::string & n, const BT::NodeConfiguration & c)
  : BT::SyncActionNode(n, c) {{
    std::string topic;
    getInput("topic", topic);
    auto node = config().blackboard->get<rclcpp::Node::SharedPtr>("node");
    pub_ = node->create_publisher<std_msgs::msg::String>({name}, 1); }}
}};
BT_REGISTER_NODES(factory) {{ factory.registerNodeType<Ask>("Ask"); }}
"""


def test_the_tree_decides_what_a_port_gives(units):
    (facts,) = units(a_cpp=TREE.format(name='topic + "/more"'))
    (one,) = facts.endpoints
    assert str(one.name) == "{port topic of the behaviour tree}/more"
    assert one.evidence.sure.value == "possible"


def test_what_no_port_decides_is_known(units):
    (facts,) = units(a_cpp=TREE.format(name='"fixed"'))
    assert facts.endpoints[0].name.known == "fixed"


def test_what_the_nodes_of_a_tree_make_is_said_to_be_unknown(node_of):
    members = "BT::BehaviorTreeFactory factory_;"
    body = 'auto tree = factory_.createTreeFromFile(declare_parameter("tree", std::string("a.xml")));'
    ((evidence, reason),) = node_of(body, members).unresolved
    assert reason == "a behaviour tree is created from {parameter tree}: the endpoints of its nodes are unknown"
    assert evidence.path == "pkg/a.cpp"
