"""Submodules of a revision: read where their objects are, reported where they are not."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from roslens.cli.git.git_repository import commit_of_revision, repository_of
from roslens.cli.git.git_tree import Lacking, write_tree


def git(folder: Path, *arguments: str) -> str:
    who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    command = [
        "git",
        "-C",
        str(folder),
        "-c",
        "init.defaultBranch=main",
        "-c",
        "protocol.file.allow=always",
        *arguments,
    ]
    environment = {**os.environ, **who, "GIT_CONFIG_GLOBAL": "/dev/null"}
    return subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout.strip()


def made(root: Path, **files: str) -> Path:
    root.mkdir(parents=True)
    git(root, "init", "-q")
    committed(root, **files)
    return root


def committed(root: Path, **files: str) -> None:
    for name, text in files.items():
        (root / name).write_text(text)
    git(root, "add", ".")
    git(root, "commit", "-qm", "files")


@pytest.fixture
def outer(tmp_path: Path) -> Path:
    """Return a repository with a submodule in a submodule, at two revisions: ``first`` and ``main``."""
    deep = made(tmp_path / "servers/deep", deep="1")
    driver = made(tmp_path / "servers/driver", driver="1")
    git(driver, "submodule", "add", "-q", str(deep), "deep")
    git(driver, "commit", "-qm", "deep")
    root = made(tmp_path / "outer", own="1")
    git(root, "submodule", "add", "-q", "--name", "the driver", str(driver), "src/driver")
    git(root, "submodule", "update", "-q", "--init", "--recursive")
    git(root, "commit", "-qm", "driver")
    git(root, "tag", "first")
    committed(root / "src/driver", driver="2")
    git(root, "commit", "-qam", "newer driver")
    return root


def written(root: Path, revision: str, folder: Path) -> tuple[dict[str, str], Lacking]:
    repository = repository_of(str(root))
    lacking = write_tree(repository, commit_of_revision(repository, revision), folder)
    files = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*")) if path.is_file()}
    return {name: path.read_text() for name, path in files.items() if ".gitmodules" not in name}, lacking


def test_a_submodule_is_read_at_the_commit_of_the_revision(outer, tmp_path):
    first, lacking = written(outer, "first", tmp_path / "a")
    assert first == {"own": "1", "src/driver/driver": "1", "src/driver/deep/deep": "1"}
    assert lacking == Lacking()
    assert written(outer, "main", tmp_path / "b")[0]["src/driver/driver"] == "2"


def test_below_a_folder(outer, tmp_path):
    assert written(outer / "src", "first", tmp_path / "a")[0] == {"driver/driver": "1", "driver/deep/deep": "1"}


def test_one_that_is_not_checked_out_is_read_from_where_git_keeps_it(outer, tmp_path):
    git(outer, "submodule", "deinit", "-f", "src/driver")
    files, lacking = written(outer, "first", tmp_path / "a")
    assert files["src/driver/deep/deep"] == "1"
    assert lacking == Lacking()


def test_one_that_was_moved_is_found_by_its_name(outer, tmp_path):
    git(outer, "mv", "src/driver", "driver")
    git(outer, "commit", "-qm", "moved")
    assert written(outer, "first", tmp_path / "a")[0]["src/driver/driver"] == "1"
    assert written(outer, "main", tmp_path / "b")[0]["driver/driver"] == "2"


def test_a_repository_of_its_own_that_no_one_declared(outer, tmp_path):
    inner = made(outer / "plain", plain="1")
    git(outer, "add", "plain")
    git(outer, "commit", "-qm", "plain")
    assert (inner / ".git").is_dir()
    assert written(outer, "main", tmp_path / "a")[0]["plain/plain"] == "1"


def test_what_is_not_there_is_told(outer, tmp_path):
    clone = tmp_path / "clone"
    git(tmp_path, "clone", "-q", str(outer), str(clone))
    files, lacking = written(clone, "first", tmp_path / "a")
    assert files == {"own": "1"}
    commit = git(outer, "rev-parse", "first:src/driver")
    assert lacking == Lacking(submodules=(("src/driver", commit),))


def test_one_in_another_that_is_not_there_is_told(outer, tmp_path):
    shutil.rmtree(outer / ".git/modules/the driver/modules")
    commit = git(outer / "src/driver", "rev-parse", "HEAD:deep")
    files, lacking = written(outer, "first", tmp_path / "a")
    assert files == {"own": "1", "src/driver/driver": "1"}
    assert lacking == Lacking(submodules=(("src/driver/deep", commit),))


def test_a_name_leads_nowhere_else(outer, tmp_path):
    elsewhere = tmp_path / "elsewhere"
    shutil.move(outer / ".git/modules/the driver", elsewhere)
    shutil.rmtree(outer / "src/driver")
    committed(outer, **{".gitmodules": f'[submodule "../../../elsewhere"]\npath = src/driver\nurl = {elsewhere}\n'})
    git(
        outer,
        "update-index",
        "--add",
        "--cacheinfo",
        f"160000,{git(outer, 'rev-parse', 'first:src/driver')},src/driver",
    )
    git(outer, "commit", "-qm", "lead astray")
    assert [path for path, _ in written(outer, "main", tmp_path / "a")[1].submodules] == ["src/driver"]
