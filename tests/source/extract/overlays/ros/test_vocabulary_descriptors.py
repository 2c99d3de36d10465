import pytest

from roslens.source.extract.facts.node_facts import Terms
from roslens.source.extract.overlays.ros.vocabulary_descriptors import described_by, is_descriptor

TYPE = "rcl_interfaces::msg::ParameterDescriptor"


@pytest.mark.parametrize(
    ("body", "range_", "description", "terms"),
    [
        (
            (
                f'{TYPE} d; d.description = "what"; d.read_only = true; d.floating_point_range.resize(1); '
                "d.floating_point_range[0].from_value = 0.5; d.floating_point_range[0].to_value = 2.0; "
                'declare_parameter("x", 1.0, d);'
            ),
            "0.5..2.0",
            "what",
            Terms(read_only=True),
        ),
        (
            (
                f"{TYPE} d; rcl_interfaces::msg::IntegerRange r; r.set__from_value(1).set__to_value(5); "
                'd.integer_range = {r}; declare_parameter("x", 1, d);'
            ),
            "1..5",
            "",
            Terms(),
        ),
        (
            (
                f"auto d = {TYPE}{{}}; rcl_interfaces::msg::IntegerRange r; r.from_value = 1; r.to_value = limit(); "
                'd.integer_range.push_back(r); d.dynamic_typing = true; declare_parameter("x", 1, d);'
            ),
            "",
            "",
            Terms(dynamic=True),
        ),
        (
            f'declare_parameter("x", 1, {TYPE}().set__description("Y").set__read_only(true));',
            "",
            "Y",
            Terms(read_only=True),
        ),
        ('declare_parameter("x", 1);', "", "", Terms()),
    ],
)
def test_descriptors_of_cpp(node_of, body, range_, description, terms):
    (one,) = node_of(body).parameters
    assert (one.range, one.description, one.terms) == (range_, description, terms)


@pytest.mark.parametrize(
    ("field", "declared", "range_"),
    [
        ("integer_range", 'declare_parameter<double>("x", 8, d);', ""),
        ("integer_range", 'declare_parameter("x", 8.0, d);', ""),
        ("integer_range", 'declare_parameter<int>("x", 8, d);', "1..5"),
        ("floating_point_range", 'declare_parameter("x", 8, d);', ""),
        ("floating_point_range", 'declare_parameter<double>("x", 8, d);', "1..5"),
    ],
)
def test_only_the_range_of_the_type_is_checked_by_ros(node_of, field, declared, range_):
    body = f"{TYPE} d; d.{field}.resize(1); d.{field}[0].from_value = 1; d.{field}[0].to_value = 5; {declared}"
    assert [one.range for one in node_of(body).parameters] == [range_]


def test_descriptors_of_python(units):
    text = """
from rclpy.node import Node
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
class A(Node):
    def __init__(self):
        super().__init__('a')
        self.declare_parameter('a', 1, ParameterDescriptor(
            description='first', integer_range=[IntegerRange(from_value=1, to_value=9, step=2)]))
        d = ParameterDescriptor(additional_constraints='even')
        d.read_only = True
        d.floating_point_range = [FloatingPointRange(from_value=-1.0, to_value=1.0)]
        self.declare_parameters('n', [('b', 1.0, d), ('c', 2.0)])
"""
    (facts,) = units(a_py=text)
    assert [(str(one.name), one.range, one.description, one.terms) for one in facts.parameters] == [
        ("a", "1..9", "first", Terms()),
        ("n.b", "-1.0..1.0", "", Terms(read_only=True, constraints=("even",))),
        ("n.c", "", "", Terms()),
    ]


def test_what_is_no_descriptor_says_nothing():
    assert not is_descriptor("text")
    assert described_by([None, "text"]).range == ""
