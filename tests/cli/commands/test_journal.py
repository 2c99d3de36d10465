import csv
import json
import os

import pytest

from roslens.cli.main import main
from roslens.cli.workplace.journal_key import journal_signing
from roslens.store.journals.journal import Journal


@pytest.fixture
def path(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    found = tmp_path / "roslens" / "journal.jsonl"
    because = [{"entity": "topic:/scan", "statement": "topic /scan is low", "state": "low", "value": 3.5}]
    action = {"kind": "restart", "target": {"kind": "node", "name": "/driver"}, "arguments": {"grace": 2.0}}
    with Journal(found) as journal:
        journal.add("decided", 1e9, decision="r/1.0", entity="topic:/scan", because=because, action=action)
        journal.add("outcome", 1e9 + 1, decision="r/1.0", result="done", text="started\x1b[2J again", duration_s=0.25)
    return found


def test_it_is_shown_with_what_it_was_done_for(path, capsys):
    assert main(["journal"]) == 0
    day, decided, outcome = capsys.readouterr().out.splitlines()
    assert day.startswith("2001-09-0")
    assert "[r/1.0]  restart node:/driver (grace: 2 s)  about topic:/scan  because topic /scan is low = 3.5" in decided
    assert "0.250 s  done  started [2J again" in outcome


def test_what_was_changed_is_the_exit_code(path, capsys):
    assert main(["journal", "--verify"]) == 0
    head = capsys.readouterr().out.split()[-1]
    assert main(["journal", str(path), "--verify", "--head", head]) == 0
    path.write_bytes(path.read_bytes().replace(b"3.5", b"4.5"))
    assert main(["journal", "--verify"]) == 1
    assert "line 1: entry 0 was changed" in capsys.readouterr().out


def test_a_journal_that_was_hashed_anew_is_the_exit_code(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    path = tmp_path / "journal.jsonl"
    with Journal(path, journal_signing(path, os.environ)) as journal:
        journal.add("decided", 1e9, entity="topic:/scan")
    assert main(["journal", str(path), "--verify"]) == 0
    assert "1 entries as they were written, 1 of them signed" in capsys.readouterr().out
    path.unlink()
    with Journal(path) as journal:
        journal.add("decided", 1e9, entity="topic:/other")
    assert main(["journal", str(path), "--verify"]) == 1
    assert "entry 0, the last that was signed here, is not there as it was written" in capsys.readouterr().out


def test_the_key_is_of_the_user_and_the_folder(tmp_path):
    one, other = ({"XDG_CONFIG_HOME": str(tmp_path / name)} for name in ("one", "other"))
    keys = {journal_signing(tmp_path / name / "j", user).key for name in "ab" for user in (one, other)}
    assert len(keys) == 4
    assert journal_signing(tmp_path / "a/j", one) == journal_signing(tmp_path / "a/../a/j", one)
    assert journal_signing(tmp_path / "a/k", one).last != journal_signing(tmp_path / "a/j", one).last


def test_it_is_exported_whole(path, tmp_path):
    assert main(["journal", "--export", str(tmp_path / "all.json")]) == 0
    assert [one["what"] for one in json.loads((tmp_path / "all.json").read_text())] == ["decided", "outcome"]
    assert main(["journal", "--export", str(tmp_path / "all.csv")]) == 0
    with (tmp_path / "all.csv").open() as stream:
        assert [row["decision"] for row in csv.DictReader(stream)] == ["r/1.0", "r/1.0"]


def test_no_journal_is_an_answer(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "none"))
    assert main(["journal"]) == 2
    assert "`roslens react` writes one" in capsys.readouterr().err
    assert main(["journal", "--head", "ab"]) == 2


def test_a_journal_without_entries_says_so(tmp_path, capsys):
    (tmp_path / "empty.jsonl").touch()
    assert main(["journal", str(tmp_path / "empty.jsonl")]) == 0
    assert "empty: nothing has been decided here yet" in capsys.readouterr().err
