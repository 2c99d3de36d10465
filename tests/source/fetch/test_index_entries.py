"""Links and submodules are read from git's own list of files, whatever the length of their names."""

import subprocess

import pytest

from roslens.source.fetch.index_entries import IndexFormatError, index_entries


def git(folder, *words):
    subprocess.run(["git", "-C", str(folder), "-c", "index.version=2", *words], check=True, capture_output=True)


def test_every_length_of_name_is_read(tmp_path):
    git(tmp_path, "init", "-q")
    commit = "0123456789" * 4
    links = [f"links/{'x' * length}" for length in range(1, 20)]
    submodules = [f"s/{'y' * length}" for length in range(1, 20)]
    (tmp_path / "links").mkdir()
    for number, name in enumerate(links):
        (tmp_path / name).symlink_to("a")
        (tmp_path / f"file{number}").write_text("a")
    git(tmp_path, "add", "-A")
    for name in submodules:
        git(tmp_path, "update-index", "--add", "--cacheinfo", f"160000,{commit},{name}")
    git(tmp_path, "update-index", "--skip-worktree", "file3", links[4])
    found = index_entries(tmp_path)
    assert sorted(found.links) == sorted(links)
    assert sorted(found.submodules) == sorted((name, commit) for name in submodules)


@pytest.mark.parametrize(
    "content", [b"", b"DIRC", b"DIRC\0\0\0\4\0\0\0\1" + b"x" * 80, b"DIRC\0\0\0\2\0\0\0\2" + b"x" * 70]
)
def test_another_format_is_refused(tmp_path, content):
    (tmp_path / ".git").mkdir()
    (tmp_path / ".git/index").write_bytes(content)
    with pytest.raises(IndexFormatError):
        index_entries(tmp_path)
