import os
import socket

from roslens.live.adapters.ros1.place import is_local, own_address, owns_port


def test_what_the_environment_says_is_our_address():
    assert own_address({"ROS_IP": "10.0.0.3"}, "127.0.0.1", 1) == "10.0.0.3"
    assert own_address({"ROS_IP": "10.0.0.3", "ROS_HOSTNAME": "robot"}, "127.0.0.1", 1) == "robot"


def test_else_it_is_that_of_the_interface_towards_the_master():
    assert own_address({}, "127.0.0.1", 11311) == "127.0.0.1"
    assert own_address({}, "no address", 11311) == "127.0.0.1"


def test_local_addresses():
    assert is_local("127.0.0.1")
    assert not is_local("192.0.2.1")
    assert not is_local("nonsense")


def test_who_listens_at_a_port():
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        assert owns_port(os.getpid(), port) is True
    assert owns_port(os.getpid(), 1) is False
    assert owns_port(2**22 + 5, 80) is False


def test_what_may_not_be_seen_is_not_known(tmp_path):
    (tmp_path / "7").mkdir()
    (tmp_path / "7" / "fd").write_text("not a folder")
    assert owns_port(7, 80, proc=tmp_path) is None
