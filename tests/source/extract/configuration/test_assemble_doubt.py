"""Parameters of nodes of which a part of the start is unknown."""

from roslens.model.configuration import Proof, Unresolved
from roslens.source.extract.configuration.assemble_doubt import doubted
from testbed.configured import launched, node, parameter


def uncertain(*unresolved):
    nodes = [
        node("/a", proof=launched(3), parameters=(parameter("x", value="1"), parameter("y", set_by=launched(3)))),
        node("/b", proof=launched(9), parameters=(parameter("z", value="1"),)),
        node("/c", proof=launched(3)),
    ]
    found = list(doubted(nodes, unresolved))
    assert [one.name for one in found] == ["/a", "/b", "/c"]
    return [one.name for each in found for one in each.parameters if one.uncertain]


def test_where_all_is_known_nothing_is_doubted():
    assert uncertain() == []
    assert uncertain(Unresolved("x", Proof("other.py", 3), "environment X")) == []


def test_an_unknown_file_may_set_any_parameter_of_its_node():
    place = launched(3)
    assert uncertain(Unresolved("a/{environment MODEL}.yaml", place, "environment MODEL")) == ["x", "y"]
