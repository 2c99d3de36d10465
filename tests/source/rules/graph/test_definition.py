from roslens.source.rules.graph.definition import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings()))


def test_two_sums_of_one_type_are_told():
    (one,) = findings(
        node("/a", end("pub", "/p", "m/A", hash="RIHS01_aaaaaaaaaaaa")),
        node("/b", end("sub", "/p", "m/A", hash="RIHS01_bbbbbbbbbbbb")),
    )
    assert "RIHS01_bbbbbbb and RIHS01_aaaaaaa. Build both against the same version of m." in one.message


def test_the_same_sum_an_unknown_one_and_another_type_are_none():
    assert not findings(
        node("/a", end("pub", "/p", "m/A", hash="1")),
        node("/b", end("sub", "/p", "m/A", hash="1")),
        node("/c", end("sub", "/p", "m/A")),
        node("/d", end("sub", "/p", "m/B", hash="2")),
    )
