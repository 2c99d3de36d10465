"""The names that braces list, and presences of each of them."""

from __future__ import annotations

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.alternatives import MOST, alternatives, each
from roslens.judge.reference.expectation import Details, Presence, PresenceMode, Selector
from roslens.model.entity import EntityKind


@pytest.mark.parametrize(
    ("pattern", "names"),
    [
        ("/lidar", ["/lidar"]),
        ("/{lidar,planner}", ["/lidar", "/planner"]),
        ("{/a,/b/{c,d}}/x", ["/a/x", "/b/c/x", "/b/d/x"]),
        ("/{front_,}lidar", ["/front_lidar", "/lidar"]),
        ("/cam_{1,2}/*", ["/cam_1/*", "/cam_2/*"]),
        (r"/\{a,b\}", [r"/\{a,b\}"]),
        ("/a,b", ["/a,b"]),
        ("/robot/{,**/}scan", ["/robot/{,**/}scan"]),
        ("re:/x{1,2}", ["re:/x{1,2}"]),
        ("/{a,a}", ["/a"]),
        ("**{{*}}", ["**"]),
        ("/*{*,b}", ["/*", "/*b"]),
        (r"/\*{*,**}", [r"/\**", r"/\***"]),
    ],
)
def test_what_braces_list(pattern, names):
    assert alternatives(pattern) == tuple(names)


@given(st.text("ab/{},*", max_size=12), st.text("ab/,", max_size=6))
def test_together_they_match_what_the_pattern_matches(pattern, name):
    try:
        whole = Pattern.parse(pattern)
    except ValueError:
        return
    assert whole.matches(name) == any(one and Pattern.parse(one).matches(name) for one in alternatives(pattern)) or (
        not name
    )


def test_there_are_not_too_many():
    with pytest.raises(ValueError, match=f"names more than {MOST} things, expected at most {MOST}"):
        alternatives("/" + "{a,b,c,d}" * 6)


def names_of(mode, name, *without):
    selector = Selector(EntityKind.NODE, name, without=without)
    return [one.selector.name for one in each(Presence(Details("r.x.presence"), selector, mode))]


def test_each_of_them_is_a_presence_of_its_own_where_all_have_to_be_there():
    assert names_of(PresenceMode.ALWAYS, "/{a,b}") == ["/a", "/b"]
    assert names_of(PresenceMode.WHILE, "/{a,b}") == ["/a", "/b"]
    for mode in (PresenceMode.ANY, PresenceMode.ANY_WHILE, PresenceMode.NEVER, PresenceMode.AT_MOST_ONE):
        assert names_of(mode, "/{a,b}") == ["/{a,b}"]


def test_what_is_left_out_need_not_be_there():
    assert names_of(PresenceMode.ALWAYS, "/{a,b,c}", "/b") == ["/a", "/c"]


def test_a_presence_keeps_all_else():
    presence = Presence(Details("r.x.presence"), Selector(EntityKind.NODE, "/{a,b}", host="pc"), PresenceMode.ALWAYS)
    first = each(presence)[0]
    assert msgspec.structs.replace(first, selector=presence.selector) == presence
    assert first.selector.host == "pc"
