import msgspec
import pytest

from roslens.model.configuration import Origin
from roslens.model.graph import Role
from roslens.source.extract.catalogue.catalogue import known_node
from roslens.source.extract.configuration.assemble import assemble, targets_started
from roslens.source.extract.configuration.assemble_units import KnownUnits
from roslens.source.extract.facts.launched import Argument, Launch, Launched, Remap, Setting, Unresolved
from roslens.source.extract.facts.meant import Meant
from roslens.source.extract.facts.node_facts import (
    EndpointFact,
    Evidence,
    Inherits,
    NodeFacts,
    ParameterFact,
    Sure,
    Target,
    TargetKind,
)
from roslens.source.extract.symbolic.reason import MAKER, NamePart, OfEnvironment, OfNode, OfParameter
from roslens.source.extract.symbolic.text import Hole, IsSet, Text, Written

CODE = Evidence("pkg/src/talker.cpp", 12, 5)
START = Evidence("pkg/launch/a.launch.py", 7, 3)
YAML = Evidence("pkg/config/a.yaml", 4, 7)


def end(role: Role, name: Text | str, kind: str = "std_msgs/msg/String", line: int = 12, **others) -> EndpointFact:
    text = name if isinstance(name, Text) else Text.of(name)
    return EndpointFact(role, text, Text.of(kind), msgspec.structs.replace(CODE, line=line), **others)


def parameter_name(name: str, default: str | None = None) -> Text:
    return Text((Hole(OfParameter(str(name)), name, default),))


def talker(**others) -> NodeFacts:
    facts = {"endpoints": (end(Role.PUBLISHER, "chatter"),), "name": Text.of("talker")} | others
    return NodeFacts("main", "pkg/src/talker.cpp", 10, facts.pop("generation", "ros2"), **facts)


TARGET = Target(TargetKind.EXECUTABLE, "pkg", "talker", ("pkg/src/talker.cpp",), Evidence("pkg/CMakeLists.txt", 9))


def started(**others) -> Launched:
    return Launched(Text.of("pkg"), Text.of("talker"), START, **others)


def configured(facts, *launched, targets=(TARGET,), generation="ros2", known=None, **of_launch):
    units = KnownUnits({"pkg": targets}, facts if isinstance(facts, tuple) else (facts,))
    return assemble(Launch(generation, tuple(launched), **of_launch), units, title="test", known=known)


def only(configuration):
    (node,) = configuration.nodes
    return node


def explicit(node):
    return [one for one in node.endpoints if not one.implicit]


def names(node):
    return [one.endpoint.name for one in explicit(node)]


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_a_launch_file_names_the_node_and_its_namespace(generation):
    node = only(
        configured(
            talker(generation=generation),
            started(name=Text.of("mine"), namespace=Text.of("/robot")),
            generation=generation,
        )
    )
    assert node.name == "/robot/mine"
    assert names(node) == ["/robot/chatter"]
    assert (node.proof.path, node.proof.line, node.proof.origin) == (START.path, 7, Origin.LAUNCH)
    assert node.defined is not None
    assert node.defined.place == "pkg/src/talker.cpp:10"


def test_without_a_name_in_the_launch_file_the_code_names_it():
    assert only(configured(talker(namespace=Text.of("own")), started())).name == "/own/talker"


def test_a_node_that_nobody_names_is_a_pattern_and_listed():
    configuration = configured(talker(name=Text.of(Hole("result of name()"))), started())
    assert only(configuration).name == "/*"
    assert not only(configuration).resolved
    assert any("result of name()" in one.reason for one in configuration.unresolved)


def test_remappings_are_applied_and_those_that_match_nothing_are_known():
    node = only(
        configured(
            talker(),
            started(
                remaps=(
                    Remap(Text.of("chatter"), Text.of("/out"), START),
                    Remap(Text.of("chater"), Text.of("/never"), START),
                )
            ),
        )
    )
    assert names(node) == ["/out"]
    assert explicit(node)[0].remapped is not None
    assert [(one.source, one.used, one.uncertain) for one in node.remaps] == [
        ("chatter", True, False),
        ("chater", False, False),
    ]


def test_a_remapping_of_a_node_with_unresolved_parts_is_uncertain():
    node = only(
        configured(
            talker(unresolved=((CODE, "a loop over an unknown list"),)),
            started(remaps=(Remap(Text.of("other"), Text.of("/x"), START),)),
        )
    )
    assert node.remaps[0].uncertain


@pytest.mark.parametrize("executable", ["talker", "unknown"])
def test_a_remapping_of_a_node_of_which_nothing_is_known_is_uncertain(executable):
    launched = Launched(
        Text.of("pkg"), Text.of(executable), START, remaps=(Remap(Text.of("other"), Text.of("/x"), START),)
    )
    assert only(configured(talker(endpoints=()), launched)).remaps[0].uncertain


def test_a_parameter_that_is_set_decides_a_name():
    facts = talker(
        endpoints=(end(Role.SUBSCRIPTION, parameter_name("topic", "scan")),),
        parameters=(ParameterFact(Text.of("topic"), CODE, "declared", "string", Text.of("scan")),),
    )
    node = only(
        configured(facts, started(settings=(Setting(Text.of("topic"), Text.of("front/scan"), YAML, "string"),)))
    )
    (subscription,) = explicit(node)
    assert subscription.endpoint.name == "/front/scan"
    assert subscription.proof.sure == "certain"
    assert "pkg/config/a.yaml:4" in subscription.proof.how
    (parameter,) = node.parameters
    assert (parameter.value, parameter.default, parameter.access) == ("front/scan", "scan", "declared")
    assert parameter.set_by is not None
    assert parameter.set_by.place == "pkg/config/a.yaml:4"


def test_else_its_default_does_and_that_is_likely():
    node = only(configured(talker(endpoints=(end(Role.SUBSCRIPTION, parameter_name("topic", "scan")),)), started()))
    assert names(node) == ["/scan"]
    assert explicit(node)[0].proof.sure == "likely"


def test_without_a_default_the_name_is_a_pattern():
    configuration = configured(
        talker(endpoints=(end(Role.SUBSCRIPTION, Text.of("in/", Hole(OfParameter("t"), "t"))),)), started()
    )
    (subscription,) = explicit(only(configuration))
    assert subscription.endpoint.name == "/in/*"
    assert not subscription.resolved
    assert subscription.proof.sure == "possible"
    assert [one.node for one in configuration.unresolved] == ["/talker"]


def test_files_of_parameters_hold_for_the_nodes_they_name_and_later_ones_win():
    def setting(node, value):
        return Setting(Text.of("rate"), Text.of(value), YAML, "int", node)

    facts = talker(parameters=(ParameterFact(Text.of("rate"), CODE, "declared", "int", Text.of("1")),))
    node = only(configured(facts, started(settings=(setting("/**", "2"), setting("/*", "3"), setting("/other", "4")))))
    assert node.parameters[0].value == "3"


def test_what_is_set_but_never_declared_is_there_without_access():
    node = only(configured(talker(), started(settings=(Setting(Text.of("rte"), Text.of("5"), YAML, "int"),))))
    assert [(one.name, one.value, one.access, one.proof) for one in node.parameters] == [("rte", "5", "", None)]


def test_parameters_of_ros1_are_resolved_names():
    facts = talker(
        generation="ros1",
        endpoints=(end(Role.SUBSCRIPTION, parameter_name("~/topic", "scan"), "std_msgs/String"),),
        parameters=(
            ParameterFact(Text.of("~/topic"), CODE, "read", "string", Text.of("scan")),
            ParameterFact(Text.of("/robot_description"), CODE, "read"),
        ),
    )
    node = only(
        configured(
            facts,
            started(name=Text.of("t"), settings=(Setting(Text.of("~topic"), Text.of("/front"), START, "string"),)),
            generation="ros1",
            settings=(Setting(Text.of("/robot_description"), Text.of("<robot/>"), START, "string"),),
        )
    )
    assert names(node) == ["/front"]
    assert [(one.name, one.value) for one in node.parameters if one.access] == [
        ("/robot_description", "<robot/>"),
        ("/t/topic", "/front"),
    ]


def test_the_command_line_renames_remaps_and_sets():
    words = ["--ros-args", "-r", "__node:=other", "-r", "chatter:=/said", "-p", "rate:=5"]
    node = only(configured(talker(), started(arguments=tuple(Text.of(word) for word in words))))
    assert (node.name, names(node)) == ("/other", ["/said"])
    assert [(one.name, one.value) for one in node.parameters] == [("rate", "5")]


def test_the_command_line_of_ros1():
    words = ["chatter:=/said", "_rate:=5", "__name:=other"]
    node = only(
        configured(
            talker(generation="ros1"),
            started(name=Text.of("t"), arguments=tuple(Text.of(word) for word in words)),
            generation="ros1",
        )
    )
    # roslaunch gives the name after the arguments, and the last one counts.
    assert (node.name, names(node)) == ("/t", ["/said"])
    assert [(one.name, one.value) for one in node.parameters] == [("/t/rate", "5")]


def test_arguments_and_what_else_a_launch_file_says():
    # As rclpy and rospy of Jazzy and Noetic take the words that launch_ros and roslaunch give them.
    for generation, words, expected in (
        (
            "ros2",
            "--ros-args -r __node:=args -r __ns:=/args -r chatter:=/args -p rate:=1",
            ("/args/args", "/args", "2"),
        ),
        ("ros1", "__name:=args __ns:=/args chatter:=/args _rate:=1", ("/args/launch", "/launch", "1")),
    ):
        node = only(
            configured(
                talker(generation=generation),
                started(
                    name=Text.of("launch"), arguments=tuple(map(Text.of, words.split())), namespace=Text.of("/launch"),
                    remaps=(Remap(Text.of("chatter"), Text.of("/launch"), START),),
                    settings=(Setting(Text.of("~rate"[generation == "ros2" :]), Text.of("2"), YAML, "int"),),
                ),
                generation=generation,
            )
        )  # fmt: skip
        rate = next(one.value for one in node.parameters if one.name.endswith("rate"))
        assert (node.name, names(node)[0], rate) == expected


COMPONENT = Target(
    TargetKind.COMPONENT,
    "pkg",
    "pkg::Talker",
    ("pkg/src/talker.cpp",),
    Evidence("pkg/CMakeLists.txt", 3),
    "pkg::Talker",
)


def test_a_component_is_in_its_container():
    facts = NodeFacts("pkg.Talker", "pkg/src/talker.cpp", 5, "ros2", endpoints=(end(Role.PUBLISHER, "chatter"),))
    container = Launched(
        Text.of("rclcpp_components"), Text.of("component_container"), START, Text.of("box"), kind="container"
    )
    loaded = Launched(
        Text.of("pkg"), Text(), START, Text.of("talker"), plugin=Text.of("pkg::Talker"), container=Text.of("/box"),
        kind="component",
    )  # fmt: skip
    configuration = configured(
        facts, container, loaded, targets=(COMPONENT,),
        known=lambda *_: Meant((NodeFacts("", "", 0, "ros2", "container"),), "", Origin.CATALOGUE),
    )  # fmt: skip
    box, inside = configuration.nodes
    assert (box.name, inside.name, inside.container) == ("/box", "/talker", "/box")
    assert "/box/_container/load_node" in [one.endpoint.name for one in box.endpoints]
    assert not configuration.unresolved


def test_a_nodelet_is_part_of_its_manager_in_the_graph():
    facts = NodeFacts(
        "pkg.Filter",
        "pkg/src/f.cpp",
        5,
        "ros1",
        "nodelet",
        endpoints=(end(Role.PUBLISHER, "~/out", "std_msgs/String"),),
    )
    target = Target(TargetKind.NODELET, "pkg", "pkg/Filter", (), Evidence("pkg/nodelets.xml", 2), "pkg::Filter")
    manager = Launched(Text.of("nodelet"), Text.of("nodelet"), START, Text.of("m"), Text.of("/ns"), kind="container")
    loaded = Launched(
        Text.of("nodelet"), Text.of("nodelet"), START, Text.of("f"), Text.of("/ns"), plugin=Text.of("pkg/Filter"),
        container=Text.of("m"), kind="nodelet",
    )  # fmt: skip
    configuration = configured(facts, manager, loaded, targets=(target,), generation="ros1")
    graph = configuration.graph(implicit=False)
    assert [node.name for node in graph.nodes] == ["/ns/f", "/ns/m"]
    assert [(one.node, one.name) for one in graph.endpoints] == [("/ns/m", "/ns/f/out")]
    ends = {(one.node, one.role.value, one.name) for one in configuration.graph().endpoints}
    for node in ("/ns/f", "/ns/m"):
        assert {(node, "publisher", "/ns/m/bond"), (node, "subscription", "/ns/m/bond")} <= ends
        assert (node, "service_server", f"{node}/get_loggers") in ends


def test_a_python_entry_point_is_found_by_module_and_function():
    target = Target(
        TargetKind.SCRIPT, "pkg", "listen", ("pkg/pkg/listen.py",), Evidence("pkg/setup.py", 9), "pkg.listen:main"
    )
    facts = NodeFacts("main", "pkg/pkg/listen.py", 1, "ros2", name=Text.of("listener"))
    launched = Launched(Text.of("pkg"), Text.of("listen"), START)
    units = KnownUnits({"pkg": (target,)}, (facts,))
    assert only(assemble(Launch("ros2", (launched,)), units, title="")).name == "/listener"


def test_what_no_package_installs_is_still_a_node_and_unresolved():
    configuration = configured(talker(), Launched(Text.of("pkg"), Text.of("talkr"), START, Text.of("t")))
    assert only(configuration).name == "/t"
    assert "creates talkr" in configuration.unresolved[0].reason


def test_conditions_of_start_and_code_are_kept_apart():
    facts = talker(endpoints=(end(Role.PUBLISHER, "chatter", conditions=(Written("debug"),)),))
    node = only(configured(facts, started(conditions=(Written("use_it"),))))
    assert node.conditions == ("use_it",)
    assert explicit(node)[0].conditions == ("debug",)


def test_every_node_has_what_its_generation_gives_it():
    ros2 = only(configured(talker(kind="lifecycle"), started())).endpoints
    implicit = {one.endpoint.name for one in ros2 if one.implicit}
    assert {"/rosout", "/parameter_events", "/talker/get_parameters", "/talker/change_state"} <= implicit
    ros1 = only(configured(talker(generation="ros1"), started(name=Text.of("t")), generation="ros1")).endpoints
    assert {one.endpoint.name for one in ros1 if one.implicit} == {"/rosout", "/t/get_loggers", "/t/set_logger_level"}


@pytest.mark.parametrize(("generation", "name"), [("ros2", "use_sim_time"), ("ros1", "/use_sim_time")])
def test_simulated_time_comes_from_clock(generation, name):
    setting = Setting(Text.of(name), Text.of("true"), START, "bool")
    configuration = configured(
        talker(generation=generation),
        started(settings=(setting,) if generation == "ros2" else ()),
        generation=generation,
        settings=(setting,) if generation == "ros1" else (),
    )
    assert "/clock" in [one.endpoint.name for one in only(configuration).endpoints]


def test_five_topics_of_actionlib_are_an_action():
    def topic(role, last, part):
        return end(role, f"move/{last}", f"pkg/Move{part}")

    facts = talker(
        generation="ros1",
        endpoints=(
            topic(Role.SUBSCRIPTION, "goal", "ActionGoal"),
            end(Role.SUBSCRIPTION, "move/cancel", "actionlib_msgs/GoalID"),
            end(Role.PUBLISHER, "move/status", "actionlib_msgs/GoalStatusArray"),
            topic(Role.PUBLISHER, "feedback", "ActionFeedback"),
            topic(Role.PUBLISHER, "result", "ActionResult"),
            end(Role.PUBLISHER, "other", "std_msgs/String"),
        ),
    )
    node = only(configured(facts, started(name=Text.of("t")), generation="ros1"))
    assert [(one.endpoint.role, one.endpoint.name, one.endpoint.type) for one in explicit(node)] == [
        (Role.ACTION_SERVER, "/move", "pkg/MoveAction"),
        (Role.PUBLISHER, "/other", "std_msgs/String"),
    ]


def test_what_a_launch_file_leaves_open_is_listed_with_the_rest():
    missing = Unresolved("$(env X)", START, "environment X")
    configuration = configured(talker(), started(), unresolved=(missing,), arguments=(Argument("a", START),))
    assert [one.text for one in configuration.unresolved] == ["$(env X)"]
    assert [(one.name, one.default) for one in configuration.arguments] == [("a", None)]


def test_a_package_by_itself_starts_all_that_it_makes():
    units = KnownUnits({"pkg": (TARGET,)}, (talker(),))
    configuration = assemble(targets_started("pkg", units, "ros2"), units, title="pkg", by_launch=False)
    assert only(configuration).name == "/talker"
    assert only(configuration).proof.origin is Origin.CODE


def test_a_guess_about_which_node_stays_a_guess():
    fact = end(Role.PUBLISHER, "chatter")
    fact = msgspec.structs.replace(fact, evidence=msgspec.structs.replace(fact.evidence, sure=Sure.LIKELY))
    assert explicit(only(configured(talker(endpoints=(fact,)), started())))[0].proof.sure == "likely"


@pytest.mark.parametrize("kind", ["container", "node"])
def test_further_nodes_of_a_component_take_what_their_container_is_given(kind):
    first = NodeFacts("pkg.Talker", "pkg/src/talker.cpp", 5, "ros2", name=Text.of("a"))
    second = NodeFacts(
        "pkg.Talker", "pkg/src/map.cpp", 0, "ros2", name=Text.of("costmap"), number=1,
        endpoints=(end(Role.PUBLISHER, parameter_name("topic", "map")), end(Role.PUBLISHER, "chatter")),
    )  # fmt: skip
    box = Launched(
        Text.of("rclcpp_components"), Text.of("component_container_mt"), START, Text.of("box"), kind=kind,
        settings=(Setting(Text.of("topic"), Text.of("grid"), YAML, "string", "/costmap"),),
        remaps=(Remap(Text.of("chatter"), Text.of("/box_said"), START),),
    )  # fmt: skip
    loaded = Launched(
        Text.of("pkg"), Text(), START, Text.of("mine"), plugin=Text.of("pkg::Talker"), container=Text.of("/box"),
        kind="component", remaps=(Remap(Text.of("chatter"), Text.of("/mine_said"), START),),
    )  # fmt: skip
    configuration = configured((first, second), box, loaded, targets=(COMPONENT,))
    nodes = {node.name: node for node in configuration.nodes}
    # The command line of its process gives it the name of the container, as nobody gave it one of its own.
    assert set(nodes) == {"/box", "/mine"}
    (costmap,) = [one for one in configuration.nodes if one.kind == "component" and one.name == "/box"]
    assert names(costmap) == ["/box_said", "/map"]


def test_a_name_for_a_program_is_for_all_nodes_of_it_that_have_none_of_their_own():
    second = NodeFacts("main", "pkg/src/talker.cpp", 20, "ros2", name=Text.of("other"))
    own = msgspec.structs.replace(
        second, name=Text.of("own"), arguments=tuple(map(Text.of, ("--ros-args", "-r", "own:__node:=kept")))
    )
    apart = msgspec.structs.replace(second, name=Text.of("apart"), global_arguments=False)
    configuration = configured((talker(), second, own, apart), started(name=Text.of("mine"), namespace=Text.of("/ns")))
    assert sorted(node.name for node in configuration.nodes) == ["/apart", "/ns/kept", "/ns/mine", "/ns/mine"]
    assert not configuration.unresolved


LOADED = Launched(
    Text.of("pkg"), Text(), START, Text.of("mine"), namespace=Text.of("/robot"), plugin=Text.of("pkg::Talker"),
    container=Text.of("/box"), kind="component", remaps=(Remap(Text.of("chatter"), Text.of("/mine_said"), START),),
    settings=(Setting(Text.of("topic"), Text.of("grid"), YAML, "string"),),
)  # fmt: skip


def component(*endpoints):
    return NodeFacts("pkg.Talker", "pkg/src/talker.cpp", 5, "ros2", name=Text.of("a"), endpoints=endpoints)


def test_a_node_that_a_component_makes_is_in_the_namespace_that_its_options_say():
    space = Text.of("__ns:=", Hole(OfNode(NamePart.NAMESPACE, MAKER), default=""), "/local_costmap")
    words = (Text.of("--ros-args"), Text.of("-r"), space, Text.of("-r"), Text.of("costmap:__node:=costmap"))
    child = NodeFacts(
        "pkg.Talker", "pkg/src/map.cpp", 9, "ros2", name=Text.of("costmap"), arguments=words, number=1,
        endpoints=(end(Role.PUBLISHER, "chatter"), end(Role.PUBLISHER, parameter_name("topic", "map"))),
    )  # fmt: skip
    box = Launched(
        Text.of("rclcpp_components"), Text.of("component_container"), START, Text.of("box"), kind="container"
    )
    for inherits, expected in (
        (Inherits.NOTHING, ["/robot/local_costmap/chatter", "/robot/local_costmap/map"]),
        (Inherits.ARGUMENTS, ["/mine_said", "/robot/local_costmap/map"]),
        (Inherits.ALL, ["/mine_said", "/robot/local_costmap/grid"]),
    ):
        second = msgspec.structs.replace(child, inherits=inherits)
        configuration = configured((component(), second), box, LOADED, targets=(COMPONENT,))
        nodes = {node.name: node for node in configuration.nodes}
        assert set(nodes) == {"/box", "/robot/mine", "/robot/local_costmap/costmap"}
        assert names(nodes["/robot/local_costmap/costmap"]) == expected


def test_what_a_parameter_decides_is_not_its_value():
    told = Text((Hole("result of joined() of {parameter topic}", "topic"),))
    below = Text((Hole(OfParameter("topic"), "topic", "map", "namespace above the node"),))
    found = {}
    for what, name in (("told", told), ("below", below)):
        facts = component(end(Role.PUBLISHER, name))
        found[what] = explicit(configured((facts,), LOADED, targets=(COMPONENT,)).nodes[0])[0]
    assert (found["told"].resolved, found["told"].proof.sure) == (False, "possible")
    assert (found["below"].endpoint.name, found["below"].proof.sure) == ("/grid", "certain")


def test_what_is_there_where_a_parameter_is_set():
    ends = [
        end(Role.SUBSCRIPTION, parameter_name(f"imu{one}"), conditions=(IsSet(Text.of(f"imu{one}")), Written("x")))
        for one in (0, 1)
    ]
    known = Meant((talker(endpoints=tuple(ends)),), origin=Origin.CATALOGUE)
    setting = Setting(Text.of("imu1"), Text.of("imu/data"), YAML, "string")
    node = only(configured((), started(settings=(setting,)), targets=(), known=lambda *_: known))
    assert [(one.endpoint.name, one.conditions) for one in explicit(node)] == [("/imu/data", ("x",))]


def test_what_plugins_make_is_part_of_the_node_they_are_in():
    plugged = (end(Role.PUBLISHER, "/scan", "sensor_msgs/msg/LaserScan"),)
    remap = Remap(Text.of("camera/left"), Text.of("left"), START)
    node = only(configured(talker(), started(plugged=plugged, remaps=(remap,), taken=(remap,))))
    assert names(node) == ["/chatter", "/scan"]
    assert [one.used for one in node.remaps] == [True]


@pytest.mark.parametrize(("generation", "started_"), [("ros1", ["talker"]), ("ros2", [])])
def test_a_program_that_nothing_installs_runs_in_ros1(generation, started_):
    target = msgspec.structs.replace(TARGET, installed=False)
    units = KnownUnits({"pkg": (target,)}, (talker(generation=generation),))
    assert [str(one.executable) for one in targets_started("pkg", units, generation).nodes] == started_


@pytest.mark.parametrize(("generation", "count"), [("ros1", 1), ("ros2", 0)])
def test_a_script_that_nobody_installs_runs_in_ros1_alone(generation, count):
    facts = NodeFacts("<module>", "pkg/src/a.py", 1, generation, endpoints=(end(Role.PUBLISHER, "x"),))
    node = only(
        configured(facts, Launched(Text.of("pkg"), Text.of("a.py"), START, Text.of("a")), generation=generation)
    )
    assert len(explicit(node)) == count


def test_a_name_that_a_parameter_leaves_empty_is_not_resolved():
    unnamed = end(Role.SERVICE_CLIENT, parameter_name("detector", ""), conditions=(Written("not detector.empty()"),))
    configuration = configured(talker(endpoints=(unnamed,)), started())
    (one,) = explicit(only(configuration))
    assert not one.resolved
    assert one.endpoint.name == "*"
    assert "which is empty" in one.proof.how
    assert any("parameter detector" in missing.reason for missing in configuration.unresolved)


@pytest.mark.parametrize(("name", "guessed"), [("", True), ("driver", False)])
@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_a_node_without_code_is_named_by_its_executable_only_as_a_guess(name, guessed, generation):
    start = Launched(Text.of("other"), Text.of("other_node"), START, name=Text.of(name) if name else Text())
    node = only(configured((), start, targets=(), generation=generation))
    assert (node.name, node.resolved) == (f"/{name or 'other_node'}", True)
    assert node.name_is_guessed == (guessed and generation == "ros2")


def test_the_manager_of_controllers_is_known_by_its_own_name():
    start = Launched(Text.of("controller_manager"), Text.of("ros2_control_node"), START)
    node = only(configured((), start, targets=(), known=known_node))
    assert node.name == "/controller_manager"
    assert not node.name_is_guessed
    assert "/controller_manager/list_controllers" in {one.endpoint.name for one in explicit(node)}


ROBOT = Hole(OfEnvironment("ROBOT"), default="r1")
SUPPOSED = "default of environment ROBOT"


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_a_default_of_the_environment_names_all_below_it_as_likely(generation):
    facts = talker(generation=generation, endpoints=(end(Role.PUBLISHER, "chatter"), end(Role.PUBLISHER, "/clock_")))
    configuration = configured(facts, started(name=Text.of("n"), namespace=Text.of("/", ROBOT)), generation=generation)
    node = only(configuration)
    assert (node.name, node.resolved, node.proof.sure, node.proof.how) == ("/r1/n", True, "likely", SUPPOSED)
    assert {(one.endpoint.name, one.resolved, one.proof.sure) for one in explicit(node)} == {
        ("/r1/chatter", True, "likely"),
        ("/clock_", True, "likely"),
    }
    assert {one.proof.how for one in explicit(node)} == {SUPPOSED}
    assert {one.proof.sure for one in node.endpoints} == {"likely"}
    assert configuration.unresolved == ()


def test_a_default_of_the_environment_in_a_parameter_or_target_is_for_what_it_names():
    facts = talker(
        endpoints=(
            end(Role.PUBLISHER, parameter_name("topic", "x")),
            end(Role.PUBLISHER, "y"),
            end(Role.PUBLISHER, "z"),
        )
    )
    node = only(
        configured(
            facts,
            started(
                settings=(Setting(Text.of("topic"), Text.of("a_", ROBOT), START),),
                remaps=(Remap(Text.of("y"), Text.of(ROBOT, "_b"), START),),
            ),
        )
    )
    assert [(one.endpoint.name, one.proof.sure) for one in explicit(node)] == [
        ("/a_r1", "likely"),
        ("/r1_b", "likely"),
        ("/z", "certain"),
    ]
    assert all(SUPPOSED in one.proof.how for one in explicit(node)[:2])
    (parameter,) = (one for one in node.parameters if one.name == "topic")
    assert parameter.value is None
    (remap,) = node.remaps
    assert remap.used


def test_parameters_of_a_name_that_is_supposed_decide_nothing_for_certain():
    keyed = Setting(Text.of("topic"), Text.of("scan"), YAML, "string", "/r1/talker")
    node = only(
        configured(
            talker(endpoints=(end(Role.PUBLISHER, parameter_name("topic", "x")),)),
            started(namespace=Text.of("/", ROBOT), settings=(keyed,)),
        )
    )
    (one,) = explicit(node)
    assert (one.endpoint.name, one.proof.sure) == ("/r1/scan", "likely")
    assert all(parameter.uncertain for parameter in node.parameters)


def test_a_remapping_from_a_name_that_is_supposed_leaves_no_name_certain():
    remap = Remap(Text.of(ROBOT), Text.of("b"), START)
    node = only(configured(talker(), started(remaps=(remap,))))
    (one,) = explicit(node)
    assert (one.endpoint.name, one.proof.sure) == ("/chatter", "likely")
    assert [(one.used, one.uncertain) for one in node.remaps] == [(False, True)]


def test_a_component_is_loaded_into_a_container_whose_name_is_supposed():
    box = started(name=Text.of("box"), namespace=Text.of("/", ROBOT), kind="container")
    inside = Launched(
        Text.of("pkg"), Text(), START, Text.of("c"), plugin=Text.of("a::B"), container=Text.of("/", ROBOT, "/box"),
        kind="component",
    )  # fmt: skip
    nodes = {node.name: node for node in configured((), box, inside, targets=()).nodes}
    assert nodes["/c"].container == "/r1/box"
    assert "/r1/box" in nodes
