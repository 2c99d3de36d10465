import sys

import pytest

from roslens.live.observe import child_source
from roslens.live.observe.child_source import Publishes, ros1_source, ros2_source


@pytest.fixture
def children(monkeypatch):
    """What would be started, with the downlink of each."""
    made = []

    def child(name, command, environment, downlink=None):
        made.append((name, command, downlink))

    monkeypatch.setattr(child_source, "Child", child)
    monkeypatch.setattr(child_source, "find_ros2_python", lambda python, environment: python)
    return made


def test_who_publishes_nothing_is_told_nothing(children):
    assert ros1_source("", (), {}, steady=float).downlink is None
    assert ros2_source("python", 7, (), {}, steady=float).downlink is None
    assert [downlink for *_, downlink in children] == [None, None]
    assert not {"--diagnostics", "--rated"}.intersection(word for _, command, _ in children for word in command)


def test_who_publishes_is_told_what_and_has_a_line(children):
    one = ros1_source("http://m:1", ("/a",), {}, steady=float, publishes=Publishes(True, "/rated"))
    other = ros2_source("python", None, (), {}, steady=float, publishes=Publishes(True))
    (_, first, line), (_, second, other_line) = children
    assert first[0] == sys.executable
    assert first[-3:] == ["--diagnostics", "--rated", "/rated"]
    assert second[-1] == "--diagnostics"
    assert (one.downlink, other.downlink) == (line, other_line)
    assert line is not None is not other_line
