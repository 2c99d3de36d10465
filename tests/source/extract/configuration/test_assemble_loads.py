from roslens.model.graph import Role
from roslens.source.extract.configuration.assemble import assemble
from roslens.source.extract.configuration.assemble_units import KnownUnits
from roslens.source.extract.facts.launched import Launch, Launched, Remap, Setting
from roslens.source.extract.facts.node_facts import (
    EndpointFact,
    Evidence,
    LoadFact,
    NodeFacts,
    ParameterFact,
    Target,
    TargetKind,
)
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.reason import NamePart, OfNode, OfParameter
from roslens.source.extract.symbolic.text import Hole, Text, Written, unknown

START, MAIN, CLASS = Evidence("pkg/a.launch", 3), Evidence("pkg/src/main.cpp", 12), Evidence("pkg/src/half.cpp", 5)
OWN_NAME = Text((Hole(OfNode(NamePart.FULL_NAME), default="~"),))
HALF = NodeFacts(
    "pkg.Half", CLASS.path, 1, "ros1", "nodelet",
    endpoints=(
        EndpointFact(Role.SUBSCRIPTION, Text.of("image"), Text.of("sensor_msgs/Image"), CLASS),
        EndpointFact(Role.PUBLISHER, Text.of("~/half"), Text.of("sensor_msgs/Image"), CLASS),
    ),
    parameters=(ParameterFact(Text.of("~/scale"), CLASS, "read"),),
)  # fmt: skip
TARGETS = (
    Target(TargetKind.EXECUTABLE, "pkg", "process", (MAIN.path,), MAIN),
    Target(TargetKind.NODELET, "pkg", "pkg/half", (CLASS.path,), CLASS, entry="pkg::Half"),
)


def configuration(*loads, **of_launched):
    main = NodeFacts("main", MAIN.path, 1, "ros1", name=Text.of("process"), loads=loads)
    started = Launched(Text.of("pkg"), Text.of("process"), START, namespace=Text.of("/front"), **of_launched)
    return assemble(Launch("ros1", (started,)), KnownUnits({"pkg": TARGETS}, (main, HALF)), title="t")


def load(name, *remaps, **others):
    return LoadFact(name, Text.of("pkg/half"), MAIN, remaps, **others)


def explicit(node):
    return [one.endpoint.name for one in node.endpoints if not one.implicit]


def test_a_nodelet_is_part_of_the_process_that_loads_it():
    loaded = load(Text.of(OWN_NAME, "_half"), (Text.of("image"), Text.of("color")), conditions=(Written("on"),))
    process, half = configuration(loaded, name=Text.of("p")).nodes
    assert (half.name, half.kind, half.container) == ("/front/p_half", "nodelet", "/front/p")
    assert (as_written(half.conditions), half.unit) == (("on",), "pkg.Half")
    assert explicit(half) == ["/front/p_half/half", "/front/color"]
    assert process.remaps == ()


def test_the_graph_shows_one_process():
    graph = configuration(load(Text.of(OWN_NAME, "_half"))).graph(implicit=False)
    assert [one.name for one in graph.nodes] == ["/front/process"]
    assert {one.node for one in graph.endpoints} == {"/front/process"}


def test_remappings_of_the_process_hold_where_the_nodelet_has_none():
    remap = Remap(Text.of("image"), Text.of("raw"), START)
    half, process = configuration(load(Text.of("half")), remaps=(remap,), arguments=(Text.of("x:=y"),)).nodes
    assert "/front/raw" in explicit(half)
    assert [(one.source, one.used) for one in process.remaps] == [("x", False), ("image", True)]
    half, _ = configuration(load(Text.of("half"), (Text.of("image"), Text.of("own"))), remaps=(remap,)).nodes
    assert "/front/own" in explicit(half)


def test_a_nodelet_of_the_name_of_its_process_has_its_parameters():
    settings = (Setting(Text.of("~scale"), Text.of("2"), START),)
    nodes = configuration(load(OWN_NAME), settings=settings).nodes
    assert [(one.name, one.kind) for one in nodes] == [("/front/process", "node"), ("/front/process", "nodelet")]
    assert [(one.name, one.value) for one in nodes[1].parameters] == [("/front/process/scale", "2")]


def test_unknown_remappings_leave_no_name_certain():
    half, _ = configuration(load(Text.of("half"), (unknown("a map"), unknown("a map")))).nodes
    assert {one.proof.sure for one in half.endpoints if not one.implicit} == {"possible"}


def test_a_name_that_is_unknown():
    unresolved = configuration(load(unknown(OfParameter("name")))).nodes
    assert [one.resolved for one in unresolved] == [False, True]


def test_a_class_that_is_unknown_is_said():
    found = configuration(LoadFact(Text.of("half"), unknown(OfParameter("type")), MAIN))
    assert [one.reason.partition(";")[0] for one in found.unresolved] == ["the class is unknown: {parameter type}"]
