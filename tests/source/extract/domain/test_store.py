"""What functions change in objects under a condition that nobody knows is the one or the other afterwards."""

import pytest

from roslens.source.extract.domain.abstract_value import QosValue, Unknown
from roslens.source.extract.domain.store import Store
from roslens.source.extract.facts.node_facts import Sure
from roslens.source.extract.symbolic.text import Text

CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct H { std::string topic = "a"; rclcpp::QoS q{10}; void set_topic(const std::string & t) { topic = t; }
  void set_q() { q.best_effort(); } };
void change(H & h) { h.topic = "b"; h.q.best_effort(); }
struct Outer { H h; void change() { h.set_topic("b"); h.set_q(); } };
struct Holds { Holds(H & h) : h_(h) {} H & h_; void change() { h_.set_topic("b"); h_.set_q(); } };
"""
PYTHON = """
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
class H:
    def __init__(self):
        self.topic, self.q = 'a', QoSProfile(depth=1)
        self.names, self.table = ['a'], {'k': 'a'}
    def set_topic(self, topic):
        self.topic = topic
    def set_q(self):
        self.q.reliability = ReliabilityPolicy.BEST_EFFORT
    def set_table(self):
        self.table['k'] = 'b'
    def set_name(self):
        self.names[0] = 'b'
    def clear(self):
        self.names.clear()
def change(h):
    h.topic = 'b'
    h.q.reliability = ReliabilityPolicy.BEST_EFFORT
class A(Node):
    def __init__(self):
        super().__init__('a')
"""


@pytest.fixture
def of_cpp(units):
    """Return the last endpoint of a node of C++ whose constructor has this body."""

    def make(body, members=""):
        text = f'{CPP}class A : public rclcpp::Node {{ public: A() : Node("a") {{ {body} }}\n{members} }};'
        return next(one for one in units(a_cpp=text) if one.unit == "A").endpoints[-1]

    return make


@pytest.fixture
def of_python(units):
    """Return the last endpoint of a node of Python whose constructor has these lines."""

    def make(body):
        text = PYTHON + "".join(f"        {line}\n" for line in body.split("\n"))
        return next(one for one in units(a_py=text) if one.unit == "A").endpoints[-1]

    return make


def is_open(one):
    return one.evidence.sure is not Sure.CERTAIN and one.name.known is None


HELD = [
    ("H h;", "h."),
    ("auto h = new H();", "h->"),
    ("auto h = std::make_shared<H>();", "h->"),
    ("", "h_."),
    ("p_ = std::make_shared<H>();", "p_->"),
]
MEMBERS = "H h_; std::shared_ptr<H> p_;"
CHANGES = [
    'if (x()) {{ {h}set_topic("b"); {h}set_q(); }}',
    "if (x()) {{ change({v}); }}",
    "if (x()) {{ }} else {{ change({v}); }}",
    "while (x()) {{ change({v}); }}",
    "for (auto & z : zs()) {{ change({v}); }}",
    "switch (x()) {{ case 1: change({v}); break; }}",
    'if (x()) {{ {h}topic = "b"; {h}q.best_effort(); }}',
]


@pytest.mark.parametrize(("made", "held"), HELD)
@pytest.mark.parametrize("change", CHANGES)
def test_an_object_of_cpp(of_cpp, made, held, change):
    value = f"*{held[:-2]}" if held.endswith("->") else held[:-1]
    body = made + change.format(h=held, v=value)
    assert is_open(of_cpp(f"{body} create_publisher<std_msgs::msg::String>({held}topic, 1);", MEMBERS))
    quality = of_cpp(f'{body} create_publisher<std_msgs::msg::String>("a", {held}q);', MEMBERS)
    assert quality.qos_unknown
    assert not quality.qos.reliability


@pytest.mark.parametrize("made", ["Outer o;", "H h; Holds o(h);"])
def test_an_object_in_another_one(of_cpp, made):
    inner = "o.h.topic" if "Outer" in made else "h.topic"
    assert is_open(of_cpp(f"{made} if (x()) {{ o.change(); }} create_publisher<std_msgs::msg::String>({inner}, 1);"))


@pytest.mark.parametrize(
    ("body", "name"),
    [
        ('h.set_topic("b"); PUBLISH;', "b"),
        ('if (x()) { h.set_topic("b"); PUBLISH; }', "b"),
        ('if (x()) { h.set_topic("b"); } else { h.set_topic("b"); } PUBLISH;', "b"),
        ('if (x()) { h.set_topic("c"); } h.set_topic("b"); PUBLISH;', "b"),
        ('if (x()) { h.set_topic("b"); } else { return; } PUBLISH;', "b"),
        ('if (x()) { } else { PUBLISH; h.set_topic("b"); }', "a"),
        ('if (x()) { h.set_topic("b"); } else { PUBLISH; }', "a"),
        ('if (x()) { H g; g.set_topic("b"); h = g; PUBLISH; }', "b"),
    ],
)
def test_what_is_sure_stays_sure(of_cpp, body, name):
    one = of_cpp("H h;" + body.replace("PUBLISH", "create_publisher<std_msgs::msg::String>(h.topic, 1)"))
    assert one.name.known == name


@pytest.mark.parametrize("body", ['{ topic_ = "b"; return; } other_ = 1;', '{ topic_ = "b"; return; } topic_ = "c";'])
def test_a_way_that_leaves_a_method_has_changed_its_object(of_cpp, body):
    members = f'std::string topic_ = "a"; int other_ = 0; void configure() {{ if (x()) {body} }}'
    assert is_open(of_cpp("configure(); create_publisher<std_msgs::msg::String>(topic_, 1);", members))


@pytest.mark.parametrize("held", ["h", "self.h"])
@pytest.mark.parametrize("when", ["if x():", "for z in x():", "while x():"])
@pytest.mark.parametrize(
    ("change", "name"),
    [
        ("{h}.set_topic('b')", "topic"),
        ("change({h})", "topic"),
        ("{h}.topic = 'b'", "topic"),
        ("{h}.set_table()", "table['k']"),
        ("{h}.set_name()", "names[0]"),
        ("{h}.clear()", "names[0]"),
    ],
)
def test_an_object_of_python(of_python, held, when, change, name):
    lines = f"{held} = H()\n{when}\n    {change.format(h=held)}\nself.create_publisher(String, {held}.{name}, 1)"
    assert is_open(of_python(lines))


@pytest.mark.parametrize("held", ["h", "self.h"])
@pytest.mark.parametrize("change", ["{h}.set_q()", "change({h})"])
def test_a_quality_of_service_of_an_object_of_python(of_python, held, change):
    lines = f"{held} = H()\nif x():\n    {change.format(h=held)}\nself.create_publisher(String, 'a', {held}.q)"
    one = of_python(lines)
    assert one.qos_unknown
    assert not one.qos.reliability


def test_nothing_is_written_down_outside_of_conditions():
    changes, held = Store(), {"a": 1}
    changes.put(held, "a", 2)
    changes.items([1])
    assert (changes.count, held) == (0, {"a": 2})


def test_what_a_way_changed_is_taken_back_and_joined():
    changes, held, items = Store(), {"a": Text.of("x"), "b": 1}, [Text.of("i")]
    changes.open = 1
    changes.put(held, "a", Text.of("y"))
    changes.items(items, less=True)
    items.clear()
    way, second = changes.roll_back(0), changes.count
    assert (held["a"], items) == (Text.of("x"), [Text.of("i")])
    changes.put(held, "b", 2)
    changes.merge(way, second, None, (False, False), ("p", "not p"), None)
    assert str(held["a"]) == "{y if p, else x}"
    assert isinstance(held["b"], Unknown)
    assert isinstance(items[0], Unknown)
    changes.ended()
    assert changes.count == 0


def test_what_several_hold_is_one_of_two():
    changes, before, after = Store(), QosValue(), QosValue(unknown="else")
    changes.open = 1
    changes.refine(before, after)
    way = changes.roll_back(0)
    assert not changes.refined
    changes.merge(way, changes.count, None, (False, False), ("p", "not p"), None)
    assert changes.refined[id(before)][1].unknown == "else"
