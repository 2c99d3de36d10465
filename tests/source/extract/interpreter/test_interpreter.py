"""Calls into a workspace, its bounds, and that no source makes the evaluation fail."""

import time

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pace import turned_s

from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.units.workspace_units import facts_of_workspace
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()
CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
namespace demo {
const std::string PREFIX = "a";
template<typename T> class Helper {
public:
  Helper(rclcpp::Node * node, const std::string & name) : name_(name) {
    pub_ = node->create_publisher<T>(PREFIX + "/" + name_, rclcpp::QoS(10).transient_local());
  }
  std::string name_; typename rclcpp::Publisher<T>::SharedPtr pub_;
};
class A : public rclcpp::Node {
public:
  explicit A(const rclcpp::NodeOptions & options) : Node("a", options), helper_(this, "x") {
    auto topics = declare_parameter<std::vector<std::string>>("topics", {"one", "two"});
    for (const auto & topic : topics) {
      subs_.push_back(create_subscription<std_msgs::msg::String>(topic, 10,
        [this](const std_msgs::msg::String & m) { if (m.data.empty()) { return; } again(3); }));
    }
    std::string name = get_parameter("name").as_string();
    if (name.empty()) { throw std::runtime_error("no name"); } else { name += "_more"; }
    service_ = create_service<std_srvs::srv::Trigger>(name, std::bind(&A::serve, this, std::placeholders::_1));
  }
private:
  void again(int depth) { if (depth > 0) { again(depth - 1); } else { timer_ = create_wall_timer(100ms, [] {}); } }
  void serve(std_srvs::srv::Trigger::Request::SharedPtr) {}
  Helper<std_msgs::msg::String> helper_;
};
}
RCLCPP_COMPONENTS_REGISTER_NODE(demo::A)
"""
PYTHON = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
TOPICS = {'a': 'one', 'b': 'two'}
class Talker(Node):
    rate = 10
    def __init__(self, name='talker', **options):
        super().__init__(name, **options)
        self.names = self.declare_parameter('names', ['x']).value
        for key, topic in TOPICS.items():
            self.pubs = [self.create_publisher(String, f'{key}/{topic}', 10)]
        for name in self.names:
            self.create_subscription(String, name + '/in', self.heard, 10)
        try:
            self.timer = self.create_timer(1 / self.rate, self.tick)
        except ZeroDivisionError as error:
            raise ValueError('%s' % error)
    def heard(self, message):
        while message.data:
            self.tick()
    def tick(self):
        return self.heard(None) if self.rate else [one for one in range(3)]
def main():
    rclpy.init()
    rclpy.spin(Talker('other'))
if __name__ == '__main__':
    main()
"""


def facts_of(cpp="", python=""):
    return facts_of_workspace(indexed({"p/a.cpp": program_of_cpp(cpp.encode(), MACROS),
                                     "p/b.py": program_of_python(python.encode())}))  # fmt: skip


def test_what_these_programs_make():
    found = facts_of(CPP, PYTHON)
    ends = {one.unit: [(end.role.value, str(end.name), end.type.known) for end in one.endpoints] for one in found}
    text = "std_msgs/msg/String"
    assert ends["demo.A"] == [
        ("publisher", "a/x", text),
        ("subscription", "{each of parameter topics}", text),
        ("service_server", "{parameter name}_more", "std_srvs/srv/Trigger"),
    ]
    talker = [
        ("publisher", "a/one", text),
        ("publisher", "b/two", text),
        ("subscription", "{each of parameter names}/in", text),
    ]
    assert ends["Talker"] == talker
    assert not [one.unresolved for one in found if one.unresolved]


@pytest.mark.parametrize(
    "text",
    [
        "int main() { while (true) { main(); } }",
        "void f(); void g() { f(); } void f() { g(); } int main() { f(); }",
        "class A : public A {}; int main() { A a; a.run(); }",
        "class A : public B {}; class B : public A {}; int main() { B b; }",
        "const int X = Y; const int Y = X; int main() { std::string s = X; }",
        "struct A { A a_; A() { A b; } }; int main() { A a; }",
        "template<typename T> T f(T t) { return f<std::vector<T>>(t); } int main() { f<int>(1); }",
    ],
)
@pytest.mark.timed
def test_what_never_ends_ends(text):
    begin = time.process_time()
    facts_of("#include <ros/ros.h>\n" + text)
    assert turned_s(begin) < 3


PIECES = st.sampled_from(
    ["(", ")", "{", "}", "[0]", '"', "'", ";", ",", ".", "::", "->", "=", "+", "this", "self", "nullptr", "None", "1",
     "*", "&", "<", ">", "\n", " ", "return ", "if (", "for x in ", "lambda: ", "std::move(", "{}", "[]", '"a"']
)  # fmt: skip


@settings(max_examples=120, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    st.sampled_from([CPP, PYTHON]), st.lists(st.tuples(st.integers(0, 2000), st.integers(0, 30), PIECES), max_size=4)
)
def test_no_source_makes_it_fail(text, edits):
    changed = text
    for place, length, piece in edits:
        changed = changed[:place] + piece + changed[place + length :]
    found = facts_of(changed, "") if text is CPP else facts_of("", changed)
    for one in found:
        assert not [reason for _, reason in one.unresolved if "nonsense" in reason]
        for end in one.endpoints:
            assert str(end.name)
