"""How long a workspace of the size of three large repositories, and one of a thousand packages, takes."""

import sqlite3
import time
import tracemalloc

import pytest

from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.result import WorkspaceResult
from roslens.store.runs import Store

CALM_S = 0.080
"""CPU seconds of the reference work in ``slowness`` on a calm 2.5 GHz core."""

pytestmark = [pytest.mark.heavy, pytest.mark.timed]


def cpu_s(act, times=3):
    best = float("inf")
    for _ in range(times):
        begun = time.process_time()
        act()
        best = min(best, time.process_time() - begun)
    return best


@pytest.fixture
def slowness():
    """How many times slower this machine is, right now, than the one the limits were set on (at least 1)."""

    def work():
        connection = sqlite3.connect(":memory:")
        connection.execute("CREATE TABLE t (a PRIMARY KEY, b, c)")
        connection.executemany(
            "INSERT INTO t VALUES (?, ?, ?)", ((str(number), number, "text" * 9) for number in range(50_000))
        )
        connection.close()

    return max(1.0, cpu_s(work, 5) / CALM_S)


def write(path, sample, units, key):
    header = sample.header(key)
    with Store.open(path) as store, store.writing(header) as writer:
        for unit, result in units:
            (writer.reuse(unit) if store.has_unit(unit) else writer.add(unit, result))
        values = {result.package.id: {"dependents": 1, "tier": 2} for _unit, result in units}
        writer.complete(WorkspaceResult(package_values=values, rules=sample.RULES * 100), header)


def test_94_packages(tmp_path, sample, slowness):
    units = list(sample.large(94))
    places = iter(range(3))
    assert cpu_s(lambda: write(tmp_path / f"{next(places)}.sqlite", sample, units, "key")) < 0.6 * slowness

    path = tmp_path / "0.sqlite"

    def warm():
        with Store.open(path) as store:
            assert len(store.view(store.run_with("key")).packages()) == 94

    assert cpu_s(warm, 5) < 0.025 * slowness

    changed = [("key-changed", units[0][1]), *units[1:]]
    assert cpu_s(lambda: write(path, sample, changed, "key-2"), 1) < 0.06 * slowness


def test_1000_packages(tmp_path, sample, slowness):
    path = tmp_path / "store.sqlite"
    write(path, sample, list(sample.large(1000, entities=60, findings=50)), "key")
    with Store.open(path) as store:
        view = store.view()
        package = "package_0500"
        file = next(iter(view.files(package=package)))[1].path
        rule = "family_2.rule_07"
        questions = {
            "overview": lambda: view.packages(),
            "package": lambda: view.package(package),
            "file": lambda: (list(view.findings(path=file)), list(view.entities(path=file))),
            "rule": lambda: (list(view.findings(rule=rule, limit=200)), view.count_findings(rule=rule)),
            "last page of findings": lambda: list(view.findings(limit=200, offset=49_800)),
            "filtered": lambda: list(
                view.findings(include_tags=["tag_3"], exclude_tags=["family_1"], severity=Severity.ERROR, limit=200)
            ),
            "count": lambda: view.count_findings(exclude_tags=["tag_3"]),
            "distribution": lambda: view.numbers_of("quantity_07", EntityKind.FUNCTION),
            "worst": lambda: view.extremes_of("quantity_07", EntityKind.FUNCTION),
            "values": lambda: view.values_of("quantity_07", EntityKind.FUNCTION),
            "failures": lambda: view.failures(),
        }
        slow = {name: seconds for name, ask in questions.items() if (seconds := cpu_s(ask)) > 0.2 * slowness}
        assert slow == {}
        assert sum(1 for _ in view.findings()) == 50_000
        assert sum(1 for _ in view.entities()) == 60_000


def test_reading_all_takes_no_more_memory_than_a_part(tmp_path, sample):
    path = tmp_path / "store.sqlite"
    write(path, sample, list(sample.large(200, entities=60, findings=50)), "key")
    with Store.open(path) as store:
        view = store.view()
        tracemalloc.start()
        assert sum(1 for _ in view.findings()) == 10_000
        assert sum(1 for _ in view.entities()) == 12_000
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    assert peak < 1_000_000
