from roslens.source.rules.graph.brief import is_brief
from testbed.configured import node


def test_spawners_end():
    assert is_brief(node("/a", package="gazebo_ros", executable="spawn_entity.py"))
    assert not is_brief(node("/a", package="my_robot", executable="create"))
