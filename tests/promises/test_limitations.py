"""What SECURITY says that it does not guarantee is so: nobody is to rely on more, or to fear more, than is true."""

import multiprocessing.util
import os
import signal
import subprocess
import sys
import time
import tracemalloc
from pathlib import Path
from types import SimpleNamespace

import pytest

from roslens.children import sandbox
from roslens.cli.check.kept_new import keep_new, kept_new
from roslens.intake import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.live.adapters.bag.open_bag import open_bag
from roslens.model.source import Location, Package
from roslens.plugins.contract import look_at
from roslens.plugins.discovery import discover
from roslens.plugins.isolation import run_package
from roslens.plugins.points import PackageInput
from roslens.report.run.to_diff import to_diff
from roslens.source.rules.package_findings import MOST_SPENT, _hold

TESTS = Path(__file__).parents[1]
GROWN = """
from shapes.readers import measured, ready
from shapes.shapes import SHAPES
ready("C++")
content = SHAPES["C++"]["unclosed templates"](100_000)
found = measured("C++", content)
print(found.left_out or found.grown * 1e6 / len(content))
"""


def test_hostile_cpp_takes_about_2400_times_its_size():
    # In a new process: one that has read much already has memory to spare, which would not be seen to grow.
    ran = subprocess.run([sys.executable, "-c", GROWN], capture_output=True, text=True, cwd=TESTS, check=True)
    assert 1_800 < float(ran.stdout) < 3_000


def test_no_rule_on_a_package_is_tried_once_three_took_too_long():
    asked = []

    def slow(view):
        asked.append(view)
        raise OverBudgetError("it takes more than 10 s of processor time")
        yield

    rules = [SimpleNamespace(id=f"r{number}", found=slow) for number in range(MOST_SPENT + 2)]
    package = SimpleNamespace(id="a", manifest=Location("a/package.xml"))
    failures = []
    _hold(SimpleNamespace(package=package, by_path={}), rules, {}, failures)
    assert len(asked) == MOST_SPENT
    assert len(failures) == MOST_SPENT + 1
    assert "3 others took too long" in failures[-1].what


ESCAPE = """
import subprocess, sys
from roslens.plugins.points import Manifest
manifest = Manifest(name="away", interface="1.0", version="1", text="t", scopes=("package",))

def analyse_package(package, report):
    words = [sys.executable, "-c", "import sys; sys.stdin.read()"]
    started = subprocess.Popen(words, start_new_session=True, stdin=open({pipe!r}))
    open({told!r}, "w").write(str(started.pid))
"""


def test_a_program_in_a_session_of_its_own_outlives_the_plug_in(tmp_path):
    pipe, told = tmp_path / "pipe", tmp_path / "pid"
    os.mkfifo(pipe)
    (tmp_path / "away.py").write_text(ESCAPE.format(pipe=str(pipe), told=str(told)))
    found = discover(["away.py"], base=tmp_path, search=())
    held = os.open(pipe, os.O_RDWR)
    try:
        package = PackageInput(Package("a", "a", "a", Location("a/package.xml")), str(tmp_path / "a"), ())
        assert not run_package(found.members, package, root=str(tmp_path)).failures
        os.kill(int(told.read_text()), signal.SIGKILL)
    finally:
        os.close(held)


def test_memory_is_limited_on_linux(monkeypatch):
    resource = pytest.importorskip("resource")
    asked = []
    monkeypatch.setattr(resource, "setrlimit", lambda *words: asked.append(words))
    monkeypatch.setattr(sys, "platform", "other")
    file_budget._limit_memory()
    assert asked == []
    monkeypatch.undo()
    monkeypatch.setattr(resource, "setrlimit", lambda *words: asked.append(words))
    if sys.platform == "linux":
        file_budget._limit_memory()
        assert [one[0] for one in asked] == [resource.RLIMIT_AS]


def test_a_patch_keeps_control_characters():
    assert b"+\x1b[31m\n" in b"".join(to_diff("a.py", b"a\n", b"\x1b[31m\n"))


def test_workers_need_a_short_temporary_folder(tmp_path):
    """A socket of a longer path cannot be bound: that is a limit of the system's interface (108 bytes).

    Some Pythons turn to `/tmp` instead, and have a function for that.
    """
    code = (
        "from multiprocessing.connection import Listener, arbitrary_address; "
        "Listener(arbitrary_address('AF_UNIX'), family='AF_UNIX')"
    )
    for length, works in ((60, True), (110, hasattr(multiprocessing.util, "_get_base_temp_dir"))):
        folder = Path("/tmp", f"{os.getpid()}_{time.monotonic_ns()}".ljust(length - 5, "x"))
        folder.mkdir()
        try:
            environment = {**os.environ, "TMPDIR": str(folder)}
            done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, check=False)
            assert (done.returncode == 0) == works, done.stderr
        finally:
            subprocess.run(["rm", "-r", str(folder)], check=True)


def busy(subject, begun):
    with file_budget.file_budget(subject, seconds=0.05):
        while time.process_time() - begun < 60:
            pass


def test_each_file_has_a_time_of_its_own():
    file_budget.begin_reading()
    for number in range(4):
        begun = time.process_time()
        with pytest.raises(OverBudgetError):
            busy(f"{number}.xml", begun)
        assert time.process_time() - begun >= 0.05
    file_budget.begin_reading()


def most_memory(folder, chunks):
    """Return the bytes that reading a recording takes whose chunks hold four megabytes each."""
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore

    writer = Writer(folder / f"{chunks}.bag")
    writer.chunk_threshold = 1_000_000
    writer.set_compression(Writer.CompressionFormat.BZ2)
    with writer:
        line = writer.add_connection("/a", "geometry_msgs/msg/PoseStamped", typestore=get_typestore(Stores.ROS1_NOETIC))
        for number in range(chunks):
            writer.write(line, (number + 1) * 10**9, bytes(4_000_000))
    bag = open_bag(writer.path)
    tracemalloc.start()
    try:
        for _ in bag.tallies(stamps=["/a"]):
            pass
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_many_chunks_of_a_recording_take_no_more_memory_than_few(tmp_path):
    few, many = most_memory(tmp_path, 2), most_memory(tmp_path, 12)
    assert few > 4_000_000, "they are unpacked"
    assert many < few * 1.5


def test_without_landlock_a_plug_in_runs_in_no_sandbox(monkeypatch):
    for name in ("restrict", "refuse_sockets", "bubblewrap"):
        monkeypatch.setattr(sandbox, name, lambda *_, **__: pytest.fail("there is none"))
    monkeypatch.setattr(sandbox, "landlock_version", lambda: 0)
    sandbox.confine(sandbox.Sandbox())


WRITES = """
from pathlib import Path
from roslens.plugins.points import Manifest
manifest = Manifest(name="writes", interface="1.0", version="1", text="t", scopes=("package",))

def analyse_package(package, report):
    Path({told!r}).write_text("out of every sandbox")
"""


def test_the_contract_runs_a_plug_in_without_a_sandbox(tmp_path):
    told = tmp_path / "told"
    (tmp_path / "writes.py").write_text(WRITES.format(told=str(told)))
    (tmp_path / "a.py").write_text("x = 1\n")
    look_at(tmp_path / "writes.py", tmp_path / "a.py")
    assert told.read_text() == "out of every sandbox"


def test_what_is_new_in_a_run_is_not_sealed(tmp_path):
    keep_new(tmp_path, 1, "HEAD", [])
    (place,) = tmp_path.iterdir()
    assert kept_new(tmp_path, 1) == ()
    place.write_text('{"run":1,"baseline":"HEAD","first":[{"rule":"a.b","severity":"note","count":3}]}')
    assert [one.rule for one in kept_new(tmp_path, 1)] == ["a.b"]
