import msgspec

from roslens.model.configuration import Origin, Proof, Unresolved
from roslens.model.finding import Severity
from roslens.model.source import Location, Package
from roslens.source.rules.graph.one_end import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, launched, node, parameter

PROOF = Proof("src/x.cpp", 1)


def findings(*nodes, **surroundings):
    return list(found(configuration(*nodes), Surroundings(**surroundings)))


def test_two_names_that_mean_each_other_are_one_finding_at_the_end_that_waits():
    (one,) = findings(node("/lidar", end("pub", "/scan_raw", line=3)), node("/slam", end("sub", "/scan_row", line=8)))
    assert one.severity is Severity.NOTE
    assert (one.path, one.line) == ("src/slam.cpp", 8)
    assert one.message == (
        "/slam (src/slam.cpp:8) subscribes to the topic /scan_row, which has no publisher. Candidate: /scan_raw of "
        "/lidar (src/lidar.cpp:3), nearly the same name. Correct or remap one of the two names."
    )


def test_another_namespace_is_a_candidate():
    (one,) = findings(node("/lidar", end("pub", "/robot/scan")), node("/slam", end("sub", "/scan")))
    assert "Candidate: /robot/scan of /lidar (src/lidar.cpp:1), the same name in another namespace." in one.message


def test_a_name_of_another_type_is_none():
    found_ones = findings(
        node("/a", end("pub", "/scan_raw", "sensor_msgs/msg/Imu")), node("/b", end("sub", "/scan_row"))
    )
    assert [(one.entity, "Candidate" in one.message, one.severity) for one in found_ones] == [
        ("topic:/scan_row", False, Severity.NOTE)
    ]


def test_a_name_that_is_used_by_both_sides_is_no_candidate():
    (one,) = findings(
        node("/a", end("pub", "/image1")), node("/b", end("sub", "/image1")), node("/c", end("sub", "/image2"))
    )
    assert "Candidate" not in one.message


def test_services_and_actions_need_a_server():
    found_ones = findings(node("/a", end("call", "/load", "m/srv/Load"), end("ask", "/dock", "m/action/Dock")))
    assert [one.entity for one in found_ones] == ["action:/dock", "service:/load"]
    assert all(one.severity is Severity.NOTE and "which has no server" in one.message for one in found_ones)


def test_what_is_joined_and_what_is_elsewhere_is_none():
    assert not findings(
        node(
            "/a", end("pub", "/scan"), end("sub", "/clock"), end("sub", "/initialpose"), end("pub", "/ns/diagnostics")
        ),
        node("/b", end("sub", "/scan")),
        node("/c", end("sub", "/joy")),
        external=("/clock", "/initialpose", "*/diagnostics", "/joy"),
    )


def test_nodes_of_the_catalogue_offer_more_than_is_used():
    assert not findings(node("/rviz", end("pub", "/goal", origin=Origin.CATALOGUE)))


def test_a_node_that_is_not_known_may_be_the_other_end():
    (one,) = findings(node("/a", end("sub", "/scan")), node("/driver", known=False))
    assert one.severity is Severity.NOTE
    assert one.message.endswith("In doubt: the endpoints of /driver are unknown.")


def test_a_name_that_is_not_known_neither_raises_nor_satisfies():
    (one,) = findings(node("/a", end("sub", "/scan")), node("/b", end("pub", "/*", resolved=False, line=5)))
    assert one.entity == "topic:/scan"
    assert one.severity is Severity.NOTE
    assert "the name is unknown for /b (src/b.cpp:5)" in one.message


def test_nodes_that_stand_alone_only_tell_candidates():
    alone = {"proof": Proof("CMakeLists.txt", 3)}
    assert not findings(node("/a", end("sub", "/scan"), **alone))
    assert (
        len(findings(node("/a", end("sub", "/scan_row"), **alone), node("/b", end("pub", "/scan_raw"), **alone))) == 1
    )


def test_parts_of_an_action_are_not_told_beside_it():
    nodes = node("/a", end("act", "/dock", "m/DockAction")), node("/b", end("ask", "/dock", "m/DockAction"))
    assert not findings(*nodes, node("/c", end("sub", "/dock/status", "actionlib_msgs/GoalStatusArray")))


def test_how_the_code_gives_the_name_is_told():
    (one,) = findings(node("/a", end("sub", "/robot/scan", given="scan"), proof=launched()))
    assert one.message.endswith("It is given as `scan`.")


def test_a_candidate_outweighs_nodes_that_are_not_known():
    nodes = node("/a", end("sub", "/scan_row")), node("/b", end("pub", "/scan_raw")), node("/driver", known=False)
    (one,) = findings(*nodes)
    assert one.severity is Severity.NOTE


def test_a_name_that_a_launch_file_gives_a_node_of_the_catalogue_is_meant():
    how = {"how": "parameter ~imu0, set in config/ekf.yaml:3", "by_parameter": True}
    chosen = end("sub", "/imu/data_compass", given="{parameter ~imu0}", **how, origin=Origin.CATALOGUE)
    (one,) = findings(node("/ekf", chosen), node("/gazebo", end("pub", "/imu/data", origin=Origin.CATALOGUE)))
    assert one.entity == "topic:/imu/data_compass"
    assert "Candidate: /imu/data of /gazebo" in one.message
    remapped = end("sub", "/narrow_scan", remapped=Proof("a.launch", 3), origin=Origin.CATALOGUE)
    assert [one.entity for one in findings(node("/amcl", remapped))] == ["topic:/narrow_scan"]


def test_the_interface_of_a_driver_is_nothing_but_in_a_whole_system():
    driver = node("/driver", end("pub", "/points"), end("serve", "/reset", "m/srv/Reset"), end("sub", "/trigger"))
    (one,) = findings(driver)
    assert (one.entity, one.severity) == ("topic:/trigger", Severity.NOTE)
    assert [(one.entity, one.severity) for one in findings(driver, whole=True)] == [
        ("topic:/trigger", Severity.WARNING),
        ("service:/reset", Severity.NOTE),
        ("topic:/points", Severity.NOTE),
    ]


def test_what_nobody_hears_of_a_type_of_the_workspace_is_a_note():
    place = Location("own_msgs/package.xml")
    own = Package("own_msgs", "own_msgs", "own_msgs", place)
    driver = node("/driver", end("pub", "/points"), end("pub", "/state", "own_msgs/msg/State"))
    assert [(one.entity, one.severity) for one in findings(driver, packages=(own,))] == [
        ("topic:/state", Severity.NOTE)
    ]


def test_a_name_below_that_of_a_node_which_has_none_of_it_is_a_note():
    tracker = node("/tracker", end("pub", "/tracker/feature"), line=7)
    (one,) = findings(tracker, node("/slam", end("sub", "/tracker/features", "m/msg/F", line=3)))
    assert (one.entity, one.severity) == ("topic:/tracker/features", Severity.NOTE)
    assert (
        "The name is below that of /tracker (launch/robot.launch.xml:7), which has none of it: it publishes "
        "`/tracker/feature`. Correct the name, or let /tracker have it." in one.message
    )


def test_a_name_that_a_parameter_gives_to_a_node_which_does_not_use_it_is_a_note():
    pose = (parameter("pose", value="/truth/pose", set_by=launched(9)),)
    truth = node("/gazebo", end("pub", "/truth/pose"), end("pub", "/other"))
    (one,) = findings(truth, node("/control", end("sub", "/state", "m/msg/S"), parameters=pose), external=("/state",))
    assert (one.entity, one.severity) == ("topic:/truth/pose", Severity.NOTE)
    assert (
        "Parameter `pose` (launch/robot.launch.xml:9) gives the name to /control, which does not use it." in one.message
    )
    (one,) = findings(truth, node("/control", end("sub", "/*", resolved=False), parameters=pose))
    assert (one.severity, "the code of /control could not be analysed completely" in one.message) == (
        Severity.NOTE,
        True,
    )


def test_nothing_is_expected_of_a_node_that_is_not_known_or_has_what_every_node_has():
    waiting = node("/slam", end("sub", "/tracker/features"), end("call", "/tracker/get_state", "m/srv/G"))
    every = end("serve", "/tracker/get_state", "m/srv/G", origin=Origin.IMPLICIT)
    half = node("/tracker", end("pub", "/tracker/*", resolved=False), every)
    assert [(one.entity, one.severity) for one in findings(waiting, half)] == [
        ("topic:/tracker/features", Severity.NOTE)
    ]
    assert findings(waiting, node("/tracker", every, known=False))[0].severity is Severity.NOTE


def test_numbers_that_count_and_the_two_ends_of_one_node_are_no_candidates():
    found_ones = findings(
        node("/a", end("sub", "/camera1/image"), end("sub", "/state_raw"), end("pub", "/state")),
        node("/b", end("pub", "/camera2/imagf", "m/msg/X"), end("pub", "/camera2/points")),
        node("/c", end("sub", "/odom1", "m/msg/O")),
        node("/d", end("pub", "/odom2", "m/msg/O")),
    )
    assert all("Candidate" not in one.message and one.severity is Severity.NOTE for one in found_ones)


def test_a_configuration_that_is_not_whole_is_in_doubt():
    whole = configuration(node("/a", end("sub", "/scan_raw")), node("/b", end("pub", "/scan_row")))
    missing = Unresolved("other/b.launch", PROOF, "there is no such file in the workspace", opens=True)
    (one,) = found(msgspec.structs.replace(whole, unresolved=(missing,)), Surroundings())
    assert one.severity is Severity.NOTE
    assert "incomplete: the nodes that `other/b.launch` (src/x.cpp:1) starts are unknown" in one.message
    other = msgspec.structs.replace(missing, opens=False)
    (one,) = found(msgspec.structs.replace(whole, unresolved=(other,)), Surroundings())
    assert one.severity is Severity.NOTE


def test_a_remapping_that_leads_out_of_the_namespace_of_the_other_end_is_a_warning():
    planner = node("/barrow/planner", end("pub", "/barrow/path"))
    follower = node("/barrow/follower", end("sub", "/path", given="~/path", remapped=launched(6)))
    (one,) = findings(planner, follower)
    assert one.severity is Severity.WARNING
    assert "Candidate: /barrow/path of /barrow/planner" in one.message
    # In code the name may be global on purpose, and in another namespace it is no slip of a slash.
    (one,) = findings(planner, node("/barrow/follower", end("sub", "/path")))
    assert one.severity is Severity.NOTE
    (one,) = findings(planner, node("/other/follower", end("sub", "/path", remapped=launched(6))))
    assert one.severity is Severity.NOTE
