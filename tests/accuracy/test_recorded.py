"""Source against the graphs that were recorded of running systems."""

import shutil

import pytest

from accuracy import ros1, ros2
from accuracy.comparing import IMPLICIT, compare, silent_nodes, total
from accuracy.facts import Fact, seen
from accuracy.kept import kept_facts, kept_graph
from accuracy.reading import lay_out, read
from accuracy.system import missing, systems

SYSTEMS = systems()
RECALL, PRECISION = 0.91, 0.98
"""Of all systems together, without what every node has; docs/accuracy.md says what is missed and why."""


def judged(system, graph, told):
    return compare(seen(graph), told, system.reasons, system.generation, silent_nodes(graph))


def there(system):
    if reason := missing(system):
        pytest.skip(f"{reason}: `make accuracy` says where from")


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_difference_has_a_reason_and_none_is_a_wrong_certainty(name):
    system = SYSTEMS[name]
    graph = kept_graph(system)
    if graph is None:
        pytest.skip("it was not recorded")
    found = judged(system, graph, kept_facts(system))
    assert [one.text for one in found.unexplained] == []
    assert [one.text for one in found.wrong] == []


def test_all_that_was_recorded_is_found():
    rows = []
    for system in SYSTEMS.values():
        graph = kept_graph(system)
        if graph is not None:
            rows.append(judged(system, graph, kept_facts(system)).rows)
    row = total([{"node": one} for part in rows for name, one in part.items() if name != IMPLICIT])["node"]
    assert row.found >= RECALL * row.seen
    assert row.right >= PRECISION * row.said


def bare(facts: tuple[Fact, ...]):
    return {(one.key, tuple(sorted(one.values.items())), one.sure, one.resolved) for one in facts}


@pytest.mark.parametrize(
    "name", [pytest.param(one.name, marks=[] if one.quick else [pytest.mark.slow]) for one in SYSTEMS.values()]
)
def test_source_says_no_less_than_it_did(name, tmp_path):
    system = SYSTEMS[name]
    there(system)
    graph = kept_graph(system)
    if graph is None:
        pytest.skip("it was not recorded")
    lay_out(system, tmp_path)
    now = judged(system, graph, read(system, tmp_path))
    then = judged(system, graph, kept_facts(system))
    assert [one.text for one in now.wrong] == []
    assert {one.fact.key for one in now.differences if one.what == "missed"} <= {
        one.fact.key for one in then.differences if one.what == "missed"
    }


@pytest.mark.real
@pytest.mark.parametrize("name", [one.name for one in SYSTEMS.values() if one.quick])
def test_what_runs_now_is_what_source_says(name, tmp_path):
    system = SYSTEMS[name]
    there(system)
    live = ros1 if system.generation == "ros1" else ros2
    if reason := live.why_not(system):
        pytest.skip(reason)
    workspace = lay_out(system, tmp_path / "workspace")
    told = read(system, tmp_path / "workspace")
    run = tmp_path / "run"
    run.mkdir()
    graph = (
        ros1.record(system, workspace, run) if live is ros1 else ros2.record(system, workspace, run, ros2.free_domain())
    )
    found = judged(system, graph, told)
    assert [one.text for one in found.wrong] == []
    assert [one.text for one in found.unexplained] == []
    shutil.rmtree(run, ignore_errors=True)
