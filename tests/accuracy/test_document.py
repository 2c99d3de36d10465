from accuracy.comparing import compare, silent_nodes
from accuracy.document import document
from accuracy.facts import Fact, seen
from accuracy.held_out import held_out
from accuracy.held_out_page import section
from accuracy.kept import kept_facts, kept_graph
from accuracy.system import ROOT, System, systems

SYSTEM = System("a robot", "ros1", "p/x.launch", ("examples/robot",), "It shows nothing.", 1)


def test_the_page_is_what_was_recorded():
    found = []
    for system in systems().values():
        graph = kept_graph(system)
        if graph is not None:
            silent = silent_nodes(graph)
            found.append((system, compare(seen(graph), kept_facts(system), system.reasons, system.generation, silent)))
    page = document(found, section(held_out()))
    assert (ROOT / "docs" / "accuracy.md").read_text() == page, "`make accuracy` writes it"


def test_shares_are_cut_and_what_is_wrong_is_marked():
    shown = [Fact("node", f"/n{number}") for number in range(2000)]
    one = compare(shown, [*shown[1:], Fact("node", "/x")], (), "ros1")
    page = document([(SYSTEM, one)])
    assert "| node | 2000 | 1999 | 99.9 % | 2000 | 1999 | 99.9 % | 0 | 0 | 1 |" in page
    assert "node /x (), certain **wrong**" in page.replace("(**wrong**)", "**wrong**")
    assert "## ROS 2" not in page
