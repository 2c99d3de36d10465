"""Places in the picture: from left to right, nothing on top of another, and what stands somewhere stays there."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.live.places import COLUMN, ROW, Places

NODES = [f"node:/n{number}" for number in range(8)]
TOPICS = [f"topic:/t{number}" for number in range(10)]


@st.composite
def graphs(draw):
    nodes = draw(st.lists(st.sampled_from(NODES), unique=True))
    topics = draw(st.lists(st.sampled_from(TOPICS), unique=True))
    ways = [(n, t) for n in nodes for t in topics] + [(t, n) for n in nodes for t in topics]
    links = draw(st.lists(st.sampled_from(ways), unique=True)) if ways else []
    return {**dict.fromkeys(nodes, 0), **dict.fromkeys(topics, 1)}, links


def apart(places):
    found = list(places.values())
    return all(
        abs(x1 - x2) >= COLUMN - 1 or abs(y1 - y2) >= ROW - 1
        for place, (x1, y1) in enumerate(found)
        for x2, y2 in found[:place]
    )


def test_data_flows_to_the_right():
    items = {"node:/a": 0, "topic:/x": 1, "node:/b": 0, "topic:/y": 1, "node:/c": 0}
    links = [("node:/a", "topic:/x"), ("topic:/x", "node:/b"), ("node:/b", "topic:/y"), ("topic:/y", "node:/c")]
    places = Places().of(items, links)
    columns = [places[name][0] for name in ("node:/a", "topic:/x", "node:/b", "topic:/y", "node:/c")]
    assert columns == sorted(set(columns))
    assert len({y for _, y in places.values()}) == 1


def test_what_only_feeds_something_far_right_stands_beside_it():
    chain = ["node:/a", "topic:/x", "node:/b", "topic:/y", "node:/c"]
    items = {name: int(name.startswith("topic")) for name in (*chain, "node:/late", "topic:/z")}
    links = [*pairwise(chain), ("node:/late", "topic:/z"), ("topic:/z", "node:/c")]
    places = Places().of(items, links)
    assert places["topic:/z"][0] <= places["node:/c"][0]
    assert places["node:/late"][0] < places["topic:/z"][0]


def test_a_line_that_passes_columns_goes_around_what_stands_there():
    chain = ["node:/a", "topic:/x", "node:/b", "topic:/y", "node:/c"]
    links = [*pairwise(chain), ("topic:/x", "node:/c")]
    known = Places()
    places = known.of({name: int(name.startswith("topic")) for name in chain}, links)
    way = known.ways["topic:/x", "node:/c"]
    assert [x for x, _ in way] == [places["node:/b"][0], places["topic:/y"][0]]
    assert all(abs(y - places[name][1]) > ROW / 2 for (_, y), name in zip(way, ("node:/b", "topic:/y"), strict=True))


@given(graphs())
def test_nothing_stands_on_another_and_all_is_in_the_picture(graph):
    items, links = graph
    known = Places()
    places = known.of(items, links)
    assert places.keys() == items.keys()
    assert apart(places)
    assert all(0 < x < known.width and 0 < y < known.height for x, y in places.values())
    assert places == Places().of(dict(reversed(items.items())), reversed(links))


@given(graphs(), graphs())
def test_nothing_stands_on_another_after_a_change(before, after):
    known = Places()
    known.of(*before)
    places = known.of(*after)
    assert places.keys() == after[0].keys()
    assert apart(places)


def test_what_is_there_stays_where_it_is_when_something_comes_or_goes():
    items = {**{f"node:/n{number}": 0 for number in range(6)}, **{f"topic:/t{number}": 1 for number in range(6)}}
    links = [(f"node:/n{number}", f"topic:/t{number}") for number in range(6)]
    known = Places()
    before = dict(known.of(items, links))
    version = known.version
    assert known.of(items, links) == before
    assert known.version == version
    after = known.of({**items, "node:/new": 0}, [*links, ("topic:/t2", "node:/new")])
    assert {name: after[name] for name in before} == before
    assert after["node:/new"][0] > before["topic:/t2"][0]
    assert known.version > version
    fewer = known.of({name: column for name, column in items.items() if name != "node:/n3"}, links)
    assert {name: before[name] for name in fewer} == fewer


def test_a_cycle_is_no_obstacle():
    items = {"node:/a": 0, "topic:/x": 1, "node:/b": 0, "topic:/y": 1}
    links = [("node:/a", "topic:/x"), ("topic:/x", "node:/b"), ("node:/b", "topic:/y"), ("topic:/y", "node:/a")]
    places = Places().of(items, links)
    assert len({x for x, _ in places.values()}) == 4
