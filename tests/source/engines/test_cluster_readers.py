"""Each thread of a worker of a cluster has a process that reads for it: what ends that costs one file or one task."""

import json
import os
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from cli.broken_parser import BREAKING
from shapes.readers import read_shape
from shapes.shapes import SHAPES

from roslens.cli.main import main
from roslens.intake.file_budget import LEAST_MEMORY, MOST_MEMORY, memory_of_file
from roslens.source.engines import cluster_readers as module
from roslens.source.engines.cluster_readers import lent_reader, make_readers_ready
from roslens.source.engines.dask_engine import DaskEngine, fit_client
from roslens.source.engines.executor import InProcess
from roslens.source.engines.task_batch import run_batch
from roslens.source.engines.task_limits import TaskLimits

sys.path.insert(0, os.path.dirname(__file__))  # noqa: PTH120 - the cluster of a test beside
from test_dask_engine import cluster

FREE = TaskLimits(seconds=0, memory_bytes=0)
MANIFEST = (
    '<package format="3"><name>{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>\n'
)


@pytest.fixture(autouse=True)
def _own_readers(monkeypatch):
    made = []
    monkeypatch.setattr(module, "_idle", made)
    yield
    for reader in made:
        reader.end()


def in_a_thread(function, *given):
    """Do something as a worker of a cluster does: in a thread that is not the main one."""
    found = []
    thread = threading.Thread(target=lambda: found.append(function(*given)))
    thread.start()
    thread.join()
    return found[0]


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")
@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("abort", "or breaks the parser"),
        ("large", "MB of memory"),
        ("slow", "1 s of processor time"),
        ("spin", "s of processor time"),
    ],
)
def test_one_file_is_lost_and_named_and_the_rest_of_its_package_goes_on(reading, tmp_path, written, text, why):
    written(before="1", bad=text, after="2")
    tasks = [("read", str(tmp_path), *names) for names in (("before", "bad", "after"), ("after",))]
    (_, found), (_, more) = in_a_thread(run_batch, reading.run, FREE, str(tmp_path), tasks)
    assert why in found.pop("bad")
    assert (found, more) == ({"before": "1", "after": "2"}, {"after": "2"})


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")
def test_a_task_that_loses_its_process_has_another_one_and_no_third(reading, tmp_path):
    tasks = [("lost",), ("lost_once", str(tmp_path / "mark")), ("printed",)]
    lost, once, last = run_batch(reading.run, TaskLimits(seconds=7), "", tasks)
    assert str(lost) == "the worker process died twice on this task, which may take 7 s and 4 GB"
    assert (once, last) == ("found", [])


def test_a_task_that_takes_too_long_ends_its_process_alone(reading):
    slow, after = run_batch(eval, TaskLimits(seconds=0.3), "", ["__import__('time').sleep(60)", "7"])
    assert "which may take 0.3 s" in str(slow)
    assert after == 7


def test_limits_are_those_of_the_process_that_reads_and_not_of_the_worker():
    import resource

    before = [resource.getrlimit(limit) for limit in (resource.RLIMIT_DATA, resource.RLIMIT_FSIZE)]
    code = "__import__('resource').getrlimit(__import__('resource').RLIMIT_DATA)[0]"
    assert run_batch(eval, TaskLimits(memory_bytes=3_000_000_000), "", [code]) == [3_000_000_000]
    assert [resource.getrlimit(limit) for limit in (resource.RLIMIT_DATA, resource.RLIMIT_FSIZE)] == before


def test_memory_is_shared_by_the_threads_of_a_host(reading):
    whole, half = run_batch(reading.run, FREE, "", [("memory",)]), memory_of_file(64)
    assert whole == [memory_of_file()]
    assert run_batch(reading.run, TaskLimits(jobs=64), "", [("memory",)]) == [half]
    assert LEAST_MEMORY <= half <= MOST_MEMORY


def test_the_next_batch_has_the_same_process_and_threads_have_one_each(reading, tmp_path):
    task = ("read", str(tmp_path))
    ((first, _),) = run_batch(reading.run, FREE, str(tmp_path), [task])
    ((second, _),) = run_batch(reading.run, FREE, "/elsewhere", [task])
    assert first == second != os.getpid()
    with lent_reader(""):
        ((third, _),) = run_batch(reading.run, FREE, "", [task])
        assert third not in (first, os.getpid())


def descriptors():
    return len(list(Path("/proc/self/fd").iterdir())) if sys.platform == "linux" else 0


def test_one_that_has_nothing_to_do_ends_and_the_next_task_has_another(reading, tmp_path, monkeypatch):
    monkeypatch.setattr(module, "IDLE_S", 0.05)
    task = ("read", str(tmp_path))
    ((first, _),) = run_batch(reading.run, FREE, "", [task])
    (reader,) = module._idle
    assert reader._process._process.wait(60) == 0
    before = descriptors()
    ((second, _),) = run_batch(reading.run, FREE, "", [task])
    assert first != second
    assert descriptors() == before


def test_they_are_started_and_made_ready_before_there_is_work(reading, tmp_path):
    worker = SimpleNamespace(state=SimpleNamespace(nthreads=2))
    make_readers_ready(time.time, worker)
    make_readers_ready(time.time, worker)
    ready = [reader._process._process.pid for reader in module._idle]
    assert len(set(ready)) == 2
    ((pid, _),) = run_batch(reading.run, FREE, "", [("read", str(tmp_path))])
    assert pid == ready[1]


def workers(address):
    """Return the workers of a cluster, which have other addresses after each start."""
    client = fit_client(address, "")
    try:
        return set(client.nthreads())
    finally:
        client.close()


@pytest.mark.heavy
@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")
def test_a_file_that_ends_its_reader_is_named_by_a_cluster_and_costs_no_worker(tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    (tmp_path / "hooks").mkdir()
    (tmp_path / "hooks" / "sitecustomize.py").write_text(BREAKING)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "hooks"))
    monkeypatch.setenv("BROKEN_BY", "arm/a.cpp:arm/CMakeLists.txt")
    for name in ("arm", "leg"):
        (tmp_path / "ws" / name).mkdir(parents=True)
        (tmp_path / "ws" / name / "package.xml").write_text(MANIFEST.format(name))
        (tmp_path / "ws" / name / "CMakeLists.txt").write_text(f"project({name})\nadd_executable(a a.cpp)\n")
        for file in ("a.cpp", "b.cpp"):
            (tmp_path / "ws" / name / file).write_text("int f(int x) { if (x) { return 1; } return 0; }\n")
    out = tmp_path / "r.json"
    with cluster(tmp_path, 1) as (address, _):
        before = workers(address)
        words = ["check", str(tmp_path / "ws"), "-q", "--no-store", "--no-cache", "--no-graph", "--trust"]
        code = main([*words, "--engine", address, "--format", "json", "-o", str(out)])
        assert workers(address) == before
    found = json.loads(out.read_text())
    lost = {one["path"]: one["what"] for one in found["failures"]}
    assert code == 3
    assert lost.keys() == {"arm/a.cpp", "arm/CMakeLists.txt"}
    assert all("or breaks the parser" in what for what in lost.values())
    assert {"arm/b.cpp", "leg/a.cpp", "leg/b.cpp"} <= {one["path"] for one in found["files"]}


@pytest.mark.heavy
@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")
def test_worst_shapes_are_read_by_a_cluster_or_left_out_and_cost_no_worker(tmp_path, monkeypatch):
    """In a thread nothing interrupts Python: without a process of its own this file takes minutes."""
    pytest.importorskip("distributed")
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    worst = ("CMake", "branches", 350_000)
    tasks = [worst, *((grammar, name, 4_000) for grammar in SHAPES for name in list(SHAPES[grammar])[:3])]
    with cluster(tmp_path, 1) as (address, _):
        before = workers(address)
        engine = DaskEngine(address, rest=InProcess())
        results = dict(engine.run(read_shape, tasks))
        assert workers(address) == before
    assert engine.done_here == 0
    assert "10 s of processor time" in str(results.pop(worst))
    assert set(results.values()) == {None}
