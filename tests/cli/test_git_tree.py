import os
import subprocess
from pathlib import Path

import pytest

from roslens.cli.git.git_repository import commit_of_revision, names_like, repository_of
from roslens.cli.git.git_tree import LARGEST_BYTES, Lacking, write_tree
from roslens.model.errors import UsageError


def git(folder: Path, *arguments: str) -> str:
    who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    return subprocess.run(
        ["git", "-C", str(folder), "-c", "init.defaultBranch=main", *arguments],
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, **who, "GIT_CONFIG_GLOBAL": "/dev/null"},
    ).stdout.strip()


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    root = tmp_path / "repository"
    (root / "src/a").mkdir(parents=True)
    git(root, "init", "-q")
    (root / "src/a/one.py").write_text("1\n")
    (root / "src/b c.txt").write_text("")
    (root / "README").write_text("read me")
    (root / "src/mesh.stl").write_bytes(b"x" * (LARGEST_BYTES + 1))
    (root / "src/link").symlink_to("a/one.py")
    (root / "src/out").symlink_to("../README")
    (root / "src/root").symlink_to("/etc/passwd")
    git(root, "add", ".")
    git(root, "commit", "-qm", "first")
    git(root, "tag", "v1")
    (root / "src/a/one.py").write_text("2\n")
    git(root, "commit", "-qam", "second")
    return root


def written(root: Path, below: str, revision: str, folder: Path) -> dict[str, str]:
    repository = repository_of(str(root / below))
    assert write_tree(repository, commit_of_revision(repository, revision), folder) == Lacking()
    paths = sorted(path for path in folder.rglob("*") if not path.is_dir())
    return {path.relative_to(folder).as_posix(): path.read_text() for path in paths}


def test_files_are_those_of_the_revision(repository, tmp_path):
    first = written(repository, ".", "v1", tmp_path / "first")
    assert first["src/a/one.py"] == first["src/link"] == "1\n"
    assert first["README"] == first["src/out"] == "read me"
    assert first["src/b c.txt"] == ""
    assert written(repository, ".", "HEAD", tmp_path / "second")["src/a/one.py"] == "2\n"


def test_only_the_part_that_is_looked_at_and_no_link_out_of_it(repository, tmp_path):
    found = written(repository, "src", "main", tmp_path / "part")
    assert set(found) == {"a/one.py", "b c.txt", "link", "mesh.stl"}


def test_what_is_large_is_there_but_empty(repository, tmp_path):
    assert written(repository, ".", "HEAD", tmp_path / "all")["src/mesh.stl"] == ""


def test_what_git_does_not_have_is_told(repository, tmp_path):
    name = git(repository, "rev-parse", "HEAD:src/a/one.py")
    (repository / ".git/objects" / name[:2] / name[2:]).unlink()
    found = repository_of(str(repository))
    assert write_tree(found, commit_of_revision(found, "HEAD"), tmp_path / "all") == Lacking(("src/a/one.py",))
    assert (tmp_path / "all/src/a/one.py").read_text() == ""
    assert (tmp_path / "all/README").read_text() == "read me"


def test_nothing_is_fetched_for_a_partial_clone(repository, tmp_path):
    git(repository, "config", "uploadpack.allowFilter", "true")
    git(tmp_path, "clone", "-q", "--no-checkout", "--filter=blob:none", f"file://{repository}", "part")
    found = repository_of(str(tmp_path / "part"))
    commit = commit_of_revision(found, "HEAD")
    with pytest.raises(UsageError, match="partial clone"):
        write_tree(found, commit, tmp_path / "all")
    assert git(tmp_path / "part", "count-objects", "-v").count("size-pack") == 1


@pytest.mark.parametrize("name", ["v9", "HEAD:README", "--all", "", "a b"])
def test_a_name_that_is_no_commit(repository, name):
    assert commit_of_revision(repository_of(str(repository)), name) == ""


def test_what_may_have_been_meant(repository):
    found = repository_of(str(repository))
    assert names_like(found, "maim") == ["main"]
    assert names_like(found, "head~1") == []


def test_a_folder_outside_of_repositories(tmp_path, monkeypatch):
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    with pytest.raises(UsageError, match="no git repository"):
        repository_of(str(tmp_path))


def test_without_git(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(UsageError, match="git is not installed"):
        repository_of(str(tmp_path))
