import os

import pytest

from roslens.source.extract.facts.files import FolderFiles, folders_in_common, joined


def test_paths_are_joined_without_dots():
    assert joined("a/b", "../c/./d.yaml") == "a/c/d.yaml"
    assert joined("", "a//b") == "a/b"
    assert joined("a", "../../b") == "../b"


def test_nothing_outside_is_read(tmp_path):
    inside = tmp_path / "workspace"
    inside.mkdir()
    (tmp_path / "secret").write_text("secret")
    (inside / "file").write_text("content")
    (inside / "link").symlink_to(tmp_path / "secret")
    (inside / "loop").symlink_to(inside / "loop")
    (inside / "large").write_bytes(b"x" * 11)
    files = FolderFiles(inside, {"robot": "src/robot"}, most_bytes=10)
    assert files.content("file") == b"content"
    for path in ("link", "../secret", "loop", "large", "gone", "", "a\0b", str(tmp_path / "secret")):
        assert files.content(path) is None
    assert files.package("robot") == "src/robot"
    assert files.package("other") is None


def test_what_has_no_end_is_not_read(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    assert FolderFiles(tmp_path, {}).content("pipe") is None
    assert FolderFiles(tmp_path, {}).content(".") is None


@pytest.mark.parametrize(
    ("one", "other", "count"), [("a/b/c.py", "a/b/d.py", 2), ("a/b/c.py", "a/d.py", 1), ("c.py", "c.py", 0)]
)
def test_folders_in_common_are_counted_from_the_top(one, other, count):
    assert folders_in_common(one, other) == count
