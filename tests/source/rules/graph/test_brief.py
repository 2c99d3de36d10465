from roslens.source.rules.graph.brief import is_brief
from testbed.configured import end, node, timer


def test_spawners_end():
    assert is_brief(node("/a", package="gazebo_ros", executable="spawn_entity.py"))
    assert not is_brief(node("/a", package="my_robot", executable="create"))


def test_a_node_that_only_calls_has_nothing_to_stay_for():
    spawn = end("call", "/spawn_entity", "gazebo_msgs/srv/SpawnEntity")
    assert is_brief(node("/a", spawn))
    assert not is_brief(node("/a", spawn, timers=(timer(1.0),)))
    assert not is_brief(node("/a", spawn, end("sub", "/scan")))
    assert not is_brief(node("/a"))
