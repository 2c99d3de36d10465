import pytest

from roslens.cli.graph.graph_choice import chosen, require_nodes
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Origin, Proof, Unresolved
from roslens.model.errors import UsageError
from roslens.model.graph import Endpoint, Role


def node(name: str) -> ConfiguredNode:
    ends = tuple(
        ConfiguredEndpoint(Endpoint(name, Role.PUBLISHER, f"/{origin.value}"), Proof(origin=origin))
        for origin in (Origin.CODE, Origin.IMPLICIT)
    )
    return ConfiguredNode(name, Proof("a.launch"), endpoints=ends)


ALL = Configuration(
    "t",
    "ros2",
    (node("/ns/a"), node("/b")),
    unresolved=(Unresolved("x", Proof(), "y"), Unresolved("z", Proof(), "y", "/b")),
)


def test_nodes_are_chosen_by_name_last_part_or_pattern():
    def names(*wanted: str) -> list[str]:
        return [one.name for one in chosen(ALL, wanted, implicit=True).nodes]

    assert names() == ["/ns/a", "/b"]
    assert names("a") == names("/ns/a") == names("ns/a") == names("/ns/*") == ["/ns/a"]
    assert names("c") == []


def test_what_is_unresolved_of_chosen_nodes_stays():
    assert [one.text for one in chosen(ALL, (), implicit=True).unresolved] == ["x", "z"]
    assert [one.text for one in chosen(ALL, ("b",), implicit=True).unresolved] == ["z"]


def test_what_every_node_has_is_left_out():
    assert [one.endpoint.name for one in chosen(ALL, ("b",), implicit=False).nodes[0].endpoints] == ["/code"]


def test_a_node_that_is_not_there_is_told_with_the_nearest():
    require_nodes([ALL], ["a", "/b"])
    with pytest.raises(UsageError, match="/ns/a"):
        require_nodes([ALL], ["/ns/aa"])
