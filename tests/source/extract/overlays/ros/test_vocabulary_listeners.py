import pytest

from roslens.source.extract.facts.node_facts import Sure
from roslens.source.extract.parameters.parameter_library import parameter_library
from roslens.source.extract.units.workspace_units import facts_of_workspace

FILE = b"""\
demo:
  joints: {type: string_array, default_value: [left, right]}
  gains:
    __map_joints:
      p: {type: double, default_value: 1.0, validation: {gt<>: 0.0}}
  out: {type: string, default_value: state, description: "Where to", read_only: true}
  command:
    topic: {type: string}
"""
CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include "pkg/demo_parameters.hpp"
namespace demo {
class A : public rclcpp::Node { public: A() : Node("a") {
%s
}
std::shared_ptr<ParamListener> listener_;
Params params_;
};
}
"""


@pytest.fixture
def declared(index_of):
    """Return the facts of a node whose constructor has this body; libraries by package and content."""

    def make(body, *libraries, text=CPP, ending="cpp"):
        index = index_of(**{f"a_{ending}": text % body})
        known = libraries or (("demo_parameters", "pkg", FILE),)
        index.parameter_libraries = tuple(
            parameter_library(target, package, f"{package}/{target}.yaml", content, python=ending == "py")
            for target, package, content in known
        )
        return next(one for one in facts_of_workspace(index) if one.unit.endswith("A"))

    return make


def test_a_listener_declares_what_its_file_says(declared):
    facts = declared("listener_ = std::make_shared<ParamListener>(get_node_parameters_interface());")
    assert [(str(one.name), one.type, one.default and one.default.known, one.range) for one in facts.parameters] == [
        ("joints", "string_array", "[left, right]", ""),
        ("out", "string", "state", ""),
        ("command.topic", "string", None, ""),
        ("gains.{each of parameter joints}.p", "double", "1.0", ">0.0.."),
    ]
    out = facts.parameters[1]
    assert (out.evidence.path, out.evidence.line) == ("pkg/demo_parameters.yaml", 6)
    assert out.evidence.how == "declared by the ParamListener created at pkg/a.cpp:7"
    assert (out.description, out.terms.read_only, out.evidence.sure) == ("Where to", True, Sure.CERTAIN)
    assert facts.parameters[3].evidence.sure is Sure.LIKELY
    assert facts.unresolved == ()


@pytest.mark.parametrize(
    "made",
    [
        "auto listener = ParamListener(shared_from_this());",
        "demo::ParamListener listener(this);",
        "auto listener = std::make_shared<demo::ParamListener>(shared_from_this(), get_logger());",
        "auto listener = std::make_unique<ParamListener>(this->get_node_parameters_interface(), this->get_logger());",
    ],
)
def test_ways_to_make_one(declared, made):
    assert [str(one.name) for one in declared(made).parameters][:2] == ["joints", "out"]


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ('this, "left"', "left.joints"),
        ('this, "left."', "left.joints"),
        ('this, ""', "joints"),
        ('this, get_logger(), "left"', "left.joints"),
        ("this, what()", "{result of what()}.joints"),
    ],
)
def test_a_prefix_stands_before_names(declared, arguments, name):
    assert str(declared(f"ParamListener listener({arguments});").parameters[0].name) == name


def test_parameters_decide_names(declared):
    facts = declared(
        "listener_ = std::make_shared<ParamListener>(shared_from_this()); params_ = listener_->get_params();"
        'create_publisher<std_msgs::msg::String>("~/" + params_.out, 1);'
        "create_publisher<std_msgs::msg::String>(params_.command.topic, 1);"
        'for (auto & one : params_.joints) { create_publisher<std_msgs::msg::String>(one + "/x", 1); }'
    )
    assert [(str(one.name), one.name.usual) for one in facts.endpoints] == [
        ("~/{parameter out}", "~/state"),
        ("{parameter command.topic}", None),
        ("{each of parameter joints}/x", None),
    ]
    assert [hole.parameter for one in facts.endpoints for hole in one.name.holes] == ["out", "command.topic", "joints"]


def test_a_listener_of_python(declared):
    text = """
from rclpy.node import Node
from std_msgs.msg import String
from pkg.demo_parameters import demo
class A(Node):
    def __init__(self):
        super().__init__('a')
        %s
        self.create_publisher(String, self.params.out, 1)
"""
    body = "self.listener = demo.ParamListener(self); self.params = self.listener.get_params()"
    facts = declared(body, text=text, ending="py")
    assert [str(one.name) for one in facts.parameters][:2] == ["joints", "out"]
    assert [one.name.usual for one in facts.endpoints] == ["state"]


def test_what_no_build_makes_is_unknown(declared):
    facts = declared(
        "listener_ = std::make_shared<ParamListener>(shared_from_this());", ("p", "q", b"other: {a: {type: int}}")
    )
    assert (facts.parameters, [why for _, why in facts.unresolved]) == (
        (),
        ["the parameters of ParamListener are unknown: no build of the workspace generates ParamListener"],
    )
    facts = declared("listener_ = std::make_shared<ParamListener>(shared_from_this());", ("p", "pkg", b"["))
    assert "pkg/p.yaml" in facts.unresolved[0][1]


def test_of_two_of_one_namespace_that_of_the_package_or_the_header_counts(declared):
    body = "listener_ = std::make_shared<ParamListener>(shared_from_this());"
    other = b"demo: {x: {type: int}}"
    facts = declared(body, ("demo_parameters", "pkg", FILE), ("demo_parameters", "other", other))
    assert [str(one.name) for one in facts.parameters][:1] == ["joints"]
    facts = declared(body, ("more_parameters", "pkg", other), ("demo_parameters", "pkg", FILE))
    assert [str(one.name) for one in facts.parameters][:1] == ["joints"]
    facts = declared(body, ("more_parameters", "q", other), ("some_parameters", "q", FILE))
    assert (facts.parameters, len(facts.unresolved)) == ((), 1)
