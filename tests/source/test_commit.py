"""The commit of a folder, and whether what was read is what the commit has."""

import os
import subprocess

import pytest

from roslens.model.source import Language, SourceFile
from roslens.source.commit import commit_of, committers_of, last_change_of
from roslens.source.keys import content_hash


@pytest.fixture
def clone(tmp_path):
    asked = {"cwd": tmp_path, "check": True, "capture_output": True}
    subprocess.run(["git", "init", "-q"], **asked)
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "a.cpp").write_bytes(b"int a;\nint b;\n")
    subprocess.run(["git", "add", "."], **asked)
    subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", "commit", "-qm", "one"], **asked)
    return tmp_path


def read(folder, path):
    content = (folder / path).read_bytes()
    return SourceFile(path, Language.CPP, size=len(content), content_hash=content_hash(content))


def test_what_was_read_is_what_the_commit_has(clone):
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=clone, capture_output=True, text=True).stdout.strip()
    assert commit_of(str(clone), [read(clone, "src/a.cpp")]) == head
    assert commit_of(str(clone / "src"), [read(clone / "src", "a.cpp")]) == head


def test_the_month_of_the_last_commit_that_changed_the_folder(clone):
    dated = {**os.environ, "GIT_COMMITTER_DATE": "2021-03-04T00:00:00Z"}
    (clone / "b.cpp").write_bytes(b"")
    subprocess.run(["git", "add", "."], cwd=clone, check=True)
    who = ("-c", "user.name=a", "-c", "user.email=a@example.org")
    subprocess.run(["git", *who, "commit", "-qm", "two"], cwd=clone, check=True, env=dated)
    assert last_change_of(str(clone)) == "2021-03"
    assert last_change_of(str(clone / "src")) > "2021-03"
    assert last_change_of(str(clone.parent / "none")) == ""


def test_those_who_committed_are_known_where_the_past_is_there(clone, tmp_path_factory):
    assert committers_of(str(clone)) == {"a", "a@example.org"}
    assert committers_of(str(clone.parent / "none")) == frozenset()
    other = tmp_path_factory.mktemp("other")
    subprocess.run(["git", "clone", "-q", "--depth", "1", f"file://{clone}", "."], cwd=other, check=True)
    assert committers_of(str(other)) == frozenset(), "who committed before is not known"


@pytest.mark.parametrize(("content", "differs"), [(b"int c;\n", True), (b"int a;\r\nint b;\r\n", False)])
def test_another_content_differs_and_other_ends_of_lines_do_not(clone, content, differs):
    (clone / "src" / "a.cpp").write_bytes(content)
    assert commit_of(str(clone), [read(clone, "src/a.cpp")]).endswith("+") is differs


def test_a_file_that_is_gone_differs_and_one_that_is_not_in_the_commit_does_not(clone):
    (clone / "src" / "new.cpp").write_text("int n;\n")
    files = [read(clone, "src/a.cpp"), read(clone, "src/new.cpp")]
    assert not commit_of(str(clone), files).endswith("+")
    (clone / "src" / "a.cpp").unlink()
    assert commit_of(str(clone), files[1:]).endswith("+")


def test_no_filter_of_the_repository_runs_and_nothing_is_written(clone):
    (clone / ".gitattributes").write_text("* filter=evil\n")
    subprocess.run(["git", "config", "filter.evil.clean", f"touch {clone.parent / 'ran'}; cat"], cwd=clone, check=True)
    (clone / "src" / "a.cpp").write_bytes(b"int other;\n")
    index = (clone / ".git" / "index").read_bytes()
    assert commit_of(str(clone), [read(clone, "src/a.cpp")]).endswith("+")
    assert not (clone.parent / "ran").exists()
    assert (clone / ".git" / "index").read_bytes() == index


def test_no_repository_and_a_bare_one_have_no_commit(tmp_path, monkeypatch):
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    assert commit_of(str(tmp_path)) == ""
    subprocess.run(["git", "init", "-q", "--bare", str(tmp_path)], check=True)
    assert commit_of(str(tmp_path)) == ""
