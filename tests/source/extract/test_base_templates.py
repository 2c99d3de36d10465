"""Template arguments that a class gives its bases."""

import pytest

from roslens.source.extract.cpp_program import program_of_cpp
from roslens.source.syntax.macros import load_macros

BASES = """
#include <rclcpp/rclcpp.hpp>
template<class T> class Base : public rclcpp::Node {
public:
  Base(std::string name, std::string topic) : Node(name) { pub_ = create_publisher<T>(topic, 1); }
  typename rclcpp::Publisher<T>::SharedPtr pub_;
};
template<class T, class U> class Middle : public Base<U> {
public:
  explicit Middle(std::string name) : Base<U>(name, "out") { this->template create_subscription<T>("in", 1, nullptr); }
};
template<class T> class Helper {
public:
  void start(rclcpp::Node * node) { node->create_publisher<T>("help", 1); }
};
"""


@pytest.mark.parametrize(
    ("derived", "types"),
    [
        (
            'class A : public Base<std_msgs::msg::String> { public: A() : Base("a", "x") {} };',
            ["std_msgs/msg/String"],
        ),
        (
            'class A : public Middle<p::msg::In, p::msg::Out> { public: A() : Middle("a") {} };',
            ["p/msg/Out", "p/msg/In"],
        ),
        (
            'template<class T> class A : public Base<p::msg::Own> { public: A() : Base("a", "x") {} };',
            ["p/msg/Own"],
        ),
        (
            'class A : public rclcpp::Node, public Helper<p::msg::Out> { public: A() : Node("a") { start(this); } };',
            ["p/msg/Out"],
        ),
    ],
)
def test_types_of_bases(units, derived, types):
    (facts,) = [one for one in units(a_cpp=BASES + derived) if one.unit == "A"]
    assert [str(one.type) for one in facts.endpoints] == types


def test_arguments_of_bases_are_lowered():
    text = b"class A : public B, public n::C<int, D<E>> {};\nclass F : public B {};"
    first, second = program_of_cpp(text, load_macros()).classes
    assert (first.bases, first.base_templates) == (("B", "n.C"), ((), ("int", "D<E>")))
    assert (second.bases, second.base_templates) == (("B",), ())
