import msgspec

from roslens.model.configuration import (
    Configuration,
    ConfiguredNode,
    ConfiguredParameter,
    Missing,
    Origin,
    Proof,
    Unresolved,
)
from roslens.report.graph.graph_text import to_graph_text


def test_a_node_tells_what_it_does_and_from_where(graph):
    text = to_graph_text(graph)
    lines = text.splitlines()
    assert lines[0] == "pkg/launch/a.launch.py: ros2, 2 nodes, 3 topics"
    assert "    x: must be given  an argument" in lines
    assert "/ns/talker  (pkg/talker)  pkg/launch/a.launch.py:7" in lines
    assert "  if use_it" in lines
    assert any("/chatter" in one and "reliable, depth 10" in one and "pkg/src/a.cpp:12" in one for one in lines)


def test_what_is_not_certain_has_a_mark_that_is_told(graph):
    lines = to_graph_text(graph).splitlines()
    assert any(one.strip().startswith("? /in/*") and "type unknown" in one for one in lines)
    assert any(one.strip().startswith("~ /chatter") and "default of parameter topic" in one for one in lines)
    assert lines[-1].startswith("? a part of the name is unknown")


def test_parameters_say_what_sets_them(graph):
    text = to_graph_text(graph)
    assert "set in pkg/launch/a.launch.py:7, default 1" in text
    assert "set, but no code is known to take it" in text
    assert "chater to /never" in text


def test_parameters_say_what_code_writes_them(graph):
    server = Proof("pkg/src/a.cpp", 9, sure="likely")
    by_code = Proof("pkg/src/a.cpp", 12, how="while the node runs", sure="likely")
    declared = Proof("pkg/cfg/A.cfg", 4)
    launch = Proof("pkg/launch/a.launch", 7)
    changed = msgspec.structs.replace(by_code, how="`12` is above the maximum")
    parameters = (
        ConfiguredParameter("/n/a", "1", "int", "1", access="declared", proof=declared, written_by=server),
        ConfiguredParameter("/n/b", "9", "int", "1", proof=declared, set_by=launch, written_by=changed),
        ConfiguredParameter("/n/c", "2", "int", access="written", proof=by_code, written_by=by_code),
    )
    node = msgspec.structs.replace(graph.nodes[0], parameters=parameters)
    text = to_graph_text(msgspec.structs.replace(graph, nodes=(node,)))
    assert "pkg/cfg/A.cfg:4 by pkg/src/a.cpp:9" in text
    assert "set in pkg/launch/a.launch:7, written in pkg/src/a.cpp:12: `12` is above the maximum, default 1" in text
    assert "int, likely: while the node runs" in text


def test_parameters_that_are_not_certain_have_a_mark(graph):
    parameters = (
        ConfiguredParameter("sure", "1", "int", proof=Proof("pkg/src/a.cpp", 9)),
        ConfiguredParameter("taken", "1", "int", proof=Proof("pkg/src/a.cpp", 10, sure="likely")),
        ConfiguredParameter("*", "1", "int", proof=Proof("pkg/src/a.cpp", 11)),
    )
    node = msgspec.structs.replace(graph.nodes[0], parameters=parameters, endpoints=())
    lines = to_graph_text(msgspec.structs.replace(graph, nodes=(node,))).splitlines()
    assert lines[0] == "pkg/launch/a.launch.py: ros2, 1 node, 0 topics"
    assert [one.split("=")[0].strip() for one in lines if "= 1" in one] == ["sure", "~ taken", "? *"]


def test_what_is_unresolved_is_always_listed(graph):
    text = to_graph_text(graph)
    assert "unresolved: 1" in text
    assert "/ns/talker: the name of this publisher depends on t" in text


def test_nothing_that_a_terminal_would_obey_is_written(graph):
    text = to_graph_text(msgspec.structs.replace(graph, title="a\x1b[31m\u202eb"))
    assert "\x1b" not in text
    assert "\u202e" not in text


def test_overrides_that_nobody_sets_are_counted(graph):
    launch = Proof("pkg/launch/a.launch.py", 7)
    names = [f"qos_overrides./chatter.publisher.{one}" for one in ("depth", "history", "reliability")]
    parameters = tuple(ConfiguredParameter(name, "1", access="declared", proof=launch) for name in names)
    given = msgspec.structs.replace(parameters[0], set_by=launch)
    node = msgspec.structs.replace(graph.nodes[0], parameters=(given, *parameters[1:]))
    text = to_graph_text(msgspec.structs.replace(graph, nodes=(node,)))
    assert names[0] in text
    assert names[1] not in text
    assert "qos_overrides.* (2)" in text


def test_a_long_reason_is_cut(graph):
    end = graph.nodes[0].endpoints[0]
    long = msgspec.structs.replace(end, proof=msgspec.structs.replace(end.proof, how="why " * 100))
    node = msgspec.structs.replace(graph.nodes[0], endpoints=(long,))
    lines = to_graph_text(msgspec.structs.replace(graph, nodes=(node,))).splitlines()
    assert any("why why" in line and line.endswith("…)") for line in lines)
    assert max(map(len, lines)) < 300


def test_what_every_node_takes_and_what_is_empty_is_said(graph):
    launch = Proof("pkg/launch/a.launch.py", 70)
    parameters = (
        ConfiguredParameter("use_sim_time", "true", set_type="bool", set_by=launch),
        ConfiguredParameter("prefix", "", set_type="string", set_by=launch),
    )
    node = msgspec.structs.replace(graph.nodes[0], parameters=parameters)
    lines = to_graph_text(msgspec.structs.replace(graph, nodes=(node,))).splitlines()
    (clock,) = (line for line in lines if "use_sim_time" in line)
    assert "no code is known" not in clock
    (prefix,) = (line for line in lines if " prefix " in line)
    assert '= ""' in prefix
    assert "no code is known" in prefix
    assert "  parameters" in lines


def test_where_what_starts_a_node_is_not_wholly_known_neither_are_its_parameters(graph):
    node = graph.nodes[0]
    missing = msgspec.structs.replace(graph.unresolved[0], proof=node.proof)
    one = ConfiguredParameter("a", "1", "int", access="declared", proof=node.proof)
    nodes = (msgspec.structs.replace(node, parameters=(one,)),)
    text = to_graph_text(msgspec.structs.replace(graph, nodes=nodes, unresolved=(missing,)))
    assert "  parameters, as far as is known" in text.splitlines()


def test_a_name_that_is_guessed_is_marked_and_its_settings_are_not_doubted():
    started = Proof("pkg/launch/a.launch.py", 7, sure="likely", origin=Origin.LAUNCH)
    setting = ConfiguredParameter("rate", value="1", set_by=Proof("pkg/launch/a.launch.py", 7))
    node = ConfiguredNode(
        "/spawner", started, package="p", executable="spawner", conditions=("sim", "sim"), parameters=(setting,)
    )
    missing = Unresolved("p/spawner", started, "package p is not in the workspace")
    text = to_graph_text(Configuration("a", "ros2", (node,), unresolved=(missing,)))
    assert "\n~ /spawner  (p/spawner)" in text
    assert text.count("if sim") == 1
    assert "no code is known" not in text


def test_names_that_depend_on_what_the_name_of_their_node_depends_on_are_told_with_it():
    place = Proof("pkg/launch/a.launch.py", 7, origin=Origin.LAUNCH)
    code = Proof("pkg/src/a.cpp", 3)
    own = Unresolved(
        "/{space}/a", place, "the node's name depends on space", "/*/a", missing=Missing.NODE_NAME, cause="space"
    )

    def publisher(name, cause, node="/*/a"):
        reason = f"the name of this publisher depends on {cause}"
        return Unresolved(name, code, reason, node, missing=Missing.ENDPOINT_NAME, cause=cause)

    below = [publisher(name, "space") for name in ("b", "c")]
    other, elsewhere = publisher("d", "parameter d"), publisher("e", "space", "/e")
    node = ConfiguredNode("/*/a", place, resolved=False)
    text = to_graph_text(Configuration("a", "ros2", (node,), unresolved=(own, *below, other, elsewhere)))
    lines = text.splitlines()
    first = lines.index("unresolved: 5") + 1
    assert lines[first].endswith(
        '7  /*/a: the node\'s name depends on space, and 2 of its endpoints with it "/{space}/a"'
    )
    assert lines[first + 1 : first + 4] == [
        '  pkg/src/a.cpp:3  /*/a: the name of this publisher depends on parameter d "d"',
        '  pkg/src/a.cpp:3  /e: the name of this publisher depends on space "e"',
        "",
    ]
