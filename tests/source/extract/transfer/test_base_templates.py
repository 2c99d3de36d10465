"""Template arguments that a class gives its bases."""

import pytest

from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.syntax.macro.macros import load_macros

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


def test_an_argument_means_the_class_of_that_name_where_it_is_written(units):
    text = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
namespace far { struct Parameters { std::string topic = "other"; }; }
namespace tools { template<class T> class Handler { public: T params_; T * get() { return &params_; } }; }
namespace near { struct Parameters { std::string topic = "mine"; };
class Own : public tools::Handler<Parameters> {};
class A : public rclcpp::Node { public: A() : Node("a") {
  own_ = std::make_unique<Own>(); auto params = own_->get();
  create_publisher<std_msgs::msg::String>(params->topic, 1); }
  std::unique_ptr<Own> own_; }; }
"""
    (facts,) = [one for one in units(a_cpp=text) if one.unit == "near.A"]
    assert [one.name.known for one in facts.endpoints] == ["mine"]


def test_arguments_of_bases_are_lowered():
    text = b"class A : public B, public n::C<int, D<E>> {};\nclass F : public B {};"
    first, second = program_of_cpp(text, load_macros()).classes
    assert (first.bases, first.base_templates) == (("B", "n.C"), ((), ("int", "D<E>")))
    assert (second.bases, second.base_templates) == (("B",), ())
