"""What is expected of one entity, and where that stands."""

from __future__ import annotations

from roslens.judge.reading.read_reference import GivenText, read_references
from roslens.judge.reference.constraint_words import expected_words
from roslens.judge.reference.explain_entity import combined, explain_entity
from roslens.judge.reference.merge_references import merge_references
from roslens.judge.reference.unmatched import Subject
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind

BASE = b"""\
kind: reference
name: base
constraints:
  - {topic: '/**', without: /scan2, rate: 10..30}
  - {topic: /scan, id: scan, rate: 20..40, expected: while topic /mode}
  - {topic: /scan, publisher: /lidar, latency: <= 1 s}
  - {node: /n, expected: while topic /scan}
fields:
  - {topic: /scan, field: x, range: 1..2, when: {topic: /mode, field: y, range: 1}}
chains:
  - {topics: [/scan, /map], age: <= 1 s}
"""
SITE = b"kind: reference\nname: site\nconstraints: [{id: scan, override: true, topic: /scan, rate: 25..50}]"
MERGED = merge_references(read_references([GivenText("base.yaml", BASE), GivenText("site.yaml", SITE)], BY_KEY))


def reported(subject: Subject) -> list[tuple[str, str, str, str]]:
    return [
        (one.declared.constraint.details.where, one.provided, one.role, one.replaced_by)
        for one in explain_entity(MERGED, subject)
    ]


def test_sentences_come_in_the_order_of_the_documents_and_replaced_ones_last():
    assert reported(Subject(EntityKind.TOPIC, "/scan")) == [
        ("base.yaml:4", "", "", ""),
        ("base.yaml:5", "", "", ""),
        ("site.yaml:3", "", "", ""),
        ("base.yaml:6", "its publisher is /lidar", "", ""),
        ("base.yaml:7", "", "it is the condition", ""),
        ("base.yaml:9", "", "", ""),
        ("base.yaml:11", "", "it is topic 1 of 2", ""),
        ("base.yaml:5", "", "", "site.yaml:3:56"),
    ]


def test_what_is_known_of_the_entity_decides():
    places = [row[0] for row in reported(Subject(EntityKind.TOPIC, "/scan", publisher="/other"))]
    assert "base.yaml:6" not in places
    assert ("base.yaml:6", "", "", "") in reported(Subject(EntityKind.TOPIC, "/scan", publisher="/lidar"))


def test_other_entities_take_part_in_other_ways():
    assert reported(Subject(EntityKind.TOPIC, "/mode")) == [
        ("base.yaml:4", "", "", ""),
        ("base.yaml:5", "", "it is the condition", ""),
        ("base.yaml:9", "", "it holds the condition", ""),
    ]
    assert reported(Subject(EntityKind.TOPIC, "/scan2")) == []


def test_what_is_left_of_several_ranges():
    assert combined(explain_entity(MERGED, Subject(EntityKind.TOPIC, "/scan")), BY_KEY) == {"rate": "25..30 Hz"}


def test_a_field_check_of_a_pattern_is_about_what_matches_and_names_what_it_is_compared_with():
    text = """kind: reference
name: r
fields:
  - {topic: "/front/*", without: /front/spare, field: ticks, difference: -1..1, to: {topic: /rear, field: ticks}}
"""
    merged = merge_references(read_references([GivenText("r.yaml", text.encode())], BY_KEY))
    roles = {
        name: [one.role for one in explain_entity(merged, Subject(EntityKind.TOPIC, name))]
        for name in ("/front/left", "/front/spare", "/rear", "/other")
    }
    assert roles == {"/front/left": [""], "/front/spare": [], "/rear": ["it is compared with"], "/other": []}
    assert expected_words(merged.standing[0].constraint) == "difference to /rear ticks -1..1"
