"""Which revisions are looked at: releases, periods, each so-manieth of the main line; always the head."""

import pytest
from process_metrics.small_repository import BEGIN_S, DAY_S

from roslens.model.process import Release
from roslens.source.history.chosen_revisions import Every, chosen_revisions, main_line
from roslens.source.history.commit_log import Commit, CommitLog


def commit(name: str, day: float, *parents: str) -> Commit:
    return Commit(name, parents, int(BEGIN_S + day * DAY_S), ())


LOG = CommitLog(
    (
        commit("h", 70, "m"),
        commit("m", 40, "c", "side"),
        commit("side", 39, "b"),
        commit("c", 35, "b"),
        commit("b", 1, "a"),
        commit("a", 0),
    )
)


def chosen(text: str, released=(), since_day=None) -> str:
    since = None if since_day is None else BEGIN_S + since_day * DAY_S
    return " ".join(one.id for one in chosen_revisions(LOG, released, Every.parse(text), since_s=since))


def test_the_main_line_is_that_of_first_parents():
    assert [one.id for one in main_line(LOG)] == ["h", "m", "c", "b", "a"]
    assert main_line(CommitLog()) == []


def test_numbers_count_from_the_head():
    assert chosen("1") == "a b c m h"
    assert chosen("2") == "a c h"
    assert chosen("99") == "h"


def test_periods_have_their_last_commit():
    # 2020-09-13 and 14, 10-18 and 23, 11-22
    assert chosen("month") == "b m h"
    assert chosen("day") == "a b c m h"
    assert chosen("week") == "a b c m h"  # 13 September was a Sunday


def test_releases_wherever_they_are():
    released = [Release("1.0", "a", BEGIN_S), Release("1.1", "side", BEGIN_S)]
    assert chosen("release", released) == "a side h"
    assert chosen("release") == "h"


def test_since():
    assert chosen("1", since_day=35) == "c m h"
    assert chosen("1", since_day=71) == ""


@pytest.mark.parametrize("text", ["", "0", "-1", "years", "1.5", "releases"])
def test_what_is_no_choice(text):
    with pytest.raises(ValueError, match="neither one of release"):
        Every.parse(text)
