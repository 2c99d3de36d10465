"""Reference documents: what they mean, what they include, and what is wrong with them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.expectation import FieldCondition, Presence, PresenceMode, Reference, Selector, Timing
from roslens.judge.reference.merge_references import constraints_of
from roslens.judge.reference.reference_keys import SELECTOR_KEYS, TOLD_KEYS
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError
from roslens.model.finding import Severity

FIXTURES = Path(__file__).parents[1] / "fixtures" / "references"
HEAD = "kind: reference\nname: r\n"


def read(text: str, *more: str) -> Reference:
    texts = [GivenText(f"{'rstuv'[at]}.yaml", one.encode()) for at, one in enumerate((text, *more))]
    return load_reference(texts, BY_KEY)


def fault(text: str, *more: str) -> str:
    with pytest.raises(DocumentError) as caught:
        read(text, *more)
    return str(caught.value)


def constraint(lines: str) -> str:
    return f"{HEAD}constraints:\n  - " + lines.replace("\n", "\n    ")


def test_a_document_says_what_it_expects():
    path = FIXTURES / "robot.yaml"
    reference = load_reference([path], BY_KEY)
    assert (reference.name, reference.title) == ("robot", "One robot, wherever it is put")
    assert reference.documents == (str(path),)
    ids = [constraint.details.id for constraint in constraints_of(reference)]
    assert ids == [
        "robot.chain.scan.cmd_vel.age",
        "robot.field.battery.cells[0].voltage.value",
        "robot.host.{robot,base}*.cpu",
        "robot.host.{robot,base}*.memory",
        "robot.node.joy.presence",
        "robot.process.robot-1.*.threads",
        "robot.scan-to-amcl.latency",
        "robot.service.set_map.presence",
        "robot.topic.**.image.latency",
        "robot.topic.**.image.rate",
        "robot.topic.scan.lidar.presence",
        "robot.topic.scan.lidar.rate",
    ]
    rate = next(one for one in reference.expectations if one.details.id == "robot.topic.scan.lidar.rate")
    assert rate.selector == Selector(EntityKind.TOPIC, "/scan", type="sensor_msgs/msg/LaserScan", publisher="/lidar")
    assert (rate.range, rate.written, rate.percentile) == (Range(27, 33), "30 Hz ± 10 %", 0)
    assert rate.details.severity is Severity.ERROR
    assert rate.details.where == f"{path}:9"
    assert rate.details.text == "Look at the cable of the lidar."
    assert rate.details.group == "drive"
    assert rate.details.timing == Timing(lasting=2, recovering=3, margin=0.05, grace=10, window=1)
    latency = next(one for one in reference.expectations if one.details.id == "robot.topic.**.image.latency")
    assert (latency.range, latency.percentile) == (Range(maximum=0.03), 95)
    assert latency.selector == Selector(EntityKind.TOPIC, "**/image", without=("/debug/**",))
    assert (latency.details.severity, latency.details.timing.lasting) == (Severity.NOTE, 0)
    memory = next(one for one in reference.expectations if one.quantity == "memory")
    assert memory.range == Range(maximum=1.5 * 2**30)
    assert [(one.selector.name, one.mode) for one in reference.presences] == [
        ("/joy", PresenceMode.WHILE),
        ("/set_map", PresenceMode.AT_MOST_ONE),
        ("/scan", PresenceMode.ALWAYS),
    ]
    assert reference.presences[0].condition == Selector(EntityKind.NODE, "/teleop")
    check = reference.field_checks[0]
    assert (check.topic, check.field, check.range) == ("/battery", "cells[0].voltage", Range(3, 4.2))
    assert check.condition == FieldCondition("/battery", "present", Range(1, 1))
    assert reference.chains[0].topics == ("/scan", "/map", "/cmd_vel")
    assert reference.chains[0].range == Range(maximum=0.2)


def test_a_document_included_into_two_namespaces_holds_in_both():
    reference = load_reference([FIXTURES / "fleet.yaml"], BY_KEY)
    assert reference.name == "robot+left+right+fleet"
    names = {one.selector.name for one in reference.expectations if one.selector.kind is EntityKind.TOPIC}
    assert names == {"/left/scan", "/right/scan", "/left/{,**/}image", "/right/{,**/}image"}
    bounds = {one.details.id: one.range.maximum for one in reference.expectations if "amcl" in one.details.id}
    assert bounds == {"robot.left.scan-to-amcl.latency": 0.05, "robot.right.scan-to-amcl.latency": 0.02}
    # Hosts are in no namespace: what is said of them twice is said once.
    assert sum(one.quantity == "memory" for one in reference.expectations) == 1


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (
            "topc: /scan\nrate: 1..2",
            "r.yaml:4:5: unknown key 'topc' of a constraint; expected one of its 78 keys. Did you mean 'topic'?",
        ),
        ("zzzz: /scan\nrate: 1..2", "r.yaml:4:5: unknown key 'zzzz' of a constraint; expected one of host, node"),
        ("topic: /scan\nrate: 30 Hz", "r.yaml:5:11: rate: '30 Hz' is a single value, which nothing measured ever has"),
        ("topic: /scan\nrate: 5..9 ms", "r.yaml:5:11: rate: 5 ms: 'ms' is not its unit; expected one in Hz, mHz"),
        ("topic: /scan\nrat: 5..9", "Did you mean 'rate'?"),
        (
            "topic: /scan",
            "r.yaml:4:5: a constraint that expects nothing; expected a signal with a range, such as `rate`",
        ),
        ("service: /s", "a constraint that expects nothing; expected a signal with a range, such as `calls`, or"),
        ("rate: 1..2", "r.yaml:4:5: a constraint that selects nothing; expected one of the keys host, node"),
        ("topic: /s\nnode: /n\nrate: 1..2", "a constraint on `node` and `topic`; expected one of them"),
        ("node: /n\nrate: 1..2", "'rate' is not measured of a node; expected it of a topic or connection"),
        ("topic: /{a\nrate: 1..2", "r.yaml:4:12: topic: '{' without '}' in the pattern '/{a'"),
        ("topic: {a,b}/x\nrate: 1..2", "Put the value in quotes"),
        ("topic: {a,b}\nrate: 1..2", "topic is a table; expected a text. A text that begins with a brace"),
        ("topic: **/x\nrate: 1..2", "Put the value in quotes"),
        ("topic: /x\nrate: >= 5 Hz", "Put the value in quotes"),
        ("node: /n\nsubscriber: /a\ncpu: <= 5 %", "'subscriber' of a node; expected it with a connection only"),
        (
            "topic: /n\non: h\nrate: 1..2",
            "'on' of a topic; expected it with a node or process or connection or parameter only",
        ),
        ('topic: /n\nloss: ">= 120 %"', "loss: no value can be in '>= 120 %'; expected a part of 0..100"),
        ("topic: /n\nrate: any", "r.yaml:5:5: rate: 'any' expects nothing".replace("5:5", "5:11")),
        (
            "topic: /n\nexpected: allways",
            "expected is 'allways'; expected one of always, at most one, never, while KIND",
        ),
        ("topic: /n\nexpected: while nod /x", "expected is 'while nod /x'; expected while KIND NAME"),
        ("topic: /n\nexpected: while node", "expected while KIND NAME"),
        ("topic: /n\nrate: 1..2\nfor: 2 Hz", "for: 2 Hz: 'Hz' is not its unit; expected one in s, ms"),
        ("topic: /n\nrate: 1..2\nfor: -1 s", "for is '-1 s'; expected a time from 0 on"),
        ("topic: /n\nrate: 1..2\nmargin: 0.1", "margin: '0.1' has no unit; expected `0.1 %`"),
        ("topic: /n\nrate: 1..2\nmargin: 100 %", "margin is '100 %'; expected a share from 0 % to below 100 %"),
        ("topic: /n\nrate: 1..2\nseverity: bad", "severity is 'bad'; expected one of note, warning, error"),
        ("topic: /n\nrate: 1..2\nid: a b", "id is 'a b'; expected up to 80 letters"),
        ("topic: /n\nrate: 1..2\noverride: yes", "override is 'yes'; expected true or false"),
        ("topic: /n\nrate: 1..2\noverride: true", "override without an id"),
        ("topic: /n\nrate: 1..2\noverride: true\nid: x", "nothing to override: no constraint 'x.rate'"),
        ("topic: /n\nrate: 1..2\nid: x\n\b", "character"),
        ('topic: "/a\\x1b[2J"\nrate: 1..2', "topic has the control character '\\x1b'; expected a text without any"),
        ('topic: /a\nrate: 1..2\ntext: "a\\n\\x07"', "text has the control character '\\x07'"),
        ("topic:\nrate: 1..2", "r.yaml:4:5: topic has no value"),
        ("topic: re:(?!x)\nrate: 1..2", "has negative look-ahead or look-behind"),
    ],
)
def test_what_is_wrong_with_a_constraint(lines: str, message: str):
    assert message in fault(constraint(lines))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("kind: quality model\nname: r", "r.yaml:1:7: kind is 'quality model'; expected 'reference'"),
        ("name: r", "a reference without 'kind'"),
        ("kind: reference\nname: R", "name is 'R'; expected up to 60 small letters"),
        (HEAD + "include: nowhere.yaml", "r.yaml:3:10: no file 'nowhere.yaml'; expected a path relative to '.'"),
        (HEAD + "namespace: re:x", "namespace is 're:x'"),
        (HEAD + "namespace: /{a", "namespace: '{' without '}'"),
        (HEAD + "namespace: /a*\nconstraints: [{topic: 're:x', rate: 1..2}]", "which has wildcards; begin it with `/`"),
        (HEAD + "defaults: [1]", "defaults is a list; expected a table of defaults"),
        (HEAD + "defaults: {fore: 2 s}", "unknown key 'fore' of a table of defaults"),
        (
            HEAD + "fields: [{topic: /a, field: x, range: 1..2, when: {topic: /b*, field: y, range: 1}}]",
            "topic '/b*' has wildcards; expected the name of one",
        ),
        (HEAD + "fields: [{topic: /a, field: x..y, range: 1..2}]", "field is 'x..y'; expected a path such as"),
        (HEAD + "fields: [{topic: /a, field: x, range: 1..2 m}]", "'m' is not its unit; expected a number without a"),
        (HEAD + "fields: [{topic: /a, field: x, range: p95 1..2}]", "a percentile in 'p95 1..2'"),
        (HEAD + "fields: [{topic: /a, field: x, range: 1..2, when: 3}]", "when is '3'; expected a condition"),
        (HEAD + "fields: [{topic: /a, field: x}]", "a field check without 'range'"),
        (
            HEAD + "fields: [{topic: /a, field: x, difference: 1..2}]",
            "r.yaml:3:44: difference without `to`; expected the other field. Write `to: {field: …}`",
        ),
        (HEAD + "fields: [{topic: /a, field: x, range: 1..2, to: {field: y}}]", "r.yaml:3:49: to without a difference"),
        (HEAD + "fields: [{topic: /a, field: x, chang: 1..2}]", "Did you mean 'change'?"),
        (HEAD + "fields: [{topic: '/{a', field: x, change: 1..2}]", "r.yaml:3:18: topic: '{' without '}'"),
        (
            HEAD + "fields: [{topic: '/*', field: x, change: 1..2}, {topic: /a, field: x, change: 3..4}]",
            "contradicts 'r.field.*.x.change' (field x of /*: change 1..2) at r.yaml:3:34; both are about '/a'",
        ),
        (
            HEAD + "constraints: [{node: '/{a,b}', expected: always}, {node: /b, expected: never}]",
            "(node /{a,b}: each is always there) at r.yaml:3:32; both are about '/b'",
        ),
        (HEAD + "chains: [{topics: [/a], age: 1..2 s}]", "a chain over 1 topics; expected two or more"),
        (HEAD + "chains: [{topics: [/a, /b, a], age: 1..2 s}]", "'/a' twice in a chain"),
        (
            HEAD + "constraints:\n- {topic: /a, id: x, rate: 1..2}\n- {topic: /b, id: x, rate: 1..2}",
            "r.yaml:5:22: a second constraint with id 'r.x.rate'; expected one (the first is at r.yaml:4:22)",
        ),
    ],
)
def test_what_is_wrong_with_a_document(text: str, message: str):
    assert message in fault(text)


def test_equal_names_by_default_are_told_apart():
    text = (
        HEAD
        + "constraints:\n- {topic: /a, rate: 1..2}\n- {topic: /a, rate: p5 >= 1}\n- {topic: /a, type: T, rate: 1..2}"
    )
    assert [one.details.id for one in read(text).expectations] == [
        "r.topic.a.rate",
        "r.topic.a~2.rate",
        "r.topic.a~3.rate",
    ]


def test_a_document_may_not_include_itself(tmp_path: Path):
    (tmp_path / "a.yaml").write_text("kind: reference\nname: a\ninclude: b.yaml")
    (tmp_path / "b.yaml").write_text("kind: reference\nname: b\ninclude: a.yaml")
    with pytest.raises(DocumentError, match=r"b.yaml:3:10: 'a.yaml' includes itself"):
        load_reference([tmp_path / "a.yaml"], BY_KEY)


def test_what_is_included_twice_is_read_once(tmp_path: Path):
    (tmp_path / "base.yaml").write_text("kind: reference\nname: base\nconstraints: [{topic: /a, id: x, rate: 1..2}]")
    for name in "ab":
        (tmp_path / f"{name}.yaml").write_text(f"kind: reference\nname: {name}\ninclude: base.yaml")
    reference = load_reference([tmp_path / "a.yaml", tmp_path / "b.yaml"], BY_KEY)
    assert [one.details.id for one in reference.expectations] == ["base.x.rate"]
    assert reference.name == "base+a+b"


def test_two_documents_of_one_name_are_refused():
    assert "s.yaml:2:7: a second document named 'r'; expected one (text r.yaml)" in fault(HEAD, HEAD)


@pytest.mark.parametrize(
    ("namespace", "written", "meant"),
    [
        ("", "scan", "/scan"),
        ("", "/scan", "/scan"),
        ("", "**/scan", "**/scan"),
        ("", "re:.*scan", "re:.*scan"),
        ("/a", "scan", "/a/scan"),
        ("a/", "scan", "/a/scan"),
        ("/a", "/scan", "/scan"),
        ("/a", "'{/scan,/x}'", "{/scan,/x}"),
        ("/a", "'{scan,x}'", "/a/{scan,x}"),
        ("/a", "'**'", "/a/**"),
        ("/a", "'**/scan'", "/a/{,**/}scan"),
        ("/robot*", "'*'", "/robot*/*"),
        ("/a", "re:.*scan", "re:/a/(?:.*scan)"),
        ("/a", "re:/scan", "re:/scan"),
        ("/", "scan", "/scan"),
    ],
)
def test_relative_names_are_put_under_the_namespace(namespace: str, written: str, meant: str):
    head = HEAD + (f"namespace: {namespace}\n" if namespace else "")
    quoted = written if written.startswith("'") else f"'{written}'"
    reference = read(f"{head}constraints: [{{topic: {quoted}, rate: 1..2}}]")
    assert reference.expectations[0].selector.name == meant


WORD = st.one_of(
    st.sampled_from([*BY_KEY][:6]),
    st.sampled_from(
        [*SELECTOR_KEYS, *TOLD_KEYS, "expected", "constraints", "fields", "chains", "namespace", "include"]
    ),
    st.sampled_from(
        ["/a", "**", "re:(a", "{a", "25..35 Hz", "<= 1 s", "always", "while node /x", "true", "5", "5 %", ""]
    ),
)
TREE = st.recursive(
    WORD.map(json.dumps),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3).map(lambda items: f"[{', '.join(items)}]"),
        st.dictionaries(WORD.map(json.dumps), inner, max_size=4).map(
            lambda table: "{" + ", ".join(f"{key}: {value}" for key, value in table.items()) + "}"
        ),
    ),
    max_leaves=12,
)


@settings(deadline=None, max_examples=300)
@given(st.sampled_from(["constraints", "fields", "chains", "defaults", "include", "namespace"]), TREE)
def test_whatever_a_document_holds_is_read_or_refused_with_its_place(key: str, tree: str):
    for text in (f"{HEAD}{key}: {tree}", f"{HEAD}{key}: [{tree}]"):
        try:
            load_reference([GivenText("r.yaml", text.encode(), "/nowhere")], BY_KEY)
        except DocumentError as error:
            place = error.where
            if not place.startswith("r.yaml:"):
                pytest.fail(f"no place in {error}")


def test_texts_that_yaml_would_change_are_taken_as_written():
    reference = read(HEAD + "constraints:\n- node: no\n  on: off\n  threads: 12\n")
    assert reference.expectations[0].selector == Selector(EntityKind.NODE, "/no", host="off")
    lines = read(
        HEAD + "constraints:\n- node: /n\n  text: |\n    One.\n    Two.\n  threads: 1 ..\n    12\n"
    ).expectations[0]
    assert (lines.details.text, lines.written) == ("One.\nTwo.", "1 .. 12")
    assert isinstance(read(HEAD + "constraints: [{node: 12:30, expected: never}]").presences[0], Presence)
