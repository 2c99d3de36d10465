import pytest

from roslens.source.extract.catalogue.catalogue import known_node
from roslens.source.extract.configuration.assemble import assemble
from roslens.source.extract.configuration.assemble_units import KnownUnits
from roslens.source.extract.facts.launched import Launch, Launched
from roslens.source.extract.facts.node_facts import Evidence, NodeFacts, Target, TargetKind
from roslens.source.extract.launch.process_commands import as_node
from roslens.source.extract.symbolic.text import Text, unknown

START, MAIN = Evidence("a/launch/a.launch.py", 3), Evidence("pkg/src/main.cpp", 1)
UNITS = KnownUnits(
    {"pkg": (Target(TargetKind.EXECUTABLE, "pkg", "prog", (MAIN.path,), MAIN),)},
    (NodeFacts("main", MAIN.path, 1, "ros2", name=Text.of("own")),),
)


def process(*words):
    first, *rest = (Text.of(one) if isinstance(one, str) else one for one in words)
    return Launched(Text(), first, START, arguments=tuple(rest), kind="process")


def configured(*words):
    return assemble(Launch("ros2", (process(*words),)), UNITS, title="t", known=known_node)


@pytest.mark.parametrize(
    "words",
    [("ros2", "run", "pkg", "prog", "--ros-args", "-r", "__node:=it"), ("ros2 run pkg prog --ros-args -r __node:=it",)],
)
def test_a_program_that_is_run_is_a_node(words):
    (node,) = configured(*words).nodes
    assert (node.name, node.kind, node.package, node.executable) == ("/it", "node", "pkg", "prog")


@pytest.mark.parametrize(
    ("words", "role", "name", "kind"),
    [
        (("topic", "pub", "-r", "5", "/x", "std_msgs/msg/Bool", "data: true"), "publisher", "/x", "std_msgs/msg/Bool"),
        (("topic", "echo", "/x", "--once"), "subscription", "/x", ""),
        (("service", "call", "/s", "std_srvs/srv/Empty"), "service_client", "/s", "std_srvs/srv/Empty"),
        (("action", "send_goal", "/a", "p/action/Do", "{}"), "action_client", "/a", "p/action/Do"),
    ],
)
def test_a_command_is_a_node_as_long_as_it_runs(words, role, name, kind):
    found = configured("ros2", *words)
    (node,) = found.nodes
    assert node.name == "/_ros2cli_*"
    assert node.anonymous
    (one,) = [one for one in node.endpoints if not one.implicit]
    assert (one.endpoint.role.value, one.endpoint.name, one.endpoint.type) == (role, name, kind)
    assert not any("no node" in one.reason for one in found.unresolved)


def test_a_command_may_be_given_a_name():
    (node,) = configured("ros2", "topic", "pub", "-n", "mine", "/x", "std_msgs/msg/Bool").nodes
    assert (node.name, node.anonymous) == ("/mine", False)


@pytest.mark.parametrize(
    "words",
    [
        ("ros2", "bag", "record", "-a"), ("ros2",), ("ros2", "topic"), ("ros2", "topic", "list"),
        ("gazebo", "-s"), ("ros2 run 'pkg",),
        ("ros2", "run", "--prefix", "gdb", "pkg", "prog"), (unknown("a command"), "run", "pkg", "prog"),
    ],
)  # fmt: skip
def test_what_is_not_known_stays_a_process(words):
    assert as_node(process(*words)) is None
    assert [one.opens for one in configured(*words).unresolved] == [True]
