"""The plan: the same every time and everywhere, nothing on top of anything else, no line through an element."""

from __future__ import annotations

import random
import re
import time
from itertools import combinations, pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pace import turned_s

from roslens.dashboard.plan.ground import Box, Ground, Part, Wire
from roslens.dashboard.plan.plan import Plan, drawn_on, ground_of, plan

LANES = ("/", "/a", "/a/b", "/c", "/@base", "/@base/a")
Graph = tuple[list[Part], list[Wire]]


@st.composite
def graphs(draw: st.DrawFn, most: int = 14) -> Graph:
    parts = [
        Part(
            f"{'node' if node else 'topic'}:/{number}",
            draw(st.floats(20, 200)),
            26.0 if node else 18.0,
            draw(st.sampled_from(LANES)),
            node,
        )
        for number, node in enumerate(draw(st.lists(st.booleans(), max_size=most)))
    ]
    nodes, others = ([part.key for part in parts if part.node is node] for node in (True, False))
    ways = [(one, other) for node in nodes for topic in others for one, other in ((node, topic), (topic, node))]
    return parts, draw(st.lists(st.sampled_from(ways), max_size=24, unique=True)) if ways else []


def rectangle(part: Part, place: tuple[float, float]) -> tuple[float, float, float, float]:
    (x, y), across, down = place, part.width / 2, part.height / 2
    return x - across, y - down, x + across, y + down


def assert_apart(parts: list[Part], found: Plan) -> None:
    rectangles = [rectangle(part, place) for part, place in zip(parts, found.places, strict=True)]
    for first, second in combinations(rectangles, 2):
        aside = first[2] <= second[0] + 0.2 or second[2] <= first[0] + 0.2
        assert aside or first[3] <= second[1] + 0.2 or second[3] <= first[1] + 0.2, (first, second)
    assert all(r[0] >= 0 and r[1] >= 0 and r[2] <= found.width and r[3] <= found.height for r in rectangles)


def assert_boxes_hold(parts: list[Part], found: Plan) -> None:
    """Each part stands in a box of each of its namespaces, and in no other."""
    for part, (x, y) in zip(parts, found.places, strict=True):
        own = [name for name in part.lane.split("/") if name]
        wanted = {"/" + "/".join(own[: depth + 1]) for depth in range(len(own))}
        around = [box.name for box in found.boxes if holds(box, x, y)]
        assert sorted(around) == sorted(wanted), part
    for first, second in combinations(found.boxes, 2):
        inside = second.name.startswith(first.name + "/") and holds(first, second.x, second.y)
        if inside:
            assert first.x < second.x
            assert first.y < second.y
            assert first.x + first.width > second.x + second.width
            assert first.y + first.height > second.y + second.height
        else:
            assert first.y + first.height <= second.y or second.y + second.height <= first.y


def holds(box: Box, x: float, y: float) -> bool:
    return box.x <= x <= box.x + box.width and box.y <= y <= box.y + box.height


def points(path: str) -> list[tuple[float, float]]:
    """Return points along a line, but for its tip."""
    line = re.findall(r"[MHVqC][^MHVqC]*", path.rpartition("m")[0])
    found: list[tuple[float, float]] = []
    x = y = 0.0
    for one in line:
        numbers = [float(text) for text in re.findall(r"-?[\d.]+", one)]
        if one[0] == "M":
            x, y = numbers
            found.append((x, y))
        elif one[0] == "H":
            found += [(x + (numbers[0] - x) * step / 20, y) for step in range(1, 21)]
            x = numbers[0]
        elif one[0] == "V":
            found += [(x, y + (numbers[0] - y) * step / 20) for step in range(1, 21)]
            y = numbers[0]
        else:
            if one[0] == "q":
                numbers = [value + (y if place % 2 else x) for place, value in enumerate(numbers)]
            if len(numbers) == 4:
                numbers = numbers[:2] + numbers
            (a, b, c, d, e, f), (x0, y0) = numbers, (x, y)
            for step in range(1, 21):
                t = step / 20
                u = 1 - t
                shares = (u**3, 3 * u * u * t, 3 * u * t * t, t**3)
                found.append(
                    (
                        sum(share * value for share, value in zip(shares, (x0, a, c, e), strict=True)),
                        sum(share * value for share, value in zip(shares, (y0, b, d, f), strict=True)),
                    )
                )
            x, y = e, f
    return found


def assert_lines_pass_beside(parts: list[Part], wires: list[Wire], found: Plan) -> None:
    rectangles = {part.key: rectangle(part, place) for part, place in zip(parts, found.places, strict=True)}
    for (source, target), path in zip(wires, found.paths, strict=True):
        line = points(path)
        _, top, right, bottom = rectangles[source]
        assert line[0] == pytest.approx((right, (top + bottom) / 2), abs=0.2)
        left, top, _, bottom = rectangles[target]
        assert line[-1] == pytest.approx((left, (top + bottom) / 2), abs=0.2)
        for key, (x1, y1, x2, y2) in rectangles.items():
            crossed = [(x, y) for x, y in line[1:-1] if x1 + 0.2 < x < x2 - 0.2 and y1 + 0.2 < y < y2 - 0.2]
            assert not crossed, (source, target, key)


@settings(max_examples=60)
@given(graphs(), st.randoms(use_true_random=False))
def test_it_is_the_same_in_whatever_order_it_is_told(graph: Graph, chance: random.Random) -> None:
    parts, wires = graph
    ground = ground_of(parts, wires)
    chance.shuffle(parts)
    chance.shuffle(wires)
    assert ground_of(parts, wires) == ground


@settings(max_examples=60)
@given(graphs())
def test_nothing_overlaps(graph: Graph) -> None:
    assert_apart(graph[0], drawn_on(Ground(), *graph)[1])


@settings(max_examples=60)
@given(graphs())
def test_a_box_holds_its_host_or_namespace_and_nothing_else(graph: Graph) -> None:
    assert_boxes_hold(graph[0], drawn_on(Ground(), *graph)[1])


@settings(max_examples=100)
@given(graphs())
def test_lines_run_from_right_to_left_sides_and_through_no_element(graph: Graph) -> None:
    assert_lines_pass_beside(*graph, drawn_on(Ground(), *graph)[1])


@settings(max_examples=60)
@given(graphs(), graphs(20))
def test_what_is_new_takes_free_room_and_moves_nothing(before: Graph, after: Graph) -> None:
    parts = [*before[0], *(part for part in after[0] if part.key not in {one.key for one in before[0]})]
    keys = {part.key for part in parts}
    wires = sorted({*before[1], *(wire for wire in after[1] if keys.issuperset(wire))})
    ground, first = drawn_on(Ground(), *before)
    grown, found = drawn_on(ground, parts, wires)
    if before[0]:
        assert found.places[: len(before[0])] == first.places
        assert {key: grown.stands[key] for key in ground.stands} == ground.stands
    assert_apart(parts, found)
    assert_boxes_hold(parts, found)
    assert_lines_pass_beside(parts, wires, found)


@settings(max_examples=60)
@given(graphs(), st.randoms(use_true_random=False))
def test_of_a_part_of_it_everything_stands_where_it_stood(graph: Graph, chance: random.Random) -> None:
    parts, wires = graph
    ground, whole = drawn_on(Ground(), parts, wires)
    kept = [part for part in parts if chance.random() < 0.5]
    keys = {part.key for part in kept}
    left = [wire for wire in wires if keys.issuperset(wire)]
    found = drawn_on(ground, kept, left)[1]
    places = dict(zip((part.key for part in parts), whole.places, strict=True))
    assert list(found.places) == [places[part.key] for part in kept]
    paths = dict(zip(wires, whole.paths, strict=True))
    if kept:
        assert list(found.paths) == [paths[wire] for wire in left]
        assert (found.width, found.height) == (whole.width, whole.height)


def test_things_flow_to_the_right() -> None:
    keys = ["node:/a", "topic:/x", "node:/b", "topic:/y", "node:/c"]
    parts = [Part(key, 80, 26, node=key.startswith("node")) for key in keys]
    found = drawn_on(Ground(), parts, list(pairwise(keys)))[1]
    assert [x for x, _ in found.places] == sorted({x for x, _ in found.places})
    assert len({y for _, y in found.places}) == 1


def test_nodes_that_are_joined_right_away_flow_to_the_right_too() -> None:
    parts = [Part(f"node:/{name}", 60, 26) for name in "abc"]
    found = drawn_on(Ground(), parts, [("node:/a", "node:/b"), ("node:/b", "node:/c")])[1]
    assert [x for x, _ in found.places] == sorted({x for x, _ in found.places})


def test_a_line_that_runs_back_turns_round_beside_both_ends() -> None:
    keys = ["node:/a", "topic:/x", "node:/b", "topic:/y"]
    parts = [Part(key, 60, 26, node=key.startswith("node")) for key in keys]
    wires = [*pairwise(keys), ("topic:/y", "node:/a")]
    found = drawn_on(Ground(), parts, wires)[1]
    line = points(found.paths[3])
    assert line[0] == pytest.approx((found.places[3][0] + 30, found.places[3][1]))
    assert max(x for x, _ in line) > found.places[3][0] + 30
    assert min(x for x, _ in line) < found.places[0][0] - 30
    assert line[-1] == pytest.approx((found.places[0][0] - 30, found.places[0][1]))


def test_a_word_about_a_line_stands_on_it() -> None:
    keys = ["node:/a", "topic:/x", "node:/b"]
    parts = [Part(key, 60, 26, node=key.startswith("node")) for key in keys]
    wires = [("node:/a", "topic:/x"), ("topic:/x", "node:/b"), ("node:/b", "topic:/x")]
    found = drawn_on(Ground(), parts, wires)[1]
    for path, (x, y) in zip(found.paths, found.words, strict=True):
        assert min(abs(x - a) + abs(y - b) for a, b in points(path)) < 10


def test_wires_that_rise_and_fall_beside_each_other_have_tracks_of_their_own() -> None:
    parts = [Part(f"node:/{host}{number}", 60, 26, f"/@{host}") for host in "ab" for number in range(8)]
    wires = [(f"node:/a{number}", f"node:/b{7 - number}") for number in range(8)]
    wires += [(f"node:/a{number}", f"node:/a{number + 1}") for number in (0, 4)]
    found = drawn_on(Ground(), parts, wires)[1]
    tracks = [x for path in found.paths for x in upright(path)]
    assert len(tracks) >= 6
    assert min(b - a for a, b in pairwise(sorted(set(tracks)))) >= 2
    assert len(set(tracks)) == len(tracks)


def test_what_falls_and_what_rises_past_each_other_are_told_apart() -> None:
    keys = [f"node:/{name}" for name in "abcd"] + [f"topic:/{number}" for number in range(6)]
    parts = [Part(key, 60, 26, node=key.startswith("node")) for key in keys]
    wires = [(f"node:/{name}", f"topic:/{number}") for name, number in zip("abcd", (0, 1, 4, 5), strict=True)]
    ground = ground_of(parts, wires)
    nodes, topics = (
        [key for _, key in sorted((one.y, key) for key, one in ground.stands.items() if key.startswith(kind))]
        for kind in ("node", "topic")
    )
    across = [(nodes[0], topics[-1]), (nodes[1], topics[-2]), (nodes[-2], topics[1]), (nodes[-1], topics[0])]
    tracks = [x for path in plan(ground, parts, across).paths for x in upright(path)]
    assert len(tracks) == 4
    assert min(b - a for a, b in pairwise(sorted(tracks))) >= 2


def test_wires_of_one_element_share_a_track() -> None:
    parts = [Part(f"node:/{host}{number}", 60, 26, f"/@{host}") for host in "ab" for number in range(4)]
    wires = [("node:/a0", f"node:/b{number}") for number in range(4)]
    found = drawn_on(Ground(), parts, wires)[1]
    tracks = [x for path in found.paths for x in upright(path)]
    assert len(tracks) > 1
    assert len(set(tracks)) == 1


def upright(path: str) -> list[float]:
    """Return where a line runs straight up or down."""
    return [
        round(float(x) + float(turn), 1) for x, turn in re.findall(r"H(-?[\d.]+)q(-?[\d.]+) 0 [-\d.]+ [-\d.]+V", path)
    ]


def made_up(count: int, seed: int = 3) -> Graph:
    """Return two nodes for three topics; most of what a topic joins is near, a tenth anywhere."""
    chance = random.Random(seed)
    nodes = count * 2 // 5
    parts = [Part(f"{'node' if n < nodes else 'topic'}:/{n}", 100, 26, node=n < nodes) for n in range(count)]
    wires = set()
    for topic in range(nodes, count):
        home = chance.randrange(nodes)
        wires.add((parts[home].key, parts[topic].key))
        for _ in range(chance.choice((1, 1, 2, 3))):
            near = max(0, min(nodes - 1, home + chance.randrange(-20, 60)))
            other = chance.randrange(nodes) if chance.random() < 0.1 else near
            wires.add((parts[topic].key, parts[other].key))
    return parts, sorted(wires)


def test_four_thousand_are_apart_and_their_lines_pass_beside_what_stands() -> None:
    parts, wires = made_up(4000)
    found = plan(ground_of(parts, wires), parts, wires)
    columns: dict[float, list[float]] = {}
    for x, y in found.places:
        columns.setdefault(x, []).append(y)
    assert all(
        b - a >= 26 for column in columns.values() for a, b in zip(sorted(column), sorted(column)[1:], strict=False)
    )
    chosen = random.Random(1).sample(range(len(wires)), 40)
    rectangles = [(part.key, rectangle(part, place)) for part, place in zip(parts, found.places, strict=True)]
    for number in chosen:
        line = points(found.paths[number])[1:-1]
        for key, (x1, y1, x2, y2) in rectangles:
            assert not any(x1 < x < x2 and y1 + 0.2 < y < y2 - 0.2 for x, y in line), (wires[number], key)


@pytest.mark.heavy
@pytest.mark.timed
def test_four_thousand_are_laid_out_in_three_tenths_of_a_second() -> None:
    parts, wires = made_up(4000)
    took = []
    for _ in range(3):
        begun = time.process_time()
        plan(ground_of(parts, wires), parts, wires)
        took.append(turned_s(begun))
    assert min(took) < 0.3, took
