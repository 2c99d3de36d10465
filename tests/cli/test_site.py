"""What the pages read of the workspace: what is in it, and nothing else, whatever a run says its files are called."""

import os

import pytest

from roslens.cli.site import source_reader


@pytest.fixture
def root(tmp_path):
    made = tmp_path / "ws"
    (made / "arm").mkdir(parents=True)
    (made / "arm" / "a.cpp").write_bytes(b"int a;")
    (tmp_path / "ws-secret").write_bytes(b"secret")
    (tmp_path / "secret").write_bytes(b"secret")
    (made / "link").symlink_to(tmp_path / "secret")
    (made / "folder").symlink_to(tmp_path)
    (made / "loop").symlink_to("loop")
    os.mkfifo(made / "pipe")
    return made


@pytest.mark.parametrize("path", ["arm/a.cpp", "arm/../arm/a.cpp", "./arm/a.cpp"])
def test_a_file_of_the_workspace_is_read(root, path):
    assert source_reader(root)(path) == b"int a;"


@pytest.mark.parametrize(
    "path",
    [
        "../secret", "arm/../../secret", "../ws-secret", "link", "folder/secret", "folder/ws/../secret", "loop", "pipe",
        "arm", "", ".", "gone", "a\0b", "a" * 300, "/etc/passwd", "/proc/self/environ",
    ],
)  # fmt: skip
def test_nothing_else_is(root, path):
    assert source_reader(root)(path) is None


def test_an_absolute_path_is_not_read(root, tmp_path):
    assert source_reader(root)(str(tmp_path / "secret")) is None
