from roslens.model.finding import Severity
from roslens.source.rules.graph.parameter_file import found
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


def test_none_is_none():
    assert not list(found(configuration(node("/robot/slam")), Surroundings()))
