import os
import subprocess
import sys

from roslens.live.agent.ros_environments import ros_environments
from roslens.model.answers.ros_process import RosProcess


def process(proc, pid, *, maps, environ=b"", command=b"a\0b\0"):
    folder = proc / str(pid)
    folder.mkdir(parents=True)
    (folder / "maps").write_bytes(maps)
    (folder / "environ").write_bytes(environ)
    (folder / "cmdline").write_bytes(command)
    return folder


def test_a_process_with_ros_is_found_with_what_decides_whom_it_meets(tmp_path):
    ros = b"7f00-7f01 r-xp 0 08:01 5 /opt/ros/jazzy/lib/librcl.so\n"
    environ = b"HOME=/\0ROS_DOMAIN_ID=5\0RMW_IMPLEMENTATION=rmw_zenoh_cpp\0ROS_AUTOMATIC_DISCOVERY_RANGE=OFF\0"
    folder = process(tmp_path, 12, maps=ros, environ=environ)
    process(tmp_path, 13, maps=b"7f00-7f01 r-xp 0 08:01 5 /usr/lib/libc.so.6\n")
    process(tmp_path, 14, maps=ros)
    process(tmp_path, 16, maps=ros, command=b"python3\0-c\0from roslens.live.adapters.ros2.__main__ import main\0")
    (tmp_path / "self").mkdir()
    (tmp_path / "15").mkdir()  # it ended
    found = ros_environments(tmp_path, frozenset({14}))
    user = folder.stat().st_uid
    assert found.processes == (RosProcess(12, "a b", user, "5", "rmw_zenoh_cpp", "OFF"),)
    assert found.unreadable == 0


def test_processes_of_this_system_without_ros_are_none_of_it():
    child = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    try:
        assert child.pid not in {one.pid for one in ros_environments().processes}
        assert os.getpid() not in {one.pid for one in ros_environments().processes}
    finally:
        child.communicate(b"\n")


def test_routers_of_zenoh_and_memory_that_others_may_not_write_are_told(tmp_path):
    process(tmp_path / "proc", 5, maps=b"", command=b"/opt/ros/lib/rmw_zenoh_cpp/rmw_zenohd\0")
    process(tmp_path / "proc", 6, maps=b"", command=b"grep\0rmw_zenohd\0")
    shared = tmp_path / "shm"
    shared.mkdir()
    segment = shared / "fastdds_port7411"
    segment.touch(0o644)
    found = ros_environments(tmp_path / "proc", shared=shared)
    assert (found.routers, found.closed_memory) == (1, frozenset({segment.stat().st_uid}))
    segment.chmod(0o666)
    assert ros_environments(tmp_path / "proc", shared=shared).closed_memory == frozenset()
