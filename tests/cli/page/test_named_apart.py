"""Files of one name are told apart by the shortest end of their paths that differs."""

from __future__ import annotations

import pytest

from roslens.cli.page.named_apart import named_apart


@pytest.mark.parametrize(
    ("paths", "names"),
    [
        (["/a/drive.mcap"], ["drive.mcap"]),
        (["/a/x.mcap", "/b/y.mcap"], ["x.mcap", "y.mcap"]),
        (["/a/monday/drive.mcap", "/a/tuesday/drive.mcap"], ["monday/drive.mcap", "tuesday/drive.mcap"]),
        (["/mo/r/d.bag", "/tu/r/d.bag", "/tu/s/e.bag"], ["mo/r/d.bag", "tu/r/d.bag", "e.bag"]),
        (["/a/drive", "/a/b/a/drive"], ["/a/drive", "b/a/drive"]),
        (["/a/d.bag", "/a/./d.bag", "/b/../a/d.bag"], ["d.bag", "d.bag", "d.bag"]),
        (["/drive", "/x/drive"], ["/drive", "x/drive"]),
        ([], []),
    ],
)
def test_a_name_is_as_long_as_it_must_be(paths, names):
    assert named_apart(paths) == names


def test_paths_are_of_the_folder_in_which_they_were_written(tmp_path, monkeypatch):
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    assert named_apart(["drive.mcap", "../drive.mcap"]) == ["here/drive.mcap", f"{tmp_path.name}/drive.mcap"]
