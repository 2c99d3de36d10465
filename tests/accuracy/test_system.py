import pytest

from accuracy.facts import Fact
from accuracy.system import CORPORA, Reason, folder_of, missing, systems


def test_systems_of_both_generations_are_described():
    found = systems()
    assert {one.generation for one in found.values()} == {"ros1", "ros2"}
    assert sum(one.quick for one in found.values()) >= 3


@pytest.mark.parametrize("name", systems())
def test_parts_of_our_own_are_there(name):
    system = systems()[name]
    for part in system.parts:
        if ":" not in part:
            assert folder_of(part).is_dir(), part


def test_a_clone_that_is_not_there_is_told(monkeypatch):
    monkeypatch.delenv(CORPORA, raising=False)
    assert "corpora:examples" in missing(systems()["examples"])


def test_a_reason_holds_for_facts_of_its_patterns():
    why = Reason("run-time only", "because", ("publisher /n* /t",), "missed extra")
    assert why.outside
    assert why.holds(Fact("publisher", "/node", "/t"), "extra")
    assert not why.holds(Fact("publisher", "/node", "/t"), "type")
    assert not why.holds(Fact("subscription", "/node", "/t"), "missed")
    assert Reason("x", "y", ("node /n -",)).holds(Fact("node", "/n"), "missed")
