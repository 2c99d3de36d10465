import io
import time

import pytest

from roslens.cli.main import main

REACTIONS = """\
kind: reference
name: r
constraints:
  - {node: /a, expected: always}
reactions:
  - id: one
    when: {node: /a, is: gone}
    do: [{snapshot: {}}]
"""


@pytest.fixture
def reference(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    (tmp_path / "r.yaml").write_text(REACTIONS)
    (tmp_path / "bare.yaml").write_text(REACTIONS.partition("reactions:")[0])
    (tmp_path / "allow.yaml").write_text("nodes: [{name: /a, actions: [reboot]}]\n")
    (tmp_path / "allow.yaml").chmod(0o600)
    return "r.yaml"


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["bare.yaml"], "no reaction in bare.yaml"),
        (["r.yaml", "--mode", "ask"], "--mode ask without a way to answer"),
        (["r.yaml", "--maintenance", "tonight"], "--maintenance: 'tonight' is not a maintenance window"),
        (["r.yaml", "--at-most", "-1"], "--at-most -1; expected 0 or more"),
        (["r.yaml", "--cool-down", "soon"], "--cool-down 'soon'"),
        (["r.yaml", "--allow", "allow.yaml", "--ros1"], "allow.yaml:1:29: the action 'reboot'"),
        (["r.yaml", "--enrolled", "none", "--ros1"], "none/monitor.pem: cannot read it"),
        (["r.yaml", "--publish-journal", "journal", "--ros1"], "--publish-journal 'journal'"),
    ],
)
def test_what_makes_no_sense_is_refused_before_anything_begins(reference, words, why, capsys, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO())
    assert main(["react", *words]) == 2
    assert why in capsys.readouterr().err


def test_what_was_done_before_a_monitor_began_again_counts_on(tmp_path):
    from roslens.cli.react.done_before import done_before
    from roslens.store.journals.journal import Journal

    path, now = tmp_path / "journal.jsonl", time.time()
    action = {"kind": "restart", "target": {"kind": "node", "name": "/a"}, "arguments": {}}
    with Journal(path) as journal:
        journal.add("announced", now - 900.0, decision="r/1.0", reaction="r", entity="node:/a", action=action)
        journal.add("announced", now - 60.0, decision="r/2.0", reaction="r", entity="node:/a", action=action)
        journal.add("announced", now - 50.0, decision="r/3.0", reaction="r", action={"kind": 3})
        journal.add("outcome", now - 40.0, decision="r/2.0", result="done")
    ((decision, ago_s),) = done_before(path, 600.0)
    assert (decision.id, str(decision.action.target)) == ("r/2.0", "node:/a")
    assert 60.0 <= ago_s < 90.0
