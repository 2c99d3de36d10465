import io

from roslens.live.adapters.ros1.speak import Speaker
from roslens.model.graph import Graph, Node
from roslens.model.wire import VERSION, Frame, FrameReader


def test_frames_are_numbered_and_one_too_long_is_a_failure():
    into = io.BytesIO()
    speaker = Speaker(into)
    huge = Graph("ros1", tuple(Node("/" + "x" * 1000 + str(number)) for number in range(17_000)))
    speaker.say(Frame(VERSION, "vm/ros1", 0, 1.0))
    speaker.say(Frame(VERSION, "vm/ros1", 0, 2.0, graph=huge))
    speaker.say(Frame(VERSION, "vm/ros1", 0, 3.0))
    frames = list(FrameReader().feed(into.getvalue()))
    assert [frame.sequence for frame in frames] == [0, 1, 2]
    assert frames[1].graph is None
    assert frames[1].shed == 1
    assert "was not sent" in frames[1].failures[0].what
