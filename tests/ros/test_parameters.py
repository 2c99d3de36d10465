"""What source says of parameters, and of values in files, against a node of rclpy that declares and is given them."""

import json
import os
import subprocess

import pytest

from roslens.judge.documents.yaml_tree import read_tree
from roslens.live.adapters.child import clean_environment
from roslens.source.extract.facts.resolve_name import node_pattern_matches
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.parameters.ros2_values import is_mixed, type_in_file
from roslens.source.extract.units.workspace_units import facts_of_workspace

pytestmark = pytest.mark.real

NODE = """
import json
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

class Declaring(Node):
    def __init__(self):
        super().__init__('declaring', start_parameter_services=False, enable_rosout=False)
        self.declare_parameter('a', True)
        self.declare_parameter('b', 1)
        self.declare_parameter('c', 1e-3)
        self.declare_parameter('d', 'text')
        self.declare_parameter('e', ['left', 'right'])
        self.declare_parameter('f', [])
        self.declare_parameter('g', [0.5])
        self.declare_parameter('h', (1, 2))
        self.declare_parameter('i', [False])
        self.declare_parameter('j', Parameter.Type.STRING_ARRAY)
        self.declare_parameter('k', rclpy.Parameter.Type.DOUBLE)
        self.declare_parameter('l')
        self.declare_parameter('m', descriptor=ParameterDescriptor(dynamic_typing=True))
        self.declare_parameters('n', [('x', 1), ('y', [1.5]), ('z', Parameter.Type.INTEGER_ARRAY)])
        self.declare_parameter('o', 5, ParameterDescriptor(
            description='how many', read_only=True, integer_range=[IntegerRange(from_value=1, to_value=9)]))
        described = ParameterDescriptor()
        described.floating_point_range = [FloatingPointRange(from_value=-1.0, to_value=1.5)]
        described.additional_constraints = 'even'
        self.declare_parameter('p', 0.5, described)

if __name__ == '__main__':
    rclpy.init()
    node, found = Declaring(), {}
    for name, one in node._descriptors.items():
        ranges = [f'{r.from_value}..{r.to_value}' for r in (*one.integer_range, *one.floating_point_range)]
        found[name] = [one.type, ranges, one.description, one.read_only, one.dynamic_typing, one.additional_constraints]
    print(json.dumps(found))
"""
TYPES = ("", "bool", "int", "double", "string", "byte_array", "bool_array", "int_array", "double_array", "string_array")
GIVEN = """
import json, sys, tempfile
import rclpy
from rclpy.node import Node

def told(text, name, space):
    with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
        file.write(text)
        file.flush()
        context = rclpy.Context()
        try:
            rclpy.init(context=context)
            node = Node(name, namespace=space, context=context, cli_args=['--ros-args', '--params-file', file.name],
                        automatically_declare_parameters_from_overrides=True, start_parameter_services=False,
                        enable_rosout=False)
        except Exception:
            return 'refused'
        known = node._parameters.get('x')
        node.destroy_node()
        context.shutdown()
        return known.type_.name if known is not None else ''

print(json.dumps([told(*one) for one in json.loads(sys.stdin.read())]))
"""
NAMES = {"BOOL": "bool", "INTEGER": "int", "DOUBLE": "double", "STRING": "string", "BOOL_ARRAY": "bool_array",
         "INTEGER_ARRAY": "int_array", "DOUBLE_ARRAY": "double_array", "STRING_ARRAY": "string_array"}  # fmt: skip
WRITTEN = (
    "true|True|TRUE|tRue|yes|No|ON|off|y|N|1|-1|+1|0x1F|017|08|0o17|0b11|1_000|1e-3|1E3|.5|5.|-.5|.inf|-.Inf|+.INF|inf|.nan|NaN"
    "|infinity|~|null|''|'1'|\"true\"|a b|9223372036854775807|9223372036854775808|1.0f|0x1p3|12:30|2001-01-01|1e400|."
    "|[1, 2]|[1, 2.0]|[.5, 1e-3]|[a, b]|['1', '2']|['1', 2]|[yes, true]|[true, 1]|[~, a]|[1.0, a]"
)
VALUES = tuple(WRITTEN.split("|"))
PATTERNS = ("/**", "/*", "/*/n", "/**/n", "/n", "n", "/ns/n", "ns/n", "*", "**", "/ns/*", "/ns/**", "/**/*", "/*/*",
            "/a/**/n", "/ns", "/**/ns/**", "/**/ns/n")  # fmt: skip
PLACES = (("n", ""), ("n", "/ns"), ("n", "/a/b"), ("other", "/ns"))


def run(python, code, given=""):
    """Return what a program of that Python prints."""
    environment = {**clean_environment(os.environ), "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"}
    done = subprocess.run(
        [python, "-c", code], input=given, env=environment, capture_output=True, text=True, check=False, timeout=300
    )
    assert not done.returncode, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_declarations_are_what_a_node_has(ros2_python):
    real = {name: one for name, one in run(ros2_python, NODE).items() if name != "use_sim_time"}
    real = {name: one for name, one in real.items() if "service" not in name}
    (facts,) = [
        one
        for one in facts_of_workspace(indexed({"pkg/a.py": program_of_python(NODE.encode())}))
        if one.unit == "Declaring"
    ]
    assert {
        str(one.name): [
            TYPES.index(one.type), [one.range] * bool(one.range), one.description, one.terms.read_only,
            one.terms.dynamic, "".join(one.terms.constraints),
        ]
        for one in facts.parameters
    } == real  # fmt: skip


def test_values_in_files_have_the_type_that_rcl_gives_them(ros2_python):
    files = [(f"/**:\n  ros__parameters:\n    x: {value}\n", "n", "") for value in VALUES]
    real = run(ros2_python, GIVEN, json.dumps(files))
    read = [read_tree(f"x: {value}".encode(), "a.yaml").root.nodes["x"] for value in VALUES]
    mine = ["refused" if is_mixed(node) else type_in_file(node) for node in read]
    assert dict(zip(VALUES, mine, strict=True)) == dict(zip(VALUES, (NAMES.get(one, one) for one in real), strict=True))


def test_patterns_of_files_are_for_the_nodes_that_rcl_gives_them_to(ros2_python):
    asked = [(pattern, name, space) for pattern in PATTERNS for name, space in PLACES]
    files = [(f'"{pattern}":\n  ros__parameters:\n    x: 1\n', name, space) for pattern, name, space in asked]
    real = [bool(one) for one in run(ros2_python, GIVEN, json.dumps(files))]
    mine = [node_pattern_matches(f"/{one.strip('/')}", f"{space}/{name}") for one, name, space in asked]
    assert dict(zip(asked, mine, strict=True)) == dict(zip(asked, real, strict=True))
