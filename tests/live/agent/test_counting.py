from roslens.live.agent.counting import with_nodes
from roslens.model.graph import Process

NODES = {7: frozenset({"/b", "/a"})}


def test_nodes_are_in_the_process_that_sees_this_id_of_itself():
    processes = (Process("base", 7), Process("base", 8), Process("base", 9, inner=70))
    assert with_nodes(processes, {**NODES, 70: frozenset({"/c"})}) == (
        Process("base", 7, nodes=("/a", "/b")), Process("base", 8), Process("base", 9, inner=70, nodes=("/c",)),
    )  # fmt: skip


def test_of_two_that_see_the_same_id_nobody_knows():
    processes = (Process("base", 7), Process("base", 4000, inner=7))
    assert with_nodes(processes, NODES) == processes
