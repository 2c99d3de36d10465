import yaml

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter, Proof
from roslens.report.graph.to_parameters import to_parameters

_SET = Proof("config/base.yaml", 4)


def _of(*parameters, name="/rover/base", generation="ros2", **more):
    node = ConfiguredNode(name, Proof("a.launch.py", 3), parameters=parameters, **more)
    return to_parameters(Configuration("a.launch.py", generation, (node,)))


def test_what_is_set_and_what_is_default_stand_with_their_type():
    text = _of(
        ConfiguredParameter("port", "5", "string", "7", set_type="string", set_by=_SET),
        ConfiguredParameter("rate", "10.0", "double", "10.0"),
    )
    assert yaml.safe_load(text) == {"/rover/base": {"ros__parameters": {"port": "5", "rate": 10.0}}}
    assert '"port": "5"  # config/base.yaml:4\n' in text
    assert '"rate": 10.0  # default\n' in text


def test_what_is_unknown_is_a_comment_and_no_value():
    how = Proof("a.launch.py", 9, how="output of xacro", sure="possible")
    text = _of(ConfiguredParameter("robot_description", None, set_type="string", set_by=how))
    assert yaml.safe_load(text) is None
    assert "# robot_description: its value is known only while it runs (output of xacro)" in text


def test_a_value_that_code_writes_is_not_the_one_to_set():
    written = ConfiguredParameter("mode", "fast", "string", "slow", set_by=_SET, set_type="string", set_value="mid",
                                  written_by=Proof("a.cpp", 2))  # fmt: skip
    assert yaml.safe_load(_of(written)) == {"/rover/base": {"ros__parameters": {"mode": "mid"}}}


def test_an_override_of_quality_that_nothing_sets_is_left_out():
    assert yaml.safe_load(_of(ConfiguredParameter("qos_overrides./a.publisher.depth", "10", "int", "10"))) is None


def test_a_node_with_an_unknown_name_gets_no_values():
    text = _of(ConfiguredParameter("rate", "1", "int", "1"), name="/*/base", resolved=False)
    assert yaml.safe_load(text) is None
    assert "/*/base: a part of its name is unknown" in text


def test_ros_1_has_resolved_names():
    text = _of(ConfiguredParameter("/rover/base/rate", "10", "int", set_by=_SET, set_type="int"), generation="ros1")
    assert yaml.safe_load(text) == {"/rover/base/rate": 10}
