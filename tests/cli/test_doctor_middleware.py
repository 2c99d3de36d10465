import pytest

from roslens.cli.commands.doctor import _middleware


@pytest.mark.parametrize(
    ("set_", "state", "words"),
    [
        ("rmw_fastrtps_cpp", "ok", "rmw_fastrtps_cpp; the live half is verified with Fast DDS"),
        ("rmw_zenoh_cpp", "note", "rmw_zenoh_cpp; the live half is verified with Fast DDS (rmw_fastrtps) alone"),
        ("", "ok", "the default of the distribution"),
    ],
)
def test_the_middleware_is_named_with_what_is_verified(monkeypatch, set_, state, words):
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    monkeypatch.setenv("RMW_IMPLEMENTATION", set_)
    ((found, text),) = _middleware()
    assert found == state
    assert words in text


def test_without_ros_2_nothing_is_said_of_it(monkeypatch):
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.delenv("RMW_IMPLEMENTATION", raising=False)
    assert not list(_middleware())
