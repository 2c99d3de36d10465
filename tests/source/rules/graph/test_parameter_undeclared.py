from roslens.model.configuration import Origin, Proof, Unresolved
from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.parameter_undeclared import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, launched, node, parameter

CODE = Proof("src/a.cpp", 5)
KNOWN = parameter("known", access="declared", proof=CODE)
FILE = launched(3, "config/a.yaml")


def findings(*nodes, **more):
    return list(found(configuration(*nodes, **more), Surroundings()))


def test_a_parameter_that_is_set_and_not_declared_is_told_with_what_was_meant():
    (one,) = findings(
        node(
            "/a", parameters=(parameter("max_speed", access="declared", proof=CODE), parameter("max_sped", set_by=FILE))
        )
    )
    assert (one.path, one.line, one.severity) == ("config/a.yaml", 3, Severity.WARNING)
    assert one.entity == "parameter:/a:max_sped"
    assert one.message == (
        "parameter `max_sped` is set for /a (src/a.cpp:1), which never declares it. Did you mean `max_speed`?"
    )


def test_what_is_declared_or_of_every_node_or_of_unknown_code_is_none():
    assert not findings(
        node("/a", parameters=(parameter("x", access="declared", set_by=FILE), parameter("use_sim_time", set_by=FILE))),
        node("/b", known=False, parameters=(parameter("y", set_by=FILE),)),
        node("/c", parameters=(parameter("z", set_by=FILE),), defined=Proof("rviz", origin=Origin.CATALOGUE)),
        node("/e", parameters=(parameter("z", set_by=FILE),)),
        node("/d", parameters=(parameter("*.rate", access="declared"), parameter("left.rate", set_by=FILE))),
    )


def test_doubt_makes_it_a_note():
    (one,) = findings(node("/a", parameters=(KNOWN, parameter("follow.gain", set_by=FILE))))
    assert one.severity is Severity.NOTE
    assert "a plug-in that the node loads may declare it" in one.message
    (one,) = findings(
        node("/a", parameters=(KNOWN, parameter("gain", set_by=FILE))),
        unresolved=(Unresolved("", CODE, "a macro", "/a"),),
    )
    assert one.severity is Severity.NOTE
    assert "the code of /a could not be analysed completely" in one.message
    (one,) = findings(node("/a", end("pub", "/x"), parameters=(parameter("gain", set_by=FILE),)))
    assert one.severity is Severity.NOTE
    assert "no parameter of the code of /a is known" in one.message


def test_where_code_has_none_all_that_are_set_are_one_finding():
    (one,) = findings(node("/a", end("pub", "/x"), parameters=tuple(parameter(name, set_by=FILE) for name in "xyz")))
    assert "parameters `x`, `y` and `z` are set for /a (src/a.cpp:1), which never declares any." in one.message


def test_many_of_one_file_and_one_doubt_are_one_finding_that_names_the_others():
    other = launched(9, "config/b.yaml")
    many = [parameter(f"plugin.p{number:02}", set_by=launched(number, "config/a.yaml")) for number in range(1, 31)]
    few = [parameter("plugin.x", set_by=other), parameter("plugin.y", set_by=other)]
    one, x, y = findings(node("/a", parameters=(KNOWN, *many, *few)))
    assert "parameters `plugin.p01`, `plugin.p02`, `plugin.p03` and 27 more are set for /a" in one.message
    assert "which never declares them." in one.message
    assert (one.line, one.entity, one.severity) == (1, "parameter:/a:plugin.p01", Severity.NOTE)
    assert one.others == tuple(f"plugin.p{number:02} (config/a.yaml:{number})" for number in range(2, 31))
    assert [(each.entity, each.others) for each in (x, y)] == [
        ("parameter:/a:plugin.x", ()),
        ("parameter:/a:plugin.y", ()),
    ]


def test_what_looks_mistyped_is_told_by_itself():
    names = ("speed_max", "gain_left", "gain_right", "height", "weight_of_all", "colour")
    known = parameter("max_speeds", access="declared", proof=CODE)
    found = findings(
        node("/a", parameters=(known, parameter("max_speed", set_by=FILE), *(parameter(n, set_by=FILE) for n in names)))
    )
    assert sorted(len(one.others) for one in found) == [0, 5]
    (mistyped,) = (one for one in found if not one.others)
    assert "Did you mean `max_speeds`?" in mistyped.message


def test_ros1_asks_for_its_own_parameters_that_no_node_reads():
    a = node(
        "/a",
        parameters=(
            parameter("/a/known", access="read", proof=CODE),
            parameter("/a/rate", set_by=FILE),
            parameter("/a/map/x", set_by=FILE),
            parameter("/other", set_by=FILE),
        ),
    )
    b = node("/b", parameters=(parameter("/a/map", access="read", proof=CODE),))
    (one,) = findings(a, b, generation="ros1")
    assert one.entity == "parameter:/a:/a/rate"
    assert "which never reads it" in one.message


SERVER = end("serve", "/a/set_parameters", "dynamic_reconfigure/Reconfigure")
RATE = parameter("/a/rate", access="declared", proof=CODE)


def test_a_server_of_dynamic_reconfigure_whose_file_is_not_there_may_have_any():
    unknown = parameter("/a/*", access="declared", proof=CODE)
    one = node("/a", SERVER, parameters=(unknown, parameter("/a/rate", set_by=FILE)))
    assert not findings(one, generation="ros1")


def test_one_whose_file_is_there_has_those_and_no_others():
    one = node("/a", SERVER, parameters=(RATE, parameter("/a/ratte", set_by=FILE)))
    (found,) = findings(one, generation="ros1")
    assert "Did you mean `/a/rate`?" in found.message


def test_what_is_below_may_be_that_of_a_plugin():
    one = node("/a", SERVER, parameters=(RATE, parameter("/a/planner/rate", set_by=FILE)))
    assert not findings(one, generation="ros1")


def test_what_is_unknown_itself_is_none():
    table = parameter("known", access="declared", proof=CODE), parameter("group.x", access="declared", proof=CODE)
    assert not findings(node("/a", parameters=(*table, parameter("*", set_by=FILE), parameter("group", set_by=FILE))))
    (one,) = findings(node("/a", parameters=(*table, parameter("group", value="1", set_by=FILE))))
    assert "`group` is set" in one.message


def test_a_parameter_of_another_node_of_the_same_program_is_known():
    given = parameter("protocol", set_by=FILE)
    declared = parameter("protocol", access="declared", proof=CODE)
    router = node("/router", parameters=(KNOWN, given), executable="mavros_node", unit="Router")
    uas = node("/mavros", parameters=(declared,), executable="mavros_node", unit="Uas")
    assert not findings(router, uas)
    assert findings(router)


def test_a_name_that_is_nearly_the_same_outweighs_code_that_was_not_understood():
    missed = (Unresolved("x", CODE, "unknown", node="/a"),)
    known = tuple(parameter(name, access="declared", proof=CODE) for name in ("max_speed", "gain1"))
    found_ones = findings(
        node("/a", parameters=(*known, parameter("max_sped", set_by=FILE), parameter("gain2", set_by=FILE))),
        unresolved=missed,
    )
    assert {one.entity: one.severity for one in found_ones} == {
        "parameter:/a:max_sped": Severity.WARNING,
        "parameter:/a:gain2": Severity.NOTE,
    }


def test_what_libraries_read_is_none():
    own = parameter("/a/x", access="read", proof=CODE)
    viewer = node("/a", parameters=(own, parameter("/a/image_transport", set_by=FILE)))
    assert not findings(viewer, generation="ros1")
    assert findings(node("/a", parameters=(own, parameter("/a/image", set_by=FILE))), generation="ros1")


def test_code_that_writes_its_own_name_into_that_of_a_parameter_is_a_warning_where_the_node_is_renamed():
    read = parameter("/sense/frame_id", access="read", proof=CODE)
    (one,) = findings(
        node("/left/imu", parameters=(parameter("/left/imu/frame_id", set_by=FILE), read)), generation="ros1"
    )
    assert one.severity is Severity.WARNING
    assert one.message == (
        "parameter `/left/imu/frame_id` is set for /left/imu (src/left/imu.cpp:1), which never reads it. Its code "
        "reads `/sense/frame_id`, under a name that it no longer has: read it as a private parameter (`~`)."
    )
    deeper = parameter("/rover/sense/frame_id", access="read", proof=CODE)
    (one,) = findings(
        node("/left/imu", parameters=(parameter("/left/imu/frame_id", set_by=FILE), deeper)), generation="ros1"
    )
    assert one.severity is Severity.NOTE
