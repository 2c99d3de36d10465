import msgspec
import pytest

from roslens.model.configuration import Proof
from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.parameter_topic import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, launched, node, parameter

CODE = Proof("src/a.cpp", 5)
FILE = launched(3, "launch/a.launch")


def findings(name, value, *ends, access="", others=(), whole=True, **more):
    one = parameter(name, value=value, set_by=FILE, access=access, proof=CODE if access else None)
    nodes = (node("/driver", end("pub", "/driver/path"), *ends, parameters=(one,)), *others)
    return list(found(configuration(*nodes, **more), Surroundings(whole=whole)))


def test_what_may_be_started_beside_it_is_a_note():
    assert [one.severity for one in findings("path_topic", "/opponent/path", whole=False)] == [Severity.NOTE]


def test_a_topic_in_a_namespace_that_is_not_there():
    (one,) = findings("path_topic", "/opponent/path")
    assert (one.path, one.line, one.severity) == ("launch/a.launch", 3, Severity.WARNING)
    assert one.entity == "parameter:/driver:path_topic"
    assert one.message == (
        "parameter `path_topic` is set to `/opponent/path`, a topic that no node has: there is no node and no name in "
        "`/opponent`. /driver is not known to use the parameter. Correct the name, or start the node that has the "
        "topic."
    )
    assert "is not known to use" not in findings("path_topic", "/opponent/path", access="declared")[0].message


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("path_topic", "/driver/path"),
        ("path_topic", "/driver/other"),
        ("path_topic", "opponent/path"),
        ("path_topic", "/opponent"),
        ("path_topic", "/opponent/a file.txt"),
        ("path", "/opponent/path"),
        ("topics", "/opponent/path"),
        ("path_topic", "/robot/diagnostics"),
        ("path_topic", None),
    ],
)
def test_what_may_be_right_is_silent(name, value):
    assert not findings(name, value)


def test_unknown_names_and_nodes_may_have_it():
    assert not findings("path_topic", "/opponent/path", end("sub", "/*/path", resolved=False))
    (one,) = findings("path_topic", "/opponent/path", others=(node("/b", known=False),))
    assert one.severity is Severity.NOTE
    assert "In doubt: the topics of /b are unknown." in one.message
    assert not findings("path_topic", "/opponent/path", others=(node("/opponent", end("pub", "/x")),))


def test_of_a_node_whose_code_is_unknown_nothing_is_told():
    one = parameter("path_topic", value="/opponent/path", set_by=FILE)
    nodes = (node("/a", known=False, parameters=(one,)), node("/b", parameters=(one,)))
    assert not list(found(configuration(*nodes), Surroundings()))


def test_in_ros1_a_node_tells_its_own_parameters():
    assert findings("/driver/path_topic", "/opponent/path", generation="ros1")
    assert not findings("/other/path_topic", "/opponent/path", generation="ros1")


def test_nothing_is_told_of_targets_that_stand_alone():
    one = parameter("path_topic", value="/opponent/path", set_by=FILE)
    alone = msgspec.structs.replace(node("/driver", end("pub", "/x"), parameters=(one,)), proof=CODE)
    assert not list(found(configuration(alone), Surroundings()))
