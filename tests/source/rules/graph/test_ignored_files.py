from roslens.model.configuration import Unresolved
from roslens.source.extract.facts.launched import Launch, Launched, Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.text import Text
from roslens.source.rules.graph.parameters.ignored_files import ignored_files
from roslens.source.rules.graph.surroundings import Ignored
from testbed.configured import configuration, launched, node

PLACE = Evidence("launch/robot.launch.xml", 4)


def given(*keys, name="/robot/slam", resolved=True):
    settings = [
        Setting(Text.of("rate"), Text.of("1"), Evidence("slam.yaml", 9 - n), node=key) for n, key in enumerate(keys)
    ]
    start = Launched(Text.of("slam"), Text.of("slam"), PLACE, settings=tuple(settings))
    return list(ignored_files(configuration(node(name, line=4, resolved=resolved)), Launch("ros2", (start,))))


def test_a_file_without_a_key_for_its_node_is_ignored():
    assert given("/slam", "/amcl") == [
        Ignored("/robot/slam", launched(8, "slam.yaml"), ("/slam", "/amcl"), launched(4))
    ]


def test_one_key_for_the_node_is_enough():
    assert not given("/amcl", "/robot/slam")
    assert not given("/**")
    assert not given("/*/slam")
    assert not given("")


def test_a_name_that_is_not_known_is_not_held_against_a_file():
    assert not given("/slam", name="/*/slam", resolved=False)


def test_a_name_that_only_code_which_is_unknown_gives_is_not_held_against_a_file():
    setting = Setting(Text.of("rate"), Text.of("1"), Evidence("a.yaml", 3), node="/controller_manager")
    start = Launched(Text.of("slam"), Text.of("slam"), PLACE, settings=(setting,))
    guessed = node("/slam", known=False, proof=launched(4, sure="likely"))
    assert not list(ignored_files(configuration(guessed), Launch("ros2", (start,))))
    assert list(ignored_files(configuration(node("/slam", line=4, known=False)), Launch("ros2", (start,))))


def loaded(*keys, **more):
    settings = tuple(Setting(Text.of("rate"), Text.of("1"), Evidence("nav.yaml", 3), node=key) for key in keys)
    start = Launched(Text.of("rclcpp_components"), Text.of("component_container"), PLACE, settings=settings)
    held = node("/robot/amcl", line=9, container="/container", **more)
    system = configuration(node("/container", line=4, kind="container"), held)
    return list(ignored_files(system, Launch("ros2", (start,))))


def test_a_file_of_a_container_may_be_for_a_node_that_others_load():
    setting = Setting(Text.of("rate"), Text.of("1"), Evidence("nav.yaml", 3), node="/amcl")
    start = Launched(Text.of("rclcpp_components"), Text.of("component_container"), PLACE, settings=(setting,))
    container, held = node("/container", line=4, kind="container"), node("/map", line=9, container="/container")
    missing = Unresolved("other.launch.py", launched(8), "there is no such file", opens=True)
    for nodes, unresolved, count in [([], (), 0), ([held], (), 1), ([held], (missing,), 0)]:
        system = configuration(container, *nodes, unresolved=unresolved)
        assert len(list(ignored_files(system, Launch("ros2", (start,))))) == count


def test_a_file_of_a_container_may_be_for_a_node_in_it():
    assert not loaded("/robot/amcl")
    assert not loaded("/slam", resolved=False)
    assert [one.node for one in loaded("/slam")] == ["/container"]


def test_every_node_that_is_started_there_is_named():
    setting = Setting(Text.of("rate"), Text.of("1"), Evidence("slam.yaml", 3), node="/slam")
    start = Launched(Text.of("slam"), Text.of("slam"), PLACE, settings=(setting,))
    system = configuration(node("/one/slam", line=4), node("/two/slam", line=4))
    assert set(ignored_files(system, Launch("ros2", (start, start)))) == {
        Ignored("/one/slam", launched(3, "slam.yaml"), ("/slam",), launched(4), ("/two/slam",))
    }
