import pytest


def told(facts):
    return [(one.access, str(one.name), one.type, None if one.default is None else str(one.default)) for one in facts]


def text(one):
    return one.replace("PV", "rclcpp::ParameterValue").replace("V<", "std::vector<").replace("S>", "std::string>")


@pytest.mark.parametrize(
    ("body", "type_", "default"),
    [
        ('declare_parameter("x", PV(V<double>{0.5, 0.5}));', "double_array", "[0.5, 0.5]"),
        ('declare_parameter("x", PV(V<double>{0.5}));', "double_array", "[0.5]"),
        ('declare_parameter("x", V<double>{1, 2});', "double_array", "[1.0, 2.0]"),
        ('declare_parameter("x", V<S>({"a", "b"}));', "string_array", "[a, b]"),
        ('declare_parameter("x", V<S>());', "string_array", "[]"),
        ('declare_parameter("x", V<S>{});', "string_array", "[]"),
        ('declare_parameter("x", V<double>(3, 0.0));', "double_array", "[0.0, 0.0, 0.0]"),
        ('V<double> d; declare_parameter("x", d);', "double_array", None),
        ('const V<S> d{"a"}; declare_parameter("x", PV(d));', "string_array", "[a]"),
        ('declare_parameter("x", rclcpp::PARAMETER_DOUBLE_ARRAY);', "double_array", None),
        ('declare_parameter("x", rclcpp::ParameterType::PARAMETER_STRING);', "string", None),
        ('declare_parameter<V<int64_t>>("x");', "int_array", None),
        ('declare_parameter<V<S>>("x", {});', "string_array", "[]"),
        ('declare_parameter<V<uint8_t>>("x", {1});', "byte_array", "[1]"),
        ('declare_parameter<double>("x", 1);', "double", "1.0"),
        ('declare_parameter<uint16_t>("x", 1);', "int", "1"),
        ('declare_parameter("x", PV(5));', "int", "5"),
        ('declare_parameter("x", PV());', "", None),
        ('nav2_util::declare_parameter_if_not_declared(this, "x", PV(V<S>({"a"})));', "string_array", "[a]"),
        ('nav2::declare_parameter_if_not_declared(this, "x", rclcpp::PARAMETER_STRING);', "string", None),
        ('auto v = nav2::declare_or_get_parameter(this, "x", V<S>{"a"});', "string_array", "[a]"),
        ('auto v = declare_or_get_parameter<V<int>>("x");', "int_array", None),
    ],
)
def test_what_rclcpp_declares(node_of, body, type_, default):
    assert told(node_of(text(body)).parameters) == [("declared", "x", type_, default)]


@pytest.mark.parametrize(
    ("body", "types"),
    [
        ('double d = 10; declare_parameter("x", d);', ["double"]),
        ('const float d{10}; declare_parameter("x", d);', ["double"]),
        ('declare_parameter("x", rate_);', ["double"]),
        ('int d = 10; declare_parameter("x", d);', ["int"]),
        # A variable that a parameter was read into has its type, whatever that is.
        ('double d = 0.5; declare_parameter("w", d); d = get_parameter("w").as_double(); declare_parameter("x", d);',
         ["double", "double", "double"]),
        ('auto d = get_parameter("w").get_value<T>(); declare_parameter("x", d);', ["", ""]),
        ('declare_parameter("x", "a" + get_parameter("w").as_string());', ["string", "string"]),
        ('declare_parameter("x", compute());', [""]),
    ],
)  # fmt: skip
def test_variables_tell_their_type(node_of, body, types):
    assert [one.type for one in node_of(body, "double rate_ = 1;").parameters] == types


def test_several_at_once(node_of):
    body = 'declare_parameters<double>("ns", {{"a", 1}, {"b", 2.5}});'
    assert told(node_of(body).parameters) == [
        ("declared", "ns.a", "double", "1.0"),
        ("declared", "ns.b", "double", "2.5"),
    ]


def test_what_is_declared_at_once_and_not_followed_has_a_name_that_may_be_any(node_of, units):
    (one,) = node_of('std::map<std::string, double> m; m["a"] = 1.0; declare_parameters("ns", m);').parameters
    assert (str(one.name), one.name.pattern) == ("ns.{a parameter of a list that is not evaluated}", "ns.*")
    (facts,) = units(a_py=PYTHON % "self.declare_parameters('', [('a', 1), made()] )")
    assert [one.name.pattern for one in facts.parameters] == ["a", "*"]


def test_a_helper_that_declares_what_it_is_given_is_not_the_place(node_of):
    helper = """
template<typename NodeT>
void declare_it(NodeT node, const std::string & name, const rclcpp::ParameterValue & value) {
  if (!node->has_parameter(name)) { node->declare_parameter(name, value); }
}
"""
    (one,) = node_of(
        'declare_it(this, "x", rclcpp::ParameterValue(std::vector<double>{0.5}));', before=helper
    ).parameters
    assert (one.type, one.evidence.line) == ("double_array", 10)


def test_what_reading_tells_of_the_type(node_of):
    body = text(
        'V<double> v; get_parameter("a", v); std::string s; get_parameter("b", s); double d; get_parameter("c", d);'
        'get_parameter_or("d", v, V<double>{1.0}); get_parameter_or<int>("e", i, 5);'
    )
    assert told(node_of(body).parameters) == [
        ("read", "a", "double_array", None),
        ("read", "b", "string", None),
        ("read", "c", "", None),
        ("read", "d", "double_array", "[1.0]"),
        ("read", "e", "int", "5"),
    ]


PYTHON = """
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
class A(Node):
    def __init__(self):
        super().__init__('a')
        %s
"""


@pytest.mark.parametrize(
    ("call", "type_", "default", "dynamic"),
    [
        ("declare_parameter('x', ['a', 'b'])", "string_array", "[a, b]", False),
        # rclpy takes an empty list for one of bytes.
        ("declare_parameter('x', [])", "byte_array", "[]", False),
        ("declare_parameter('x', (1.0, 2.0))", "double_array", "[1.0, 2.0]", False),
        ("declare_parameter('x', [1, 2.0])", "list", "[1, 2.0]", False),
        ("declare_parameter('x', Parameter.Type.STRING_ARRAY)", "string_array", None, False),
        ("declare_parameter('x', rclpy.Parameter.Type.DOUBLE)", "double", None, False),
        ("declare_parameter('x')", "", None, True),
        ("declare_parameter('x', None)", "", None, True),
        ("declare_parameters('', [('x', [True])])", "bool_array", "[true]", False),
        ("declare_parameters('', [('x', Parameter.Type.INTEGER_ARRAY)])", "int_array", None, False),
        ("declare_parameters('', [('x',)])", "", None, True),
    ],
)
def test_what_rclpy_declares(units, call, type_, default, dynamic):
    (facts,) = units(a_py=PYTHON % f"self.{call}")
    assert told(facts.parameters) == [("declared", "x", type_, default)]
    assert facts.parameters[0].terms.dynamic is dynamic


def test_what_rclpy_reads_else(units):
    (facts,) = units(a_py=PYTHON % "y = self.get_parameter_or('x', Parameter('x', Parameter.Type.INTEGER, 5)).value")
    assert told(facts.parameters) == [("read", "x", "int", "5")]
