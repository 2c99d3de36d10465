"""How long is watched counts from when the observers see."""

from roslens.cli.watch.stretch import Stretch, blind, never_saw


class Session:
    begun = False


class Source:
    def __init__(self, tool, *, seeing):
        self.tool, self.seeing = tool, seeing


def test_time_counts_from_when_observers_see():
    session, now = Session(), [0.0]
    stretch = Stretch(session, 5.0, [], steady=lambda: now[0])
    now[0] = 100.0
    assert not stretch.over()
    session.begun = True
    assert not stretch.over()
    now[0] = 104.9
    assert (stretch.over(), stretch.passed) == (False, 104.9)
    now[0] = 105.0
    assert stretch.over()


def test_who_asks_to_end_is_heard_at_once():
    ended = []
    stretch = Stretch(Session(), None, ended)
    assert not stretch.over()
    ended.append(2)
    assert stretch.over()


def test_who_never_saw_is_named():
    sources = [object(), Source("ros1", seeing=True), Source("ros2", seeing=False)]
    assert blind(sources) == ["ros2"]
    (failure,) = never_saw(sources, 4.2)
    assert str(failure).startswith("the observer of ros2 has said nothing in 4 s")
    assert not failure.partial
