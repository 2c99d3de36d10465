import pytest

from roslens.model.configuration import Proof
from roslens.model.finding import Severity
from roslens.model.weight.consequence import Consequence
from roslens.source.rules.graph.parameters.parameter_type import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, launched, node, parameter


def findings(wanted, given, *, value="1", access="declared", path="src/a.cpp", generation="ros2", **more):
    one = parameter(
        "rate",
        type=wanted,
        set_type=given,
        value=value,
        access=access,
        proof=Proof(path, 5),
        set_by=launched(3, "a.yaml"),
        **more,
    )
    return list(found(configuration(node("/a", parameters=(one,)), generation=generation), Surroundings()))


def test_an_integer_for_a_double_stops_a_node_of_ros2():
    (one,) = findings("double", "int", value="30")
    assert one.severity is Severity.ERROR
    assert (one.path, one.line) == ("a.yaml", 3)
    assert one.message == (
        "parameter `rate` of /a is set as int (`30`); src/a.cpp:5 declared it as double: the node does not start. "
        "Write `30.0`."
    )


@pytest.mark.parametrize(
    ("wanted", "given"), [("double", "double"), ("", "int"), ("int", ""), ("int_array", "list"), ("list", "int")]
)
def test_what_fits_or_is_unknown_is_none(wanted, given):
    assert not findings(wanted, given)


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_code_that_takes_it_with_another_type_too_takes_it(generation):
    access = "read" if generation == "ros1" else "declared"
    assert not findings("int", "string", access=access, generation=generation, other_types=("string",))
    assert not findings("int", "string", access=access, generation=generation, other_types=("",))
    assert findings("int", "string", access=access, generation=generation, other_types=("bool",))


def test_ros1_converts_numbers_and_takes_the_default_otherwise():
    assert not findings("double", "int", access="read", generation="ros1")
    (one,) = findings("bool", "string", value="yes please", access="read", generation="ros1")
    assert one.severity is Severity.WARNING
    assert one.consequence is Consequence.WRONG, "nothing ends for it"
    assert "the default is used" in one.message
    assert not findings("bool", "string", access="read", path="src/a.py", generation="ros1")


def test_an_empty_list_of_python_is_one_of_bytes():
    one = parameter(
        "names", type="byte_array", set_type="string_array", value="[a]", default="[]", access="declared",
        proof=Proof("src/a.py", 5), set_by=launched(3, "a.yaml"),
    )  # fmt: skip
    (told,) = found(configuration(node("/a", parameters=(one,))), Surroundings())
    assert told.message.endswith("declare it with `rclpy.Parameter.Type.STRING_ARRAY`.")


def test_a_parameter_of_any_type_takes_any():
    one = parameter(
        "x", type="int", set_type="string", value="a", access="declared", dynamic=True,
        proof=Proof("src/a.cpp", 5), set_by=launched(3, "a.yaml"),
    )  # fmt: skip
    assert not list(found(configuration(node("/a", parameters=(one,))), Surroundings()))


TAKEN = {"set_value": "fast", "written_by": Proof("src/a.cpp", 9, sure="likely")}


def test_a_server_of_roscpp_takes_its_default_for_what_does_not_fit():
    (one,) = findings("double", "string", value="7.0", path="cfg/A.cfg", generation="ros1", **TAKEN)
    assert one.message == (
        "parameter `rate` of /a is set as string (`fast`); cfg/A.cfg:5 declared it as double: the default is used. "
        "Write a value of type double."
    )


@pytest.mark.parametrize("path", ["cfg/A.cfg", "src/limits.py"])
def test_a_server_of_rospy_takes_what_is_set(path):
    assert not findings("double", "string", path=path, generation="ros1")


def test_code_that_writes_a_parameter_does_not_mind_its_type():
    assert not findings("double", "string", access="written", generation="ros1")
