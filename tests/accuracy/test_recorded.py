"""Source against the graphs that were recorded of running systems."""

import shutil

import pytest

from accuracy import ros1, ros2
from accuracy.comparing import IMPLICIT, compare, silent_nodes, total
from accuracy.facts import seen
from accuracy.kept import kept_facts, kept_graph
from accuracy.reading import lay_out, read
from accuracy.system import missing, systems

SYSTEMS = systems()
RECALL, PRECISION = 0.93, 0.98
"""Of all systems together, without what every node has; docs/accuracy.md says what is missed and why."""
LEAST = {"cameras": 0.62}
"""The recall of a system of which a whole kind of program is not followed, apart from the others: nodelet::Loader."""


def judged(system, graph, told):
    return compare(seen(graph), told, system.reasons, system.generation, silent_nodes(graph))


def recorded(system):
    graph = kept_graph(system)
    assert graph is not None, f"{system.name} was never recorded: run `make accuracy ARGS={system.name}`"
    return graph


def there(system):
    if reason := missing(system):
        pytest.skip(f"{reason}: `make accuracy` says where from")


def marks(system):
    fetched = any(part.startswith(("corpora:", "source:")) for part in system.parts)
    return () if system.quick else (pytest.mark.heavy, pytest.mark.corpora) if fetched else (pytest.mark.heavy,)


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_difference_has_a_reason_and_none_is_a_wrong_certainty(name):
    system = SYSTEMS[name]
    graph = recorded(system)
    found = judged(system, graph, kept_facts(system))
    assert [one.text for one in found.unexplained] == []
    assert [one.text for one in found.wrong] == []


def of_all(chosen):
    rows = [judged(system, recorded(system), kept_facts(system)).rows for system in chosen]
    return total([{"node": one} for part in rows for name, one in part.items() if name != IMPLICIT])["node"]


def test_all_that_was_recorded_is_found():
    row = of_all(system for name, system in SYSTEMS.items() if name not in LEAST)
    assert row.found >= RECALL * row.seen
    for name, least in LEAST.items():
        one = of_all([SYSTEMS[name]])
        assert one.found >= least * one.seen
    row = of_all(SYSTEMS.values())
    assert row.right >= PRECISION * row.said


@pytest.mark.parametrize("name", [pytest.param(one.name, marks=marks(one)) for one in SYSTEMS.values()])
def test_source_says_no_less_than_it_did(name, tmp_path):
    system = SYSTEMS[name]
    there(system)
    graph = recorded(system)
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
