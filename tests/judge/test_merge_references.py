"""Merging: orthogonal documents add up in any order, others say so or are refused."""

from __future__ import annotations

import itertools
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pace import turned_s

from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_reference import GivenText, load_reference, read_references
from roslens.judge.reference.contradiction import meeting_name
from roslens.judge.reference.expectation import Reference, Selector
from roslens.judge.reference.merge_references import constraints_of, merge_references
from roslens.judge.reference.pattern_index import CompiledSelector
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError


def sources(*lists: str) -> list[GivenText]:
    return [
        GivenText(f"{name}.yaml", f"kind: reference\nname: {name}\n{text}".encode())
        for name, text in zip("abcdefgh", lists, strict=False)
    ]


def merged(*lists: str) -> Reference:
    return load_reference(sources(*(f"constraints: [{text}]" for text in lists)), BY_KEY)


def fault(*lists: str) -> str:
    with pytest.raises(DocumentError) as caught:
        merged(*lists)
    return str(caught.value)


def test_sentences_on_other_quantities_and_entities_all_hold():
    reference = merged("{topic: /a, rate: 1..2}", "{topic: /a, latency: <= 1 s}", "{topic: /b, rate: 5..6}")
    assert [one.details.id for one in reference.expectations] == [
        "a.topic.a.rate",
        "b.topic.a.latency",
        "c.topic.b.rate",
    ]


def test_overlapping_ranges_on_one_entity_both_hold():
    assert len(merged("{topic: /a, rate: 1..5}", "{topic: /*, rate: 4..9}").expectations) == 2


def test_an_override_replaces_the_sentence_and_keeps_its_id():
    for named in ("x", "a.x"):
        reference = merged(
            "{topic: /a, id: x, rate: 1..2, latency: <= 1 s}", f"{{topic: /b, id: {named}, override: true, rate: 7..8}}"
        )
        assert [(one.details.id, one.selector.name, one.range) for one in reference.expectations] == [
            ("a.x.latency", "/a", Range(maximum=1)),
            ("a.x.rate", "/b", Range(7, 8)),
        ]
        assert reference.expectations[1].details.where == "b.yaml:3"


def test_an_override_with_any_takes_a_sentence_away():
    assert merged("{topic: /a, id: x, rate: 1..2}", "{topic: /a, id: x, override: true, rate: any}").expectations == ()


def test_the_last_override_wins():
    override = "{topic: /a, id: x, override: true, rate: %s}"
    assert merged("{topic: /a, id: x, rate: 1..2}", override % "3..4", override % "5..6").expectations[
        0
    ].range == Range(5, 6)


def test_an_id_in_two_documents_must_be_told_apart_to_override():
    text = fault(
        "{topic: /a, id: x, rate: 1..2}",
        "{topic: /b, id: x, rate: 1..2}",
        "{topic: /a, id: x, override: true, rate: any}",
    )
    assert "c.yaml:3:50: id 'x' of several constraints to override; expected id `a.x` or `b.x`" in text


def test_an_override_of_nothing_names_the_nearest():
    text = fault("{topic: /a, id: scan, rate: 1..2}", "{topic: /a, id: scam, override: true, rate: any}")
    assert "nothing to override: no constraint 'scam.rate' in an earlier document" in text
    assert "Did you mean 'scan'?" in text


@pytest.mark.parametrize(
    ("one", "other", "example"),
    [
        ("{topic: /a, rate: 1..2}", "{topic: /a, rate: 3..4}", "/a"),
        ("{topic: /x/*, rate: <= 2}", "{topic: '**/y', rate: '>= 3'}", "/x/y"),
        ("{topic: '**', rate: <= 2}", "{topic: 're:/cam[0-9]+', rate: 3..4}", "/cam0"),
        ("{topic: '/**', without: /a, rate: <= 2}", "{topic: '/{a,b}', rate: 3..4}", "/b"),
        ("{topic: /a, latency: p50 >= 5 s}", "{topic: /a, latency: p95 <= 4 s}", "/a"),
        ("{topic: /a, type: 'x/*', rate: 1..2}", "{topic: /a, publisher: /p, rate: 3..4}", "/a"),
        ("{node: /a, expected: always}", "{node: '/**', expected: never}", "/a"),
        ("{node: '/a*', expected: always}", "{node: '/{a,b}*', expected: never}", "/a"),
    ],
)
def test_contradictions_name_both_places_and_an_entity(one: str, other: str, example: str):
    for first, second in ((one, other), (other, one)):
        text = fault(first, second)
        assert text.startswith("b.yaml:3:")
        assert "contradicts" in text
        assert "at a.yaml:3:" in text
        assert f"both are about '{example}'" in text


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("{topic: /a, rate: 1..2}", "{topic: /b, rate: 3..4}"),
        ("{topic: /a, rate: 1..2}", "{connection: /a, rate: 3..4}"),
        ("{topic: /a, rate: 1..2}", "{topic: /a, rate: p95 3..4}"),
        ("{topic: /a, latency: p50 <= 4 s}", "{topic: /a, latency: p95 >= 5 s}"),
        ("{topic: '/**', without: '/cam/**', rate: <= 2}", "{topic: '/cam/*', rate: 3..4}"),
        ("{topic: 're:/cam[0-9]+', rate: <= 2}", "{topic: 're:/lidar[0-9]+', rate: 3..4}"),
        ("{connection: /a, subscriber: /x, rate: 1..2}", "{connection: /a, subscriber: /y, rate: 3..4}"),
        ("{topic: /a, type: 'x/*', rate: 1..2}", "{topic: /a, type: 'y/*', rate: 3..4}"),
        ("{node: '/a*', expected: always}", "{node: /ab, expected: never}"),
        ("{node: /a, expected: always}", "{node: /a, on: h, expected: never}"),
        ("{node: /a, expected: always}", "{node: '/**', without: /a, expected: never}"),
        ("{node: /a, expected: at most one}", "{node: /a, expected: never}"),
    ],
)
def test_what_can_hold_together_does(one: str, other: str):
    assert len(constraints_of(merged(one, other))) == 2


def test_every_contradiction_is_found():
    documents = read_references(sources(*(f"constraints: [{{topic: /a, rate: {n}..{n}.5}}]" for n in range(4))), BY_KEY)
    assert len(merge_references(documents).contradictions) == 6


def test_fields_and_chains_contradict_too():
    field = "fields: [{topic: /a, field: x, range: %s}]"
    with pytest.raises(DocumentError, match=r"field x of /a: value 3..4. contradicts 'a.field.a.x.value'"):
        load_reference(sources(field % "1..2", field % "3..4"), BY_KEY)
    chain = "chains: [{topics: [/a, /b], age: '%s'}]"
    with pytest.raises(DocumentError, match=r"data over /a > /b: age >= 2 s. contradicts"):
        load_reference(sources(chain % "<= 1 s", chain % ">= 2 s"), BY_KEY)


QUANTITY = st.sampled_from(["rate", "latency", "jitter", "loss"])
NAME = st.sampled_from(["/a", "/b", "/c/*", "/d/{x,y}"])


@settings(deadline=None)
@given(st.sets(st.tuples(NAME, QUANTITY), min_size=2, max_size=8), st.randoms())
def test_the_order_of_orthogonal_documents_does_not_matter(parts: set[tuple[str, str]], random: object):
    texts = [f"constraints: [{{topic: '{name}', {quantity}: <= 5}}]" for name, quantity in sorted(parts)]
    given_ = sources(*texts)
    shuffled = list(given_)
    random.shuffle(shuffled)  # type: ignore[attr-defined]
    one, other = load_reference(given_, BY_KEY), load_reference(shuffled, BY_KEY)
    assert constraints_of(one) == constraints_of(other)
    assert len(one.expectations) == len(parts)


@pytest.mark.heavy
@pytest.mark.timed
def test_a_thousand_sentences_are_read_and_held_against_each_other_in_seconds():
    names = ("/robot{}/scan", "/robot{}/*/state", "/**/sensor{}*", "/*/joint{}")
    rows = [
        f"- {{topic: '{names[n % 4].format(n)}', rate: {n % 50 + 1}..{n % 50 + 2} Hz, expected: always}}"
        for n in range(1000)
    ]
    text = "kind: reference\nname: big\nconstraints:\n" + "\n".join(rows)
    started = time.process_time()
    result = merge_references(read_references([GivenText("big.yaml", text.encode())], BY_KEY))
    assert turned_s(started) < 10
    assert len(result.reference.expectations) == 1000
    # `/**/sensor2*` and `/**/sensor22*` are the kind of pair that cannot both hold.
    assert all(one.first.selector.name.startswith("/**/sensor") for one in result.contradictions)
    assert result.contradictions


PIECE = st.lists(st.sampled_from(["a", "/", "*", "**", "?", "{a,/}"]), min_size=1, max_size=3).map("".join)
GLOB = PIECE.filter(lambda text: "***" not in text)
SMALL = ["".join(chars) for length in range(1, 7) for chars in itertools.product("ab/", repeat=length)]


@settings(max_examples=150, deadline=None)
@given(GLOB, GLOB, st.lists(GLOB, max_size=2))
def test_the_example_of_a_meeting_is_one_and_is_found_when_there_is_one(one: str, other: str, without: list[str]):
    first, second = Selector(EntityKind.TOPIC, one, without=tuple(without)), Selector(EntityKind.TOPIC, other)
    name = meeting_name(first, second)
    both = [CompiledSelector(first), CompiledSelector(second)]
    if name is None:
        met = [small for small in SMALL if all(selector.matches(small, ("", "", "", "")) for selector in both)]
        assert met == []
    else:
        assert all(selector.matches(name, ("", "", "", "")) for selector in both)
