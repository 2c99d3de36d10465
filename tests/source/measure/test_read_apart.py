"""A large file is read within bounds of time and memory from outside, is named, and the rest of its package goes on."""

import json
import os
import resource
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import msgspec
import pytest

from roslens.intake.file_budget import LEAST_MEMORY, MOST_MEMORY, Slot, memory_of_file, unwatch, watch
from roslens.intake.time_budget import OverBudgetError
from roslens.model.source import Language
from roslens.source.measure import read_apart as module
from roslens.source.measure.analyse_file import FileAnalysis, analyse_file
from roslens.source.measure.fresh_package import FreshPackages
from roslens.source.measure.read_apart import LARGE_BYTES, UNWATCHED_BYTES, Asked, most_bytes_here, read_apart
from roslens.source.settings import MacroSettings, SourceSettings
from roslens.store.cache import Cache

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">A</maintainer><license>MIT</license></package>
"""
COMPARISONS = b"auto x = " + b"a<b," * 1_200_000
STATEMENTS = b"void f(){" + b"x=y;" * 700_000 + b"}"


@pytest.fixture
def fresh():
    """End the process that reads large files, before and after."""
    if module._held is not None:
        module._held.end()
    yield
    if module._held is not None:
        module._held.end()


def test_it_gives_what_reading_here_gives(fresh):
    content = b"int f(int a) { if (a) { return 1; } return 0; }\n" * 100
    asked = Asked(content, Language.CPP, MacroSettings(), analysis=True, program=True)
    given = read_apart(asked)
    assert msgspec.msgpack.decode(given.analysis, type=FileAnalysis) == analyse_file(
        content, Language.CPP, MacroSettings()
    )
    assert given.program


def test_what_needs_too_much_memory_is_told_and_the_next_file_is_read(fresh, monkeypatch):
    monkeypatch.setattr(module, "memory_of_file", lambda: LEAST_MEMORY)
    with pytest.raises(OverBudgetError, match="it needs more than 512 MB of memory"):
        read_apart(Asked(COMPARISONS, Language.CPP, MacroSettings(), analysis=True))
    assert read_apart(Asked(b"int x;\n", Language.CPP, MacroSettings(), analysis=True)).analysis


@pytest.mark.heavy
def test_what_takes_too_long_is_ended_from_outside(fresh):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with pytest.raises(OverBudgetError, match="it takes more than 10 s of processor time"):
        read_apart(Asked(STATEMENTS, Language.CPP, MacroSettings(), analysis=True))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime < 16


def test_the_process_ends_with_the_one_that_started_it(fresh, tmp_path):
    code = (
        "import os\nfrom roslens.model.source import Language\nfrom roslens.source.settings import MacroSettings\n"
        "from roslens.source.measure import read_apart as m\n"
        "m.read_apart(m.Asked(b'int x;', Language.CPP, MacroSettings(), analysis=True))\n"
        "print(m._held._process.pid, flush=True)\nos.kill(os.getpid(), 9)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False, text=True)
    pid = int(done.stdout)
    end = time.monotonic() + 30
    while "Z" not in status(pid):
        assert time.monotonic() < end
        os.sched_yield()


def status(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"


def test_half_of_the_memory_is_shared_out(monkeypatch):
    whole = {"SC_PHYS_PAGES": 16_000_000_000 // 4096, "SC_PAGE_SIZE": 4096}
    monkeypatch.setattr(module.os, "sysconf", lambda name: whole[name])
    for processors, memory in ((2, MOST_MEMORY), (8, 1_000_000_000), (64, LEAST_MEMORY)):
        monkeypatch.setattr(module.os, "cpu_count", lambda count=processors: count)
        assert abs(memory_of_file() - memory) < 10_000


def test_the_rest_of_the_package_goes_on(tmp_path, fresh):
    package = tmp_path / "arm"
    package.mkdir()
    (package / "package.xml").write_text(MANIFEST)
    (package / "good.cpp").write_text("int f() { return 1; }\n")
    (package / "large.cpp").write_bytes(b"int g() { return 1; }\n" * (LARGE_BYTES // 22 + 10))
    (package / "bad.cpp").write_bytes(COMPARISONS)
    roslens = [sys.executable, "-m", "roslens.cli.main"]
    words = ["check", str(tmp_path), "--jobs", "1", "--format", "json", "--no-store", "--no-cache", "--model", "ros"]
    done = subprocess.run([*roslens, *words], capture_output=True, check=False)
    assert done.returncode == 3, done.stderr
    report = json.loads(done.stdout)
    (failure,) = [one for one in report["failures"] if one["path"] == "arm/bad.cpp"]
    assert failure["what"].startswith("the file is left out: it needs more than")
    paths = {one["path"] for one in report["entities"] if one["kind"] == "file"} if "entities" in report else None
    assert paths is None or {"arm/good.cpp", "arm/large.cpp"} <= paths


def test_less_is_read_here_where_nobody_watches():
    assert most_bytes_here() == UNWATCHED_BYTES < LARGE_BYTES
    watch(Slot())
    try:
        assert most_bytes_here() == LARGE_BYTES
        with ThreadPoolExecutor(1) as other:
            # The kernel's bounds are those of the main thread.
            assert other.submit(most_bytes_here).result() == UNWATCHED_BYTES
    finally:
        unwatch()


def test_what_nobody_watches_is_read_apart(tmp_path, fresh, monkeypatch):
    """A process that none watches, as outside of Linux: a source costs it neither memory nor time."""
    package = tmp_path / "arm"
    package.mkdir()
    (package / "package.xml").write_text(MANIFEST)
    (package / "bad.cpp").write_bytes(b"auto x = " + b"a<b," * 50_000)
    (package / "good.cpp").write_text("int f() { int x; if (x) return 1; return 0; }\n" * 2_000)
    monkeypatch.setattr(module, "memory_of_file", lambda: 300_000_000)
    files = FreshPackages([tmp_path], SourceSettings(), tmp_path, Cache.open(None))
    found = files.look("arm/bad.cpp")
    assert "it needs more than 300 MB of memory" in found.failures[0].what
    assert not files.look("arm/good.cpp").failures


def test_it_may_have_been_started_by_a_thread_that_is_gone(fresh):
    asked = Asked(b"int x;\n", Language.CPP, MacroSettings(), analysis=True)
    with ThreadPoolExecutor(1) as other:
        assert other.submit(read_apart, asked).result().analysis
    if module._held is not None:
        module._held._process.wait(60) if sys.platform == "linux" else None
    assert read_apart(asked).analysis
