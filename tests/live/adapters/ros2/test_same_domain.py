from roslens.live.adapters.ros2.same_domain import KEPT_S, SameDomain
from roslens.model.graph import Endpoint, Graph, Role


def gid(pid, end=1):
    return f"010f78fd{pid & 0xFF:02x}{pid >> 8 & 0xFF:02x}00a000000000{end:08x}"


def graph(*ends):
    return Graph("ros2", endpoints=tuple(Endpoint(node, Role.PUBLISHER, "/scan", gid=one) for node, one in ends))


def test_a_node_of_the_same_name_in_another_process_is_of_another_domain():
    domain = SameDomain()
    domain.take(graph(("/lidar", gid(27945)), ("/camera", gid(300))), 0.0)
    assert domain.has("/lidar", 27945)
    assert domain.has("/lidar", 27945 + (5 << 16))
    assert not domain.has("/lidar", 300)
    assert not domain.has("/lidar", 27946)
    assert not domain.has("/planner", 27945)


def test_two_processes_may_hold_nodes_of_one_name():
    domain = SameDomain()
    domain.take(graph(("/lidar", gid(7)), ("/lidar", gid(8))), 0.0)
    assert domain.has("/lidar", 7)
    assert domain.has("/lidar", 8)


def test_what_left_is_known_for_a_while():
    domain = SameDomain()
    domain.take(graph(("/lidar", gid(7))), 0.0)
    domain.take(graph(), 1000.0)
    assert domain.has("/lidar", 7)
    domain.take(graph(), 1000.0 + KEPT_S)
    assert not domain.has("/lidar", 7)


def test_where_the_identifiers_of_a_node_say_nothing_its_name_has_to_do():
    domain = SameDomain()
    domain.take(graph(("/lidar", "0110" + "00" * 14)), 0.0)
    assert domain.has("/lidar", 7)
    assert not domain.has("/planner", 7)


def test_a_participant_without_a_node_lets_no_other_domain_in():
    domain = SameDomain()
    domain.take(graph(("/_CREATED_BY_BARE_DDS_APP_", "0110" + "00" * 14), ("/hear", gid(7))), 0.0)
    assert domain.has("/hear", 7)
    assert not domain.has("/hear", 8)
    assert not domain.has("/r1/base", 9)


def test_nobody_is_there_before_the_graph_is_known():
    assert not SameDomain().has("/lidar", 7)
    silent = SameDomain()
    silent.take(graph(("/lidar", "")), 0.0)
    assert not silent.has("/lidar", 7)
