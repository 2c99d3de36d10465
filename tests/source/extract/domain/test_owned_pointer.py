import pytest

from roslens.source.extract.domain.abstract_value import Callable, Obj, Unknown
from roslens.source.extract.domain.owned_pointer import is_owner, owns_first
from roslens.source.extract.facts.node_facts import Sure
from roslens.source.extract.ir.program import Function

DELETER = Callable(Function("free", "free", 1), "a.cpp")
PARTS = ["says", "/tf", "/tf", "/tf_static", "frame"]
TWO_NODES = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>
void nothing(rclcpp::Node *) {{}}
class Part {{
public:
  explicit Part(std::shared_ptr<rclcpp::Node> & node) : node_(node) {{
    node_->declare_parameter<std::string>("frame", "odom");
    publisher_ = node_->create_publisher<std_msgs::msg::String>("says", 10);
    frames_ = std::make_unique<tf2_ros::TransformBroadcaster>(node_);
    listener_ = std::make_unique<tf2_ros::TransformListener>(*buffer_, node_);
  }}
  std::shared_ptr<rclcpp::Node> node_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> frames_;
  std::unique_ptr<tf2_ros::Buffer> buffer_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;
}};
class One : public rclcpp::Node {{ public: One() : Node("one") {{}} }};
class Two : public rclcpp::Node {{
public:
  Two() : Node("two"){initialiser} {{ {statement} part_ = std::make_unique<Part>(node_); }}
  std::shared_ptr<rclcpp::Node> node_;
  std::unique_ptr<Part> part_;
}};
int main() {{
  auto one = std::make_shared<One>();
  auto two = std::make_shared<Two>();
}}
"""


def _made(units, statement, initialiser=""):
    facts = units(a_cpp=TWO_NODES.format(statement=statement, initialiser=initialiser))
    return {
        str(one.name): [(str(fact.name), fact.evidence.sure) for fact in (*one.endpoints, *one.parameters)]
        for one in facts
        if one.unit == "main"
    }


@pytest.mark.parametrize(
    "statement",
    [
        "node_ = std::shared_ptr<::rclcpp::Node>(this, [](::rclcpp::Node *) {});",
        "node_ = std::shared_ptr<rclcpp::Node>(this, nothing);",
        "node_ = std::shared_ptr<rclcpp::Node>{this, [](auto *) {}};",
        "node_ = rclcpp::Node::SharedPtr(this, [](rclcpp::Node *) {});",
        "std::shared_ptr<rclcpp::Node> mine(this, [](rclcpp::Node *) {}); node_ = mine;",
        "rclcpp::Node::SharedPtr mine(this, [](auto *) {}); node_ = mine;",
        "node_.reset(this, [](rclcpp::Node *) {});",
        "node_.reset(this);",
        "node_ = shared_from_this();",
    ],
)
def test_what_is_made_with_a_pointer_to_a_node_is_of_that_node(units, statement):
    assert _made(units, statement) == {"one": [], "two": [(name, Sure.CERTAIN) for name in PARTS]}


def test_a_pointer_that_is_a_member_is_initialised(units):
    made = _made(units, "", ", node_(this, [](rclcpp::Node *) {})")
    assert [name for name, _ in made["two"]] == PARTS
    assert set(made) == {"one", "two"}


@pytest.mark.parametrize("statement", ["", "node_ = somebody();", "node_ = take(this, 1);"])
def test_what_is_made_with_a_pointer_to_who_knows_what_is_of_no_node_for_sure(units, statement):
    made = [fact for facts in _made(units, statement).values() for fact in facts]
    assert [name for name, _ in made] == PARTS
    assert {sure for _, sure in made} == {Sure.LIKELY}


@pytest.mark.parametrize(
    ("arguments", "owns"),
    [
        ([Obj("Node")], True),
        ([Obj("Node"), DELETER], True),
        ([Obj("Node"), Unknown("a pointer into it")], False),
        ([Obj("Node"), Obj("Node")], False),
        ([Obj("Node"), DELETER, 1], False),
        ([], False),
    ],
)
def test_what_a_pointer_points_to(arguments, owns):
    assert owns_first(arguments) is owns


@pytest.mark.parametrize(
    ("name", "is_one"),
    [
        ("rclcpp.Node.SharedPtr", True),
        ("demo.Thing.UniquePtr", True),
        ("SharedPtr", True),
        ("demo.makePtr", False),
        ("rclcpp.Node", False),
    ],
)
def test_which_classes_are_pointers_by_their_name(name, is_one):
    assert is_owner(name) is is_one
