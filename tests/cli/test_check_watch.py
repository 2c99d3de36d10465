"""``roslens check --watch``: what was saved is distinguished from what was not, and answered as a check would."""

import os
import time
from pathlib import Path

import pace
import pytest

from roslens.cli.check.check_watch import answers, warm
from roslens.cli.check.saved_files import Saved, SavedFiles
from roslens.cli.main import main
from roslens.source.measure.fresh_package import FreshPackages
from roslens.source.settings import RuleSettings, SourceSettings
from roslens.store.cache import Cache

MANY_CALLS = "def walk(step):\n" + "".join(f"    step.move_{number}()\n" for number in range(12)) + "    return step\n"
LIMITS_ONLY = SourceSettings(rules=RuleSettings(disable=("*",)))


@pytest.fixture
def fresh(talking, tmp_path):
    (talking / "talk/talk/walking.py").write_text("x = 1\n")
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        yield FreshPackages([talking], LIMITS_ONLY, talking, cache)


def save(place: Path, text: str) -> None:
    """Write a file as editors do: another one that takes its place."""
    other = place.with_name(place.name + "~")
    other.write_text(text)
    other.replace(place)


def test_what_was_saved(tmp_path):
    (tmp_path / "a").mkdir()
    one, two = tmp_path / "a/one.py", tmp_path / "two.py"
    one.write_text("1")
    two.write_text("2")
    files = SavedFiles(tmp_path, ["a/one.py", "two.py"])
    assert files.poll() == Saved()
    save(one, "11")
    assert files.poll() == Saved(("a/one.py",))
    assert files.poll() == Saved()
    (tmp_path / "a/notes.txt~").write_text("")
    assert files.poll() == Saved()
    (tmp_path / "a/three.py").write_text("")
    assert files.poll() == Saved((), other_files=True)
    two.unlink()
    assert files.poll().other_files
    os.utime(one, ns=(1, 1))
    assert files.poll().paths == ("a/one.py",)


def test_a_saved_file_is_answered(fresh, talking):
    files = SavedFiles(fresh.root, fresh.files)
    assert list(answers(fresh, files, lambda: 0.0)) == []
    save(talking / "talk/talk/walking.py", "# moves\n" + MANY_CALLS)
    head, *found = answers(fresh, files, iter((1.0, 1.25)).__next__)
    assert head == "talk/talk/walking.py: 2 findings (250 ms)"
    assert any("ros.calls.max" in line and "walking.py:2" in line for line in found)
    save(talking / "talk/talk/walking.py", "# roslens: ignore-file why not\n" + MANY_CALLS)
    assert list(answers(fresh, files, lambda: 0.0)) == ["talk/talk/walking.py: 0 findings, 2 set aside (0 ms)"]


def test_a_new_file_and_one_that_is_gone(fresh, talking):
    files = SavedFiles(fresh.root, fresh.files)
    count = len(fresh.files)
    (talking / "talk/talk/fresh.py").write_text(MANY_CALLS)
    assert list(answers(fresh, files, lambda: 0.0)) == [f"roslens: looked for packages again, {count + 1} files"]
    save(talking / "talk/talk/fresh.py", MANY_CALLS + "\n")
    assert next(answers(fresh, files, lambda: 0.0)).startswith("talk/talk/fresh.py: ")
    (talking / "talk/talk/fresh.py").unlink()
    assert list(answers(fresh, files, lambda: 0.0)) == [f"roslens: looked for packages again, {count} files"]
    assert list(answers(fresh, files, lambda: 0.0)) == []


def test_it_says_what_a_check_says(fresh, talking, capsys):
    (talking / "talk/talk/walking.py").write_text(MANY_CALLS)
    (talking / "roslens.toml").write_text('[rules]\ndisable = ["*"]\n')
    fresh.find()
    found = fresh.look("talk/talk/walking.py").findings
    assert main(["check", str(talking), "--format", "csv", "-q", "--jobs", "1", "--no-graph", "--no-store"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if "talk/talk/walking.py" in line]
    assert sorted(one.fingerprint for one in found) == sorted(
        one.fingerprint for one in found if any(one.fingerprint in line for line in lines)
    )
    assert len(lines) == len(found) == 2


def test_a_file_that_cannot_be_read_is_told_and_the_watch_goes_on(fresh, talking):
    files = SavedFiles(fresh.root, fresh.files)
    (talking / "talk/talk/nodes.py").write_text("x = 1\n")
    (talking / "talk/talk/walking.py").unlink()
    (talking / "talk/talk/walking.py").mkdir()
    reported = list(answers(fresh, files, lambda: 0.0))
    assert any(line.startswith("talk/talk/nodes.py: ") for line in reported)


@pytest.mark.timed
def test_within_the_bound(fresh, talking):
    warm(fresh)
    files = SavedFiles(fresh.root, fresh.files)
    for number in range(2):
        save(talking / "talk/talk/walking.py", MANY_CALLS + f"# {number}\n")
        begun = time.process_time()
        assert list(answers(fresh, files, time.monotonic))
        took = time.process_time() - begun
    assert took < 0.3 * pace.slowness()


@pytest.mark.parametrize("words", [["--baseline", "HEAD"], ["--format", "json"], ["-o", "x"], ["--changed"]])
def test_options_that_mean_nothing(talking, capsys, words):
    assert main(["check", str(talking), "--watch", *words]) == 2
    assert f"--watch with {words[0]}" in capsys.readouterr().err


def test_the_watch_begins_after_the_check_and_ends_by_ctrl_c(talking, capsys, monkeypatch):
    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr("roslens.cli.check.check_watch.pause", interrupted)
    words = ["check", str(talking), "--watch", "--jobs", "1", "--no-graph", "--no-store", "--fail-on", "never"]
    assert main(words) in {0, 3}
    reported = capsys.readouterr()
    assert reported.out.startswith("ws · 1 package")
    assert "roslens: watching " in reported.err
