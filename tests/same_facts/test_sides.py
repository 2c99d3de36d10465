"""Two revisions of a small program are asked about clones; a planted difference is found, none says so."""

import shutil
import subprocess
from pathlib import Path

import pytest

from same_facts import __main__ as command
from same_facts import sides

NAME = "robot+arm"
NODE = '#include <rclcpp/rclcpp.hpp>\nint main() { rclcpp::Node node("arm"); node.create_publisher<M>("t", 1); }\n'
FILES = {
    "arm/package.xml": "<package format='3'><name>arm</name><version>1.0.0</version><depend>rclcpp</depend></package>",
    "arm/CMakeLists.txt": "add_executable(arm arm.cpp)\ninstall(TARGETS arm DESTINATION lib/arm)\n",
    "arm/arm.cpp": NODE,
}


def git(folder: Path, *words: str) -> str:
    identity = ("-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false")
    ended = subprocess.run(["git", *identity, "-C", folder, *words], check=True, capture_output=True, text=True)
    return ended.stdout.strip()


def committed(folder: Path) -> str:
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", "all")
    return git(folder, "rev-parse", "HEAD")


@pytest.fixture(scope="module")
def corpora(tmp_path_factory):
    """A folder with one clone, and the commit of it."""
    clone = tmp_path_factory.mktemp("corpora") / NAME
    for name, text in FILES.items():
        (clone / name).parent.mkdir(parents=True, exist_ok=True)
        (clone / name).write_text(text)
    git(clone.parent, "init", "-q", str(clone))
    return clone.parent, committed(clone)


@pytest.fixture
def roslens(tmp_path):
    """A repository with the source of roslens of which something may be changed."""
    root = tmp_path / "roslens"
    skipped = shutil.ignore_patterns("__pycache__", "web", "*.so")
    shutil.copytree(sides.ROOT / sides.SOURCE, root / sides.SOURCE, ignore=skipped)
    git(tmp_path, "init", "-q", str(root))
    committed(root)
    return root


@pytest.fixture
def compared(tmp_path, roslens, corpora, monkeypatch):
    """Return a function that compares HEAD and the working tree, and returns the exit code."""
    folder, commit = corpora
    kept = tmp_path / "kept"
    monkeypatch.setattr(command, "wanted", lambda: {NAME: commit})
    monkeypatch.setattr(command, "workspaces", lambda commits, where: sides.workspaces(commits, where, kept / "ws"))
    monkeypatch.setattr(command, "revision", lambda name: sides.revision(name, roslens, kept))
    monkeypatch.setattr(command, "working_tree", lambda: sides.working_tree(roslens, kept))
    monkeypatch.setattr(command, "ask", lambda side, names, jobs: sides.ask(side, names, kept / "ws", jobs))
    return lambda *words: command.main([*words, "--corpora", str(folder), "--jobs", "1"])


def test_a_planted_difference_is_found_and_none_says_so(compared, roslens, capsys):
    assert compared("HEAD") == command.SAME
    said = capsys.readouterr()
    assert said.out.startswith("0 differences in 1 repositories")
    assert "HEAD: 1 asked" in said.err
    assert "working tree: 0 asked" in said.err  # it is what HEAD is

    (vocabulary,) = (roslens / sides.SOURCE / "source" / "extract").rglob("implicit_endpoints.py")
    text = vocabulary.read_text()
    assert "/parameter_events" in text
    vocabulary.write_text(text.replace("/parameter_events", "/planted_events"))
    assert compared("HEAD") == command.DIFFERENT
    said = capsys.readouterr()
    assert "HEAD: 0 asked" in said.err  # what it said was kept
    assert "robot+arm@" in said.out
    assert "nodes > /arm > endpoints: /planted_events\n  - (nothing)\n  + {" in said.out


def test_what_breaks_in_one_revision_is_a_difference(compared, roslens, capfd):
    (extraction,) = (roslens / sides.SOURCE / "source" / "extract").rglob("extraction.py")
    extraction.write_text(extraction.read_text() + "\nraise RuntimeError('planted')\n")
    assert compared("HEAD") == command.DIFFERENT
    assert 'broken\n  - (nothing)\n  + "RuntimeError: planted"' in capfd.readouterr().out


def test_what_cannot_be_compared_is_named(compared, corpora, monkeypatch, capsys):
    monkeypatch.setattr(command, "wanted", lambda: {NAME: corpora[1], "no+clone": "1" * 40})
    assert compared("HEAD") == command.NOT_COMPARED
    assert "not compared: no clone of no+clone with its commit" in capsys.readouterr().out


def test_wrong_words_are_told(compared, capsys):
    assert compared("no-such-revision") == command.WRONG
    assert '"no-such-revision" is no revision' in capsys.readouterr().err
    assert command.main(["HEAD", "--corpora", "/no/such/folder"]) == command.WRONG
    assert "expected --corpora or $ROSLENS_CORPORA" in capsys.readouterr().err


def test_the_list_names_sixty_repositories_and_whole_commits():
    listed = sides.wanted()
    assert len(listed) >= 60
    assert {len(commit) for commit in listed.values()} == {40}
