"""Which topics are seen by rows, lines and what was chosen."""

import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.cli.page.topics_seen import topics_seen
from roslens.dashboard.live.sight import NOTHING, Seen


def test_rows_lines_and_what_was_chosen_are_of_topics():
    shown = ScriptedRobot().page.state()
    keys = {row.entity: row.key for row in shown.rows}
    assert topics_seen(NOTHING, shown) == set()
    rows = Seen(frozenset([keys["topic:/scan"], keys["connection:/slam > /map > /ui"], keys["node:/ui"], "gone"]))
    assert topics_seen(rows, shown) == {"/scan", "/map"}
    names = [one.entity for one in shown.picture.items]
    place = next(at for at, one in enumerate(shown.picture.links) if names[one.end] == "topic:/odom")
    version = shown.picture.version
    assert topics_seen(Seen(links=frozenset([(version, place)])), shown) == {"/odom"}
    assert topics_seen(Seen(links=frozenset([(version + 1, place), (version, 9999)])), shown) == set()
    assert topics_seen(Seen(entities=frozenset(["topic:/image"])), None) == {"/image"}


@pytest.mark.parametrize("entity", ["connection:x", "connection:", "what", "", "host:rover"])
def test_what_is_no_topic_is_left_out(entity):
    assert topics_seen(Seen(entities=frozenset([entity])), None) == set()
