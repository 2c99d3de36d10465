import sys

import pytest

from accuracy.observing import NotThereError, kept, observe
from roslens.model.graph import Endpoint, Graph, Node, Process, Role

pytestmark = pytest.mark.timed

SPEAK = """
import sys, time
from roslens.model.graph import Graph, Node
from roslens.model.wire import VERSION, Frame, encode_frame
graph = Graph("ros2", (Node("/a"), Node("/b")), parameters={"/a": {}})
sys.stdout.buffer.write(encode_frame(Frame(VERSION, "x", 0, 1.0, graph=graph)))
sys.stdout.flush()
time.sleep(60)
"""


def test_a_graph_that_stays_is_the_whole():
    graph = observe([sys.executable, "-c", SPEAK], {}, 2, 1)
    assert [node.name for node in graph.nodes] == ["/a", "/b"]


def test_an_observer_that_ends_is_told():
    with pytest.raises(NotThereError, match="ended with 3"):
        observe([sys.executable, "-c", "raise SystemExit(3)"], {}, 1)


def test_what_is_another_one_each_time_is_not_kept():
    end = Endpoint("/a", Role.PUBLISHER, "/t", gid="01")
    graph = Graph("ros2", (Node("/a", "host", 7, ("gid",)),), (end,), ("host",), (Process("host", 7),))
    found = kept(graph)
    assert found.nodes == (Node("/a"),)
    assert found.endpoints[0].gid == ""
    assert found.processes == found.hosts == ()
