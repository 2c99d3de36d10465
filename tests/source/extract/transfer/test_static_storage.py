"""Variables that functions of C++ keep between calls, and what is changed through the references they return."""

import pytest

from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.syntax.macro.macros import load_macros

STRING = "std_msgs::msg::String"
QUALITY = "rclcpp::QoS & quality() { static rclcpp::QoS q(10); return q; }"
NAME = 'std::string & topic() { static std::string s = "a"; return s; }'
OF_C = """struct C { rclcpp::QoS q{10}; std::string topic = "a"; rclcpp::QoS & quality() { return q; } };
C & c() { static C one; return one; }"""


@pytest.mark.parametrize(
    ("before", "change", "given"),
    [
        (QUALITY, "quality().best_effort();", "quality()"),
        (QUALITY, "quality().best_effort().transient_local();", "quality()"),
        (QUALITY, "rclcpp::QoS & r = quality(); r.best_effort();", "quality()"),
        (QUALITY, "auto & r = quality(); r.best_effort();", "quality()"),
        (QUALITY, "quality() = rclcpp::QoS(1).best_effort();", "quality()"),
        (OF_C, "c().q.best_effort();", "c().q"),
        (OF_C, "C one; one.quality().best_effort();", "one.q"),
        ("rclcpp::QoS all(10); rclcpp::QoS & quality() { return all; }", "quality().best_effort();", "all"),
    ],
)
def test_a_quality_of_service_that_is_changed_through_a_reference(node_of, before, change, given):
    (one,) = node_of(f'{change} create_publisher<{STRING}>("a", {given});', before=before).endpoints
    assert one.qos.reliability == "best_effort"


def test_a_member_that_is_changed_through_a_reference(node_of):
    members = "rclcpp::QoS & quality() { return qos_; } rclcpp::QoS qos_{10};"
    (one,) = node_of(f'quality().best_effort(); create_publisher<{STRING}>("a", qos_);', members).endpoints
    assert one.qos.reliability == "best_effort"


@pytest.mark.parametrize("returned", ["rclcpp::QoS", "const rclcpp::QoS &"])
def test_a_copy_that_is_changed_changes_nothing_else(node_of, returned):
    before = f"{returned} quality() {{ static rclcpp::QoS q(10); return q; }}"
    body = f'auto copy = quality(); copy.best_effort(); create_publisher<{STRING}>("a", quality());'
    (one,) = node_of(body, before=before).endpoints
    assert one.qos.reliability == "reliable"


def test_a_value_that_a_function_returns_is_no_place(node_of):
    members = "rclcpp::QoS quality() { return qos_; } rclcpp::QoS qos_{10};"
    (one,) = node_of(f'quality().best_effort(); create_publisher<{STRING}>("a", qos_);', members).endpoints
    assert one.qos.reliability == "reliable"


@pytest.mark.parametrize(
    ("before", "change", "given", "name"),
    [
        (NAME, 'topic() = "b";', "topic()", "b"),
        (NAME, 'topic() += "b";', "topic()", "ab"),
        (NAME, 'topic().append("b");', "topic()", "ab"),
        (NAME, "", "topic()", "a"),
        (OF_C, 'c().topic = "b";', "c().topic", "b"),
        ('std::string named(std::string n) { static std::string s = "a"; if (!n.empty()) { s = n; } return s; }',
         'named("b");', 'named("")', "b"),
    ],
)  # fmt: skip
def test_a_text_that_is_kept(node_of, before, change, given, name):
    (one,) = node_of(f"{change} create_publisher<{STRING}>({given}, 1);", before=before).endpoints
    assert one.name.known == name


def test_a_text_that_is_changed_under_a_condition_is_the_one_or_the_other(node_of):
    (one,) = node_of(f'if (x()) {{ topic() = "b"; }} create_publisher<{STRING}>(topic(), 1);', before=NAME).endpoints
    assert one.name.known is None


@pytest.mark.parametrize("count", ["n++; return n;", "int m = n; n += 1; return m;", "return n++;"])
def test_a_number_that_each_call_changes_is_unknown(node_of, count):
    before = f"int next() {{ static int n = 0; {count} }}"
    facts = node_of(f'next(); create_publisher<{STRING}>("t" + std::to_string(next()), 1);', before=before)
    assert facts.endpoints[0].name.known is None


def test_whether_it_is_the_first_call_is_known(node_of):
    members = f"""void begin() {{ static bool first = true;
      if (first) {{ first = false; create_publisher<{STRING}>("a", 1); }}
      else {{ create_publisher<{STRING}>("b", 1); }} }}"""
    found = node_of("begin(); begin();", members).endpoints
    assert [(one.name.known, as_written(one.conditions)) for one in found] == [("a", ()), ("b", ())]


@pytest.mark.parametrize(
    ("returned", "hands"),
    [("rclcpp::QoS &", True), ("C *", True), ("const C &", False), ("C const *", False), ("C", False)],
)
def test_what_hands_out_something_that_may_be_changed(returned, hands):
    (function,) = program_of_cpp(f"{returned} f() {{ return c; }}".encode(), load_macros()).functions
    assert function.hands is hands


@pytest.mark.parametrize(("when", "reliability"), [("", "best_effort"), ("if (x()) ", "")])
def test_a_quality_of_service_that_is_changed_through_a_pointer(node_of, when, reliability):
    before = "void change(rclcpp::QoS * q) { q->best_effort(); }"
    body = f'rclcpp::QoS q(10); {when}{{ change(&q); }} create_publisher<{STRING}>("a", q);'
    (one,) = node_of(body, before=before).endpoints
    assert one.qos.reliability == reliability
