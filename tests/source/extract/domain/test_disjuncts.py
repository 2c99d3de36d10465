"""Objects that are of one class or another."""

import pytest

from roslens.source.extract.symbolic.condition import as_written

BEFORE = """
class Base { public: explicit Base(rclcpp::Node * n) : node_(n) {} virtual bool init() = 0; rclcpp::Node * node_; };
class One : public Base { public: using Base::Base;
  bool init() override { pub_ = node_->create_publisher<std_msgs::msg::String>("one", 1); return true; } };
class Two : public Base { public: using Base::Base;
  bool init() override { pub_ = node_->create_publisher<std_msgs::msg::String>("two", 1); return true; } };
class None : public Base { public: using Base::Base; bool init() override { return true; } };
"""
BRANCH = "if (kind == 3) { made = std::make_shared<One>(this); } else { made = std::make_shared<Two>(this); }"
SWITCH = (
    "switch (kind) { case 3: made = std::make_shared<One>(this); break;"
    " case 4: made = std::make_shared<Two>(this); break; default: made = std::make_shared<None>(this); break; }"
)


@pytest.mark.parametrize("choice", [BRANCH, SWITCH])
def test_each_object_does_what_its_class_says_under_its_condition(node_of, choice):
    body = f'int kind = declare_parameter("kind", 0);\nstd::shared_ptr<Base> made;\n{choice}\nmade->init();'
    found = {str(one.name): as_written(one.conditions) for one in node_of(body, before=BEFORE).endpoints}
    assert set(found) == {"one", "two"}
    assert found["one"][0] == "kind == 3"
    assert found["two"][0] == "not kind == 3"


def test_an_object_that_is_known_is_that_one(node_of):
    body = f"int kind = 3;\nstd::shared_ptr<Base> made;\n{BRANCH}\nmade->init();"
    (one,) = node_of(body, before=BEFORE).endpoints
    assert (str(one.name), as_written(one.conditions)) == ("one", ())


def test_objects_of_one_class_are_not_told_apart(node_of):
    choice = "if (a_) { made = std::make_shared<One>(this); } else { made = std::make_shared<One>(this); }"
    (one,) = node_of(f"std::shared_ptr<Base> made;\n{choice}\nmade->init();", before=BEFORE).endpoints
    assert (str(one.name), as_written(one.conditions)) == ("one", ())


def test_objects_of_python(units):
    text = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class One:
    def init(self, node):
        node.create_publisher(String, 'one', 1)
class Two:
    def init(self, node):
        node.create_publisher(String, 'two', 1)
class A(Node):
    def __init__(self):
        super().__init__('a')
        if self.declare_parameter('fast', False).value:
            self.made = One()
        else:
            self.made = Two()
        self.made.init(self)
def main():
    rclpy.spin(A())
if __name__ == '__main__':
    main()
"""
    found = {str(one.name): as_written(one.conditions) for facts in units(a_py=text) for one in facts.endpoints}
    assert set(found) == {"one", "two"}
    assert all(found.values())
