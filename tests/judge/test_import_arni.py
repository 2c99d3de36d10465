"""ARNI's specifications become references, and every line is accounted for."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.arni.import_arni import Entry, Outcome, import_arni, imported
from roslens.judge.documents.yaml_tree import read_tree
from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.expectation import Reference, Selector
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError

ARNI = Path(__file__).parents[1] / "fixtures" / "arni" / "arni.yaml"


def brought(text: str) -> tuple[Reference, list[str]]:
    reference, entries = imported(read_tree(text.encode(), "a.yaml"), "a", BY_KEY)
    return load_reference([GivenText("r.yaml", reference.encode())], BY_KEY), [str(entry) for entry in entries]


def ranges(reference: Reference) -> dict[str, Range]:
    return {f"{one.selector.name} {one.quantity}": one.range for one in reference.expectations}


def test_every_line_of_a_specification_is_accounted_for():
    text, entries = import_arni(ARNI, BY_KEY)
    reference = load_reference([GivenText("r.yaml", text.encode())], BY_KEY)
    assert reference.name == "arni"
    assert {
        f"{one.selector.name} {one.quantity}": (str(one.range), one.percentile) for one in reference.expectations
    } == {
        "/scan age": ("0..0.1", 0),
        "/scan rate": ("10..20", 0),
        "/scan largest_gap": ("<= 0.05", 0),
        "/odom rate": ("45..55", 0),
        "/odom bandwidth": ("800..1200", 0),
        "127.0.0.1 cpu": ("<= 80", 0),
        "127.0.0.1 cpu_core_max": ("<= 90", 0),
        "127.0.0.1 memory_share": ("<= 95", 100),
        "127.0.0.1 disk_free": (f"{2 * 2**30}..{99999999 * 2**20}", 0),
        "/amcl cpu": ("<= 80", 0),
        "robot-1 cpu": ("<= 70", 0),
        "[::1] cpu": ("<= 70", 0),
        "/cam* rate": ("5..10", 0),
    }
    assert [(one.selector.name, one.details.timing.lasting) for one in reference.presences] == [("/scan", 5)]
    connection = next(one for one in reference.expectations if one.selector.kind is EntityKind.CONNECTION)
    assert connection.selector == Selector(EntityKind.CONNECTION, "/scan", publisher="/lidar", subscriber="/amcl")
    counts = {outcome: sum(entry.outcome is outcome for entry in entries) for outcome in Outcome}
    assert counts == {Outcome.IMPORTED: 8, Outcome.CHANGED: 13, Outcome.LEFT_OUT: 14}
    lines = [int(entry.place.split(":")[1]) for entry in entries]
    assert lines == sorted(lines)
    said = set(lines)
    silent = {4, 5, 6, 12, 15, 26, 36}  # names of lists and of entities that became what they were
    assert said | silent >= set(range(4, 42))


@pytest.mark.parametrize(
    "text",
    [
        "- t!/a:\n    frequency: [1, 2]",
        "one:\n- t!/a:\n    frequency: [2, 1]",
        "arni:\n  specifications:\n  - t!/a:\n      frequency: [1, 2]",
        "/arni/specifications:\n  x:\n  - t!/a: {frequency: [1, 2]}",
        "/arni:\n  specifications:\n    x:\n    - t!___sl___a: {frequency: [1, 2, 3]}".replace(", 3", ""),
    ],
)
def test_each_way_to_load_a_specification_is_read(text: str):
    assert ranges(brought(text)[0]) == {"/a rate": Range(1, 2)}


@pytest.mark.parametrize(
    ("limits", "range_"),
    [
        ("[30, 0.1, relative]", Range(27, 33)),
        ("[30, 1.1, R]", Range(27, 33)),
        ("[7, 0.1, r]", Range(6.3, 7.7)),
        ("[0, 5]", Range(None, 5)),
        ("[-5, 5]", Range(None, 5)),
        ("[[1, 2], [1, 2]]", Range(1, 2)),
        ("[1, 2, absolute]", Range(1, 2)),
    ],
)
def test_limits_mean_what_they_meant(limits: str, range_: Range):
    assert ranges(brought(f"- t!/a: {{frequency: {limits}}}")[0]) == {"/a rate": range_}


@pytest.mark.parametrize(
    ("item", "message"),
    [
        ("t!/a: {frequency: 5}", "a.yaml:1:10: t!/a frequency: left out: it is '5', expected [low, high]"),
        ("t!/a: {frequency: [5]}", "a range is a list, expected [low, high]"),
        ("t!/a: {frequency: []}", "it is a list, expected [low, high]"),
        ("t!/a: {frequency: [nan, .inf]}", "['nan', '.inf'] are not two numbers, which ARNI rated unknown"),
        ("t!/a: {frequency: [-5, -1]}", "no value can be in -5..-1, expected a part of >= 0"),
        ("h!a: {cpu_usage_core_mean: [[0, 1], [0, 2]]}", "its ranges are different, and roslens has one for all"),
        ("n!/a: {node_bandwidth_mean: [0, 1]}", "bytes in a window, not per second"),
        ("n!/a: {cpu: [0, 1]}", "ARNI has no such field of a node"),
        ("t!/a: 5", "it has '5', expected fields with limits"),
        ("a: {frequency: [1, 2]}", "no id, expected h!host"),
        ("c!/a!/b: {frequency: [1, 2]}", "no id, expected h!host"),
        ("'t!/{a': {frequency: [1, 2]}", "'{' without '}' in the pattern '/{a'"),
        ('"t!/a\\n": {frequency: [1, 2]}', "its name cannot be printed"),
        ("t!/a: {alive_timer: -1}", "it is '-1', expected seconds"),
    ],
)
def test_what_cannot_be_imported_says_why(item: str, message: str):
    reference, entries = brought(f"- {item}")
    assert (reference.expectations, reference.presences) == ((), ())
    assert len(entries) == 1
    assert "left out" in entries[0]
    assert message in entries[0]


def test_of_two_ranges_the_last_holds_and_other_fields_stay():
    reference, entries = brought(
        "- t!/a: {frequency: [1, 2], bandwidth: [1, 2]}\n- t!/a: {frequency: [3, 4]}\n- t!/a: {frequency: [3, 4]}"
    )
    assert ranges(reference) == {"/a rate": Range(3, 4), "/a bandwidth": Range(1, 2)}
    assert "replaces the entry at a.yaml:1:10, as in ARNI" in " ".join(entries)
    assert "the same is said at a.yaml:2:10" in entries[-1]


@pytest.mark.parametrize("field", ["frequency", "node_cpu_usage_mean"])
@pytest.mark.parametrize("pattern_first", [True, False])
def test_a_pattern_that_contradicts_a_name_is_left_out(field: str, pattern_first: bool):
    kind = "t" if field == "frequency" else "n"
    items = [f"- {kind}!/*: {{{field}: [3, 4], {BESIDE[kind]}: [1, 2]}}", f"- {kind}!/a: {{{field}: [1, 2]}}"]
    reference, entries = brought("\n".join(items if pattern_first else items[::-1]))
    said = ranges(reference)
    assert len(said) == 2
    assert {name.split()[0] for name in said} == {"/*", "/a"}
    (entry,) = [one for one in entries if "contradicts" in one]
    assert (
        f"{kind}!/* {field}: left out: it contradicts the entry for /a at a.yaml:{2 if pattern_first else 1}:" in entry
    )


@pytest.mark.parametrize("text", ["", "5", "- - 5", "kind: reference"])
def test_a_file_without_a_specification_is_refused_or_empty(text: str):
    if text in {"", "5"}:
        with pytest.raises(DocumentError, match="expected a list of ids"):
            brought(text)
        return
    reference, entries = brought(text)
    assert reference.expectations == ()
    assert "left out" in entries[0]


def test_a_missing_file_is_named(tmp_path: Path):
    with pytest.raises(DocumentError, match="cannot read it: No such file"):
        import_arni(tmp_path / "no.yaml", BY_KEY)


def test_an_entry_reads_as_one_line():
    assert str(Entry("a:1:1", Outcome.IMPORTED, "x")) == "a:1:1: x: imported"


def test_a_pattern_may_contradict_in_several_signals():
    reference, entries = brought(
        "- t!/*: {frequency: [3, 4], bandwidth: [3, 4]}\n- t!/a: {frequency: [1, 2], bandwidth: [1, 2]}"
    )
    assert ranges(reference) == {"/a rate": Range(1, 2), "/a bandwidth": Range(1, 2)}
    assert sum("contradicts" in one for one in entries) == 2


BESIDE = {"t": "bandwidth", "n": "node_ramusage_mean"}
NUMBERS = st.one_of(st.integers(-1000, 1000), st.floats(-1e6, 1e6)).map(str)
LIMITS = st.one_of(
    NUMBERS,
    st.lists(NUMBERS, max_size=3).map(lambda items: f"[{', '.join(items)}]"),
    st.tuples(NUMBERS, NUMBERS).map(lambda pair: f"[{pair[0]}, {pair[1]}, relative]"),
)
ID = st.sampled_from(["t!/a", "t!/*", "h!x-1", "n!/n", "c!/a!/b!/c", "h![::1]", "t!/ä", "n!no"])
FIELD = st.sampled_from(
    ["frequency", "stamp_age_mean", "cpu_usage_max", "node_ramusage_mean", "alive_timer", "period_max"]
)


@given(st.lists(st.tuples(ID, st.dictionaries(FIELD, LIMITS, max_size=4)), min_size=1, max_size=5))
def test_whatever_is_imported_can_be_read(items: list[tuple[str, dict[str, str]]]):
    lines = []
    for seuid, fields in items:
        body = ", ".join(f"{field}: {limits}" for field, limits in fields.items())
        lines.append(f'- "{seuid}": {{{body}}}')
    reference, entries = brought("\n".join(lines))
    reported = sum(len(fields) for _, fields in items)
    assert len([entry for entry in entries if any(f" {field}:" in entry for field in _fields(items))]) == reported
    assert len(reference.expectations) <= reported


def _fields(items: list[tuple[str, dict[str, str]]]) -> set[str]:
    return {field for _, fields in items for field in fields}
