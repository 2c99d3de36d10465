import pytest

from roslens.source.extract.catalogue.catalogue_plugins import Class, plugged_by_parameters
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.facts.resolve_name import Place
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.text import Text, unknown

HERE = Evidence("pkg/a.yaml", 3)
RECONFIGURED = ("parameter_descriptions", "parameter_updates", "set_parameters")


def made(**settings):
    place = Place(Text.of("/"), Text.of("/move_base"), "ros1")
    given = [
        Setting(Text.of("~" + name.replace("__", "/")), value if isinstance(value, Text) else Text.of(value), HERE)
        for name, value in settings.items()
    ]
    return [str(one.name) for one in plugged_by_parameters("move_base", "move_base", Values(place, given))]


def test_what_parameters_name_takes_the_place_of_defaults():
    usual = made()
    assert "~TrajectoryPlannerROS/local_plan" in usual
    assert "~NavfnROS/make_plan" in usual
    chosen = made(
        base_local_planner="dwa_local_planner/DWAPlannerROS", base_global_planner="global_planner/GlobalPlanner"
    )
    assert {"~DWAPlannerROS/trajectory_cloud", "~GlobalPlanner/potential"} <= set(chosen)
    assert not {one for one in chosen if "Trajectory" in one or "Navfn" in one}


def test_layers_are_items_of_a_list():
    found = made(
        base_local_planner="own/Planner",
        base_global_planner="own/Planner",
        local_costmap__plugins='[{name: seen, type: "costmap_2d::VoxelLayer"}, {name: b, type: own/B}, {name: x}]',
    )
    layer = "~local_costmap/seen/"
    assert found == [layer + "clearing_endpoints", *(layer + one for one in RECONFIGURED)]


def test_a_layer_listens_to_its_sources():
    found = made(
        base_local_planner="own/Planner",
        base_global_planner="own/Planner",
        local_costmap__plugins='[{name: seen, type: "costmap_2d::ObstacleLayer"}]',
        local_costmap__seen__observation_sources="laser bump  odd",
        local_costmap__seen__laser__topic="/front/scan",
        local_costmap__seen__laser__data_type="LaserScan",
        local_costmap__seen__odd__data_type="Odd",
    )
    assert found[3:] == ["/front/scan", "bump"]


@pytest.mark.parametrize("value", [unknown("argument planner"), "own/Planner"])
def test_of_types_that_are_unknown_nothing_is_said(value):
    assert made(base_local_planner=value, base_global_planner=value) == []


def test_other_nodes_load_nothing():
    assert not list(plugged_by_parameters("amcl", "amcl", Values(Place(Text.of("/"), Text.of("/a"), "ros1"), [])))


def test_servers_of_dynamic_reconfigure_are_in_the_namespaces_that_are_named():
    one = Class(("a/B",), "", publishes=("x a/C",), reconfigures=(".", "pid"))
    names = [line.partition(" ")[0] for _key, line in one.lines()]
    assert names == ["x", *RECONFIGURED, *(f"pid/{name}" for name in RECONFIGURED)]
