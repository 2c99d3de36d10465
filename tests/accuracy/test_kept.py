from accuracy import kept
from accuracy.facts import Fact
from accuracy.system import System
from roslens.model.graph import Graph, Node

SYSTEM = System("a robot", "ros1", "p/x.launch", (), "It shows nothing.", 1, name="robot")


def test_what_is_kept_is_found_again_and_the_same_each_time(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "RECORDED", tmp_path / "recorded")
    assert kept.kept_graph(SYSTEM) is None
    graph, told = Graph("ros1", (Node("/n"),)), (Fact("node", "/n"),)
    kept.keep(SYSTEM, graph, told)
    assert kept.kept_graph(SYSTEM) == graph
    assert kept.kept_facts(SYSTEM) == told
    written = (tmp_path / "recorded" / "robot.live.json").read_bytes()
    kept.keep(SYSTEM, None, told)
    assert (tmp_path / "recorded" / "robot.live.json").read_bytes() == written
