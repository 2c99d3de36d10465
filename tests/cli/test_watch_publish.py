import argparse
import contextlib
from concurrent.futures import ThreadPoolExecutor
from urllib.request import urlopen

import pytest

from roslens.cli.main import main
from roslens.cli.watch.watch_live import _serve
from roslens.cli.watch.watch_publish import publish_through, unpublished, wanted
from roslens.judge.reference.expectation import Details, Presence, PresenceMode, Reference, Selector
from roslens.live.join.session import Session
from roslens.live.observe.child_source import ChildSource, Publishes
from roslens.live.publish.turns import PERIOD_S
from roslens.model.acting.outgoing import MAX_BYTES, OutgoingReader
from roslens.model.entity import EntityKind
from roslens.model.errors import UsageError

pytestmark = pytest.mark.timed

REFERENCE = Reference(
    "r", presences=(Presence(Details("r.scan"), Selector(EntityKind.TOPIC, "/scan"), PresenceMode.ALWAYS),)
)


class Line:
    """Keeps what is said."""

    def __init__(self, lost=0):
        self.said = b""
        self.lost = lost

    def say(self, frame):
        self.said += frame

    @property
    def frames(self):
        return list(OutgoingReader().feed(self.said))


def source(line):
    return ChildSource("ros2", None, steady=float, downlink=line)


def options(**given):
    return argparse.Namespace(**{"diagnostics": None, "publish_statistics": None, **given})


def test_what_is_wanted():
    assert wanted(options()) is None
    assert wanted(options(diagnostics=True)) == Publishes(True)
    assert wanted(options(publish_statistics="/roslens/rated")).rated == "/roslens/rated"


@pytest.mark.parametrize("topic", ["", "rated", "/", "/a//b", "/1a", "/a/", "/a b", "/" + "x" * 300])
def test_a_topic_that_is_none_is_refused(topic):
    with pytest.raises(UsageError, match="--publish-statistics"):
        wanted(options(publish_statistics=topic))


def test_where_no_ros_is_observed_nothing_can_be_published():
    with pytest.raises(UsageError, match="--diagnostics where no ROS is observed"):
        publish_through([object()], Session(REFERENCE, start=0.0), lambda: REFERENCE, Publishes(True))


def test_every_observer_publishes_what_becomes_wrong_at_once():
    session = Session(REFERENCE, start=0.0)
    lines = [Line(), Line()]
    reported = publish_through(
        [source(line) for line in lines], session, lambda: REFERENCE, Publishes(True, "/roslens/rated")
    )
    now = 0.0
    while not (step := session.look(now)).changes:
        reported(step)
        now += 0.25
        assert now < 60
    before = len(lines[0].frames)
    reported(step)
    assert lines[0].said == lines[1].said
    diagnostics, rated = lines[0].frames[before:]
    assert [(one.level, one.name) for one in diagnostics.statuses] == [(1, "roslens: topic /scan")]
    assert [(one.name, one.constraint, one.state) for one in rated.rated.signals] == [("/scan", "r.scan", 5)]
    assert before >= now / PERIOD_S


def test_messages_that_were_lost_are_told_once():
    session = Session(REFERENCE, start=0.0)
    reported = publish_through([source(Line(lost=3))], session, lambda: REFERENCE, Publishes(True))
    reported(session.look(0.0))
    reported(session.look(2.0))
    (failure,) = session.look(4.0).failures or session.monitor.failures
    assert "could not be published" in failure.what


def test_what_is_too_long_for_a_message_is_a_failure_and_no_crash():
    text = "x" * (MAX_BYTES + 1)
    details = Details("r.scan", text=text)
    reference = Reference("r", presences=(Presence(details, Selector(EntityKind.TOPIC, "/scan"), PresenceMode.ALWAYS),))
    session, line = Session(reference, start=0.0), Line()
    publish = publish_through([source(line)], session, lambda: reference, Publishes(False, "/rated"))
    publish(session.look(0.0))
    assert line.said == b""
    assert "expected at most" in session.monitor.failures[0].what


@pytest.mark.parametrize("words", [["--diagnostics"], ["--publish-statistics", "/rated"]])
def test_a_recording_publishes_nothing(words, capsys):
    assert main(["watch", "--bag", "none.bag", *words]) == 2
    assert f"{words[0]} with --bag" in capsys.readouterr().err


def test_what_was_not_published_is_counted_for_prometheus(capsys):
    session = Session(REFERENCE, start=0.0)
    sources = [source(Line(lost=2)), source(Line(lost=3)), source(None), object()]
    assert unpublished(sources) == 5
    with contextlib.ExitStack() as stack, ThreadPoolExecutor(1) as reader:
        answer = _serve(stack, 0, session, sources)
        url = capsys.readouterr().err.split()[-1]
        page = reader.submit(lambda: urlopen(url, timeout=20).read())
        while not page.done():
            answer(session.look(1.0))
        assert b"roslens_unpublished_total 5.0\n" in page.result()
