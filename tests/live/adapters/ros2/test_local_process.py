from roslens.live.adapters.ros2.local_process import find_process

NONE = frozenset()


def process(proc, pid, inner=None, maps="/opt/ros/lib/librmw_fastrtps_cpp.so", command="python3\0talker.py\0"):
    folder = proc / str(pid)
    folder.mkdir()
    numbers = f"{pid}\t{inner}" if inner else str(pid)
    (folder / "status").write_text(f"Name:\tpython3\nNSpid:\t{numbers}\n")
    (folder / "maps").write_text(maps)
    (folder / "cmdline").write_text(command)
    (folder / "stat").write_text(f"{pid} (a) b) S " + " ".join(str(n) for n in range(4, 22)) + " 500 0\n")


def test_found_by_its_bits_with_proofs_command_and_start(tmp_path):
    (tmp_path / "stat").write_text("cpu 1\nbtime 1000\n")
    process(tmp_path, 70_000)
    found = find_process(70_000 & 0xFFFF, NONE, tmp_path)
    assert (found.pid, found.command) == (70_000, "python3 talker.py")
    assert found.proofs == ("gid", "memory map")
    assert found.started == 1005


def test_the_number_inside_a_container_counts(tmp_path):
    process(tmp_path, 1, maps="systemd")
    process(tmp_path, 4711, inner=1)
    assert find_process(1, NONE, tmp_path).pid == 4711


def test_several_are_told_apart_by_the_command_line_or_not_at_all(tmp_path):
    process(tmp_path, 5, command="node\0--ros-args\0-r\0__node:=left\0")
    process(tmp_path, 65_541, command="node\0--ros-args\0-r\0__node:=right\0")
    assert find_process(5, NONE, tmp_path) is None
    found = find_process(5, frozenset({"right"}), tmp_path)
    assert found.pid == 65_541
    assert found.proofs[-1] == "command line"


def test_a_process_without_middleware_or_that_ends_meanwhile_is_none(tmp_path):
    process(tmp_path, 5, maps="libc.so")
    (tmp_path / "6").mkdir()
    assert find_process(5, NONE, tmp_path) is None
    assert find_process(6, NONE, tmp_path) is None
