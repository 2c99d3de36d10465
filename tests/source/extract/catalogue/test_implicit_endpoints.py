import pytest

from roslens.model.graph import Role
from roslens.source.extract.catalogue.implicit_endpoints import implicit_endpoints


def names(generation: str, kind: str = "node", **others):
    given = {"sim_time": False, "lifecycle": False, "cpp": None} | others
    return {(one.endpoint.role, one.endpoint.name) for one in implicit_endpoints("/ns/n", generation, kind, **given)}


def test_a_node_of_ros2_logs_and_has_parameters():
    found = names("ros2")
    assert (Role.PUBLISHER, "/rosout") in found
    for service in (
        "describe_parameters", "get_parameter_types", "get_parameters", "list_parameters", "set_parameters",
        "set_parameters_atomically", "get_type_description",
    ):  # fmt: skip
        assert (Role.SERVICE_SERVER, f"/ns/n/{service}") in found


def test_only_nodes_in_cpp_listen_to_events_of_parameters():
    event = (Role.SUBSCRIPTION, "/parameter_events")
    assert event in names("ros2", cpp=True)
    assert event not in names("ros2", cpp=False)


def test_managed_nodes_containers_and_simulated_time_add_theirs():
    assert (Role.PUBLISHER, "/ns/n/transition_event") in names("ros2", lifecycle=True)
    assert (Role.SERVICE_SERVER, "/ns/n/_container/load_node") in names("ros2", "container")
    assert (Role.SUBSCRIPTION, "/clock") in names("ros2", sim_time=True)
    assert (Role.SERVICE_SERVER, "/ns/n/load_nodelet") in names("ros1", "container")


def test_a_nodelet_has_what_its_manager_has():
    assert names("ros1", "nodelet", sim_time=True, process=False) == set()


def test_what_loads_a_nodelet_is_a_node_of_its_own():
    assert names("ros1", "nodelet", sim_time=True) == names("ros1", sim_time=True) != set()


@pytest.mark.parametrize("generation", ["ros1", "ros2"])
def test_all_are_marked(generation):
    found = implicit_endpoints("/n", generation, "node", sim_time=True, lifecycle=True, cpp=True)
    assert all(one.implicit for one in found)
