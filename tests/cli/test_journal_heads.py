"""`roslens watch` publishes where the journals of its user end, and that an end was cut off."""

import contextlib
import os
from concurrent.futures import ThreadPoolExecutor
from urllib.request import urlopen

import pytest

from roslens.cli.main import main
from roslens.cli.watch.journal_heads import heads_of
from roslens.cli.watch.watch_live import _serve
from roslens.cli.workplace.journal_key import journal_signing
from roslens.intake.user_folder import state_folder, user_folder
from roslens.judge.reference.expectation import Reference
from roslens.live.join.session import Session
from roslens.store.journals.journal import Journal


@pytest.fixture(autouse=True)
def user(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


def written(path, count):
    with Journal(path, journal_signing(path, os.environ)) as journal:
        for number in range(count):
            journal.add("decided", 100.0 + number)


def test_without_a_journal_nothing_is_told_and_nothing_written(tmp_path):
    assert heads_of(None, os.environ)() == ()
    assert not user_folder(os.environ).exists()


def test_those_of_the_user_are_known_and_others_are_named(tmp_path):
    own, other = state_folder(os.environ) / "journal.jsonl", tmp_path / "other.jsonl"
    written(own, 3)
    written(other, 2)
    assert [(one.path, one.entries) for one in heads_of(None, os.environ)()] == [(str(own), 3)]
    assert [(one.path, one.entries) for one in heads_of([other, own], os.environ)()] == [(str(other), 2), (str(own), 3)]


@pytest.mark.timed
def test_a_tail_that_is_cut_off_shows_in_what_prometheus_reads(capsys):
    path = state_folder(os.environ) / "journal.jsonl"
    written(path, 5)
    session = Session(Reference("r"), start=0.0)

    with contextlib.ExitStack() as stack, ThreadPoolExecutor(1) as reader:
        answer = _serve(stack, 0, session, [], heads_of(None, os.environ))
        url = capsys.readouterr().err.split()[-1]

        def told():
            page = reader.submit(lambda: urlopen(url, timeout=20).read().decode())
            while not page.done():
                answer(session.look(1.0))
            lines = page.result().splitlines()
            return [line for line in lines if line.startswith(("roslens_journal_entries", "roslens_journal_whole"))]

        labels = f'{{journal="{path}"}}'
        assert told() == [f"roslens_journal_entries{labels} 5", f"roslens_journal_whole{labels} 1"]
        path.write_bytes(b"".join(path.read_bytes().splitlines(keepends=True)[:3]))
        assert told() == [f"roslens_journal_entries{labels} 3", f"roslens_journal_whole{labels} 0"]


def test_a_recording_has_no_journal(capsys):
    assert main(["watch", "--bag", "none.bag", "--journal", "j"]) == 2
    assert "--journal with --bag" in capsys.readouterr().err
