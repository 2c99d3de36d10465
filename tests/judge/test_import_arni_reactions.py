"""ARNI's countermeasures become reactions, and every line is accounted for."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from roslens.judge.arni.import_arni import Outcome, import_arni, imported
from roslens.judge.documents.yaml_tree import read_tree
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.window.signals import BY_KEY

FIXTURE = Path(__file__).parents[1] / "fixtures" / "arni" / "countermeasures.yaml"


def brought(path):
    text, entries = import_arni(path, BY_KEY)
    return load_reference([GivenText("r.yaml", text.encode())], BY_KEY), text, entries


def test_reactions_say_what_countermeasures_did():
    reference, text, _ = brought(FIXTURE)
    assert [one.quantity for one in reference.expectations] == ["rate"]
    assert '- id: "scan_low"' in text
    assert (
        '"all":[{"topic":"/scan","signal":"rate","is":"low"},{"topic":"/scan","signal":"bandwidth","is":"ok"},'
        '{"node":"lidar","signal":"cpu","is":["low","high"]}],"for":"4 s"'
    ) in text
    late, low = reference.reactions
    assert (low.cool_down_s, late.cool_down_s) == (12.0, 30.0)
    assert [(step.action.kind, str(step.action.target or "")) for step in low.steps] == [
        ("notify", ""),
        ("restart", "node:/lidar"),
        ("command", "node:/lidar"),
    ]
    assert low.steps[0].action.arguments["text"] == "scan {{low}}"
    assert low.steps[0].action.arguments["level"] == "warning"
    assert late.name.endswith(".not-ok")


def test_every_line_is_accounted_for():
    _, _, entries = brought(FIXTURE)
    said = {str(entry).partition(": ")[2] for entry in entries}
    for what in (
        "scan_low above: left out: its autonomy level 90 is above 50, so that ARNI never did it",
        "not ok! none: left out: ARNI has no action 'reboot'",
        "not ok! nowhere: left out: it names no node",
        "unsaid: left out: its condition cannot be said, so nothing of it is done",
        "not ok! not: changed: `not`: unknown values made it true in ARNI, but no longer do",
        (
            "scan_low n!lidar cpu_usage_mean: changed: `cpu` is out_of_bounds; ARNI has no such field of a node, and "
            "was never true; taken for node_cpu_usage_mean"
        ),
    ):
        assert what in said
    assert any(
        "no text of a document reaches a shell" in one and '["/bin/sh", "-c", "echo low > /tmp/low"]' in one
        for one in said
    )
    assert any(one.startswith("empty: left out") for one in said)
    assert any("ARNI ended when it read this" in one for one in said)
    assert {entry.place.rpartition(":")[0].rpartition(":")[0] for entry in entries} == {str(FIXTURE)}


@pytest.mark.parametrize(
    "text",
    [
        "arni: {countermeasure: {constraints: [a, b]}}",
        "arni: {countermeasure: {constraints: {a: 3}}}",
        "arni: {countermeasure: {constraints: {a: {constraint: [], reactions: {x: 1}}}}}",
        "arni: {countermeasure: {constraints: {a: {constraint: {and: {}}, reactions: {x: 1}}}}}",
        "arni: {countermeasure: {constraints: {a: {constraint: {t!/s: {frequency: odd}}, reactions: {x: {}}}}}}",
        "arni: {countermeasure: {constraints: {a: {constraint: {x!s: {frequency: ok}}, reactions: {x: []}}}}}",
        "arni: {countermeasure: {constraints: {a: {constraint: {t!/s: {frequency: ok}}, reactions: {x: []}}}}}",
        (
            "arni: {countermeasure: {constraints: {a: {constraint: {t!/s: {frequency: ok}}, "
            "reaction_timeout: soon, reactions: {x: {action: stop, node: '{a}'}}}}}}"
        ),
        f"arni: {{countermeasure: {{constraints: {{a: {{constraint: {'{not: ' * 14}{{}}{'}' * 14}}}}}}}}}",
    ],
)
def test_what_is_wrong_is_left_out_and_told(text):
    reference, entries = imported(read_tree(text.encode(), "a.yaml"), "a", BY_KEY)
    assert load_reference([GivenText("r.yaml", reference.encode())], BY_KEY).reactions == ()
    assert any(one.outcome is Outcome.LEFT_OUT for one in entries)


@pytest.mark.corpora
def test_arnis_own_files_are_imported():
    clone = Path(os.environ.get("ROSLENS_CORPORA", "/none")) / "ROS-PSE+arni"
    if not clone.exists():
        pytest.skip("no clone of ROS-PSE/arni below $ROSLENS_CORPORA")
    files = [*clone.glob("arni_core/test/*constraint*.yaml"), *clone.glob("arni_countermeasure/tests/*/*.yaml")]
    assert len(files) == 10
    counts = {}
    for path in files:
        reference, _, entries = brought(path)
        assert entries
        counts[path.name] = len(reference.reactions)
    # Of one the only condition is about bytes in a window of unknown length, which nobody measures.
    assert {name for name, count in counts.items() if not count} == {"constraint_node_stop.yaml"}
    assert sum(counts.values()) == 18
