from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.parameter_file import found
from roslens.source.rules.graph.surroundings import Ignored, Surroundings
from testbed.configured import configuration, launched, node

IGNORED = Ignored("/robot/slam", launched(2, "config/slam.yaml"), ("/slam",), launched(9))


def test_a_file_for_another_node_is_told_with_the_name_that_was_meant():
    (one,) = found(configuration(node("/robot/slam")), Surroundings(ignored=(IGNORED,)))
    assert (one.path, one.line, one.severity) == ("config/slam.yaml", 2, Severity.ERROR)
    assert one.message == (
        "launch/robot.launch.xml:9 gives config/slam.yaml to /robot/slam, but it is keyed to `/slam`: all of it is "
        "ignored. `/slam` is nearly it. Key it to `/robot/slam` or to `/**`."
    )


def test_the_condition_of_the_node_is_told():
    (one,) = found(configuration(node("/robot/slam", conditions=("map",))), Surroundings(ignored=(IGNORED,)))
    assert one.severity is Severity.WARNING


def test_a_file_of_several_nodes_that_run_may_have_nothing_for_one_of_them():
    given = Ignored("/manager", launched(2, "config/all.yaml"), ("/amcl", "/planner"), launched(9))
    (one,) = found(configuration(node("/amcl"), node("/manager")), Surroundings(ignored=(given,)))
    assert one.severity is Severity.NOTE
    assert one.message == (
        "launch/robot.launch.xml:9 gives config/all.yaml to /manager, but it is keyed to other nodes that run, "
        "`/amcl`, `/planner`: all of it is ignored. Key it to `/manager` or to `/**`, if it is meant."
    )


def test_a_name_that_is_nearly_it_is_a_mistake_whoever_else_runs():
    given = Ignored("/robot/slam", launched(2, "config/all.yaml"), ("/amcl", "/slam"), launched(9))
    (one,) = found(configuration(node("/robot/slam"), node("/amcl")), Surroundings(ignored=(given,)))
    assert one.severity is Severity.ERROR


def test_a_file_for_a_whole_system_has_names_that_are_like_others():
    keys = ("/amcl", "/planner_server", "/map_saver")
    given = Ignored("/map_server", launched(2, "config/nav2.yaml"), keys, launched(9))
    (one,) = found(configuration(node("/map_server")), Surroundings(ignored=(given,)))
    assert one.severity is Severity.NOTE
    assert "it is keyed to other nodes, `/amcl`" in one.message
    assert "nearly" not in one.message


def test_the_name_of_a_node_that_runs_is_no_typing_mistake():
    given = Ignored("/camera_1", launched(2, "config/camera.yaml"), ("/camera_2",), launched(9))
    (one,) = found(configuration(node("/camera_1"), node("/camera_2")), Surroundings(ignored=(given,)))
    assert one.severity is Severity.NOTE


def test_one_sign_is_a_typing_mistake_in_a_file_for_a_whole_system_too():
    given = Ignored("/slam", launched(2, "config/all.yaml"), ("/amcl", "/planner", "/slan"), launched(9))
    (one,) = found(configuration(node("/slam")), Surroundings(ignored=(given,)))
    assert one.severity is Severity.ERROR


def test_none_is_none():
    assert not list(found(configuration(node("/robot/slam")), Surroundings()))


def test_a_file_that_several_nodes_ignore_alike_is_one_finding_about_all_of_them():
    given = Ignored("/one/slam", launched(2, "config/slam.yaml"), ("/slam",), launched(9), also=("/two/slam",))
    (one,) = found(configuration(node("/one/slam"), node("/two/slam")), Surroundings(ignored=(given,)))
    assert one.message == (
        "launch/robot.launch.xml:9 gives config/slam.yaml to /one/slam, /two/slam, but it is keyed to `/slam`: all of "
        "it is ignored. `/slam` is nearly it. Key it to `/**`."
    )
    assert (one.entity, one.also) == ("node:/one/slam", ("node:/two/slam",))
