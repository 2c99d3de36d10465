import os
import subprocess
import sys

import pytest

from roslens.live.agent.processes import IN_TURN, ProcessSampler
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.graph import Change


def stat(pid, *, ticks=0, started=500, pages=10, threads=3, name="a (b) c", state="S"):
    fields = ["0"] * 50
    fields[11], fields[12], fields[17], fields[19], fields[21] = str(ticks), "0", str(threads), str(started), str(pages)
    return f"{pid} ({name}) {' '.join([state, *fields[1:]])}\n"


class Machine:
    def __init__(self, root):
        self.root = root
        self.handles = {}
        (root / "meminfo").write_text("MemTotal: 4000 kB\n")
        (root / "uptime").write_text("1000.00 900.00\n")
        (root / "stat").write_text("cpu 1\nbtime 1700000000\n")

    def start(self, pid, command="python3\0talker.py\0--ros-args\0", maps="", **given):
        folder = self.root / str(pid)
        (folder / "fd").mkdir(parents=True, exist_ok=True)
        (folder / "cmdline").write_text(command)
        (folder / "maps").write_text(maps)
        (folder / "stat").write_text(stat(pid, **given))

    def run(self, pid, **given):
        (self.root / str(pid) / "stat").write_text(stat(pid, **given))

    def stop(self, pid):
        for path in sorted((self.root / str(pid)).rglob("*"), reverse=True):
            path.rmdir() if path.is_dir() else path.unlink()
        (self.root / str(pid)).rmdir()


@pytest.fixture
def machine(tmp_path):
    return Machine(tmp_path)


@pytest.fixture
def sampler(machine):
    made = ProcessSampler("base", proc=machine.root, open_handle=lambda _: -1, ticks_per_second=100, page_bytes=4096)
    yield made
    made.close()


def reported(events):
    return [(event.change.value, event.entity) for event in events]


def test_processes_of_ros_are_found_by_what_they_were_called_with_and_what_they_loaded(machine, sampler):
    machine.start(10)
    machine.start(11, "bash\0", started=0)
    machine.start(12, "camera_driver\0", "7f00 r-xp /opt/ros/lib/libroscpp.so\n")
    machine.start(13, "/usr/bin/python3\0/usr/bin/rosmaster\0--core\0")
    assert reported(sampler.find(1.0)) == [
        ("appeared", "process:base/10"),
        ("appeared", "process:base/12"),
        ("appeared", "process:base/13"),
    ]
    assert sampler.find(2.0) == []
    first = sampler.processes()[0]
    assert (first.pid, first.command, first.started) == (10, "python3 talker.py --ros-args", 1700000005.0)


def test_a_young_program_is_looked_at_again(machine, sampler):
    machine.start(10, "camera\0", started=99_950)
    assert sampler.find(1.0) == []
    machine.start(10, "camera\0", "librmw_fastrtps_cpp.so", started=99_950)
    assert reported(sampler.find(2.0)) == [("appeared", "process:base/10")]


def test_what_is_known_to_hold_nodes_is_watched_whatever_it_looks_like(machine, sampler):
    machine.start(10, "python3\0talker.py\0")
    assert sampler.find(1.0) == []
    sampler.name([10, 11])
    assert reported(sampler.find(2.0)) == [("appeared", "process:base/10")]


def test_values(machine, sampler):
    machine.start(10, ticks=100)
    sampler.find(1.0)
    assert sampler.sample(1.0)[0].values == {
        "memory": 40960.0, "threads": 3.0, "memory_share": 1.0, "open_files": 0.0, "stopped": 0.0, "hung": 0.0,
    }  # fmt: skip
    machine.run(10, ticks=150, pages=20, threads=4)
    values = sampler.sample(3.0)[0].values
    assert (values["cpu"], values["memory"], values["threads"]) == (25.0, 81920.0, 4.0)


@pytest.mark.parametrize("state", ["T", "t"])
def test_how_long_a_process_has_been_stopped(machine, sampler, state):
    machine.start(10)
    sampler.find(1.0)
    sampler.sample(1.0)
    machine.run(10, state=state)
    assert [sampler.sample(time)[0].values["stopped"] for time in (2.0, 3.0)] == [1.0, 2.0]
    machine.run(10)
    assert sampler.sample(4.0)[0].values["stopped"] == 0.0


def test_a_moment_in_the_kernel_is_no_hang(machine, sampler):
    machine.start(10, state="D")
    sampler.find(1.0)
    assert [sampler.sample(time)[0].values["hung"] for time in (1.0, 2.0, 3.0)] == [0.0, 1.0, 2.0]
    machine.run(10)
    assert sampler.sample(4.0)[0].values["hung"] == 0.0
    machine.run(10, state="D")
    assert sampler.sample(5.0)[0].values["hung"] == 0.0


def test_dear_values_come_in_turn(machine, sampler):
    machine.start(10)
    folder = machine.root / "10"
    (folder / "status").write_text("voluntary_ctxt_switches:\t5\nnonvoluntary_ctxt_switches:\t5\n")
    (folder / "io").write_text("rchar: 1\nread_bytes: 1000\nwrite_bytes: 0\n")
    sampler.find(0.0)
    sampler.sample(0.0)
    (folder / "status").write_text("voluntary_ctxt_switches:\t45\nnonvoluntary_ctxt_switches:\t5\n")
    (folder / "io").write_text("rchar: 1\nread_bytes: 9000\nwrite_bytes: 4000\n")
    (folder / "fd" / "3").write_text("")
    values = [sampler.sample(float(second))[0].values for second in range(1, IN_TURN + 1)][-1]
    assert values["open_files"] == 1.0
    assert values["context_switches"] > 0
    assert values["disk_read"] == 2 * values["disk_write"]


def test_how_long_its_threads_wait_for_a_processor(machine, sampler):
    machine.start(10)
    tasks = machine.root / "10" / "task"
    for thread, waited in (("10", 0), ("11", 5_000_000)):
        (tasks / thread).mkdir(parents=True)
        (tasks / thread / "schedstat").write_text(f"1000 {waited} 3\n")
    sampler.find(0.0)
    assert "cpu_wait" not in sampler.sample(0.0)[0].values
    (tasks / "11" / "schedstat").write_text("1000 2505000000 9\n")
    values = [sampler.sample(float(second))[0].values for second in range(1, IN_TURN + 1)]
    waited = [(at, one["cpu_wait"]) for at, one in enumerate(values, 1) if "cpu_wait" in one]
    assert waited[0][1] == pytest.approx(100 * 2.5 / waited[0][0])


def test_an_end_is_told_once(machine, sampler):
    machine.start(10)
    sampler.find(1.0)
    machine.stop(10)
    assert sampler.sample(1.5) == []
    assert reported(sampler.find(2.0)) == [("vanished", "process:base/10")]
    assert sampler.find(3.0) == []
    assert sampler.ended(10, 3.0) is None


def test_an_end_comes_with_the_last_lines_of_its_log(machine, sampler, tmp_path):
    machine.start(10)
    (machine.root / "10" / "environ").write_text(f"ROS_LOG_DIR={tmp_path}\0")
    (tmp_path / "talker_10_1.log").write_text("[ERROR] out of range\n")
    sampler.find(1.0)
    machine.stop(10)
    (event,) = sampler.find(2.0)
    assert event.said == ("[ERROR] out of range",)


def test_what_has_ended_does_not_appear_again_while_its_parent_has_not_asked_how(machine, sampler):
    machine.start(10)
    sampler.name([10])
    sampler.find(1.0)
    machine.run(10, state="Z")
    assert reported([sampler.ended(10, 1.5)]) == [("vanished", "process:base/10")]
    assert sampler.find(2.0) == []


def test_a_number_that_is_used_again_is_another_process(machine, sampler):
    machine.start(10, started=500)
    sampler.find(1.0)
    machine.stop(10)
    machine.start(10, started=900)
    assert sampler.sample(1.5) == []
    assert reported(sampler.find(2.0)) == [("vanished", "process:base/10"), ("appeared", "process:base/10")]


def test_hostile_names(machine, sampler):
    machine.start(10, "x\0--ros-args\0" + "y" * 100_000, name=") R 1 (")
    sampler.find(1.0)
    assert len(sampler.processes()[0].command) == 300
    assert sampler.sample(1.0)[0].values["threads"] == 3.0


def test_a_real_process_ends_at_once():
    sampler = ProcessSampler("here")
    program = "import sys; print(flush=True); sys.stdin.read()"
    with subprocess.Popen(
        [sys.executable, "-c", program, "--ros-args"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as child:
        child.stdout.readline()
        sampler.find(0.0)
        handle = {pid: handle for handle, pid in sampler.handles().items()}[child.pid]
        values = {sample.entity.name: sample.values for sample in sampler.sample(1.0)}[f"here/{child.pid}"]
        assert values["memory"] > 1_000_000
        assert values.keys() <= {key for key, signal in BY_KEY.items() if EntityKind.PROCESS in signal.kinds}
        child.kill()
        import select

        assert select.select([handle], [], [], 10.0)[0] == [handle]
        event = sampler.ended(child.pid, 2.0)
    assert event is not None
    assert event.change is Change.VANISHED
    sampler.close()
    with pytest.raises(OSError, match="Bad file descriptor"):
        os.fstat(handle)


@pytest.mark.parametrize(("status", "inner"), [("NSpid:\t10\t7\n", 7), ("NSpid:\t10\n", 0), ("Name:\tx\n", 0)])
def test_a_process_in_a_container_sees_another_id_of_itself(machine, sampler, status, inner):
    machine.start(10)
    (machine.root / "10" / "status").write_text(status)
    sampler.find(0.0)
    assert [process.inner for process in sampler.processes()] == [inner]
