import pytest

from roslens.intake.is_there import is_file, is_folder


def test_files_and_folders_are_told_apart_through_links(tmp_path):
    (tmp_path / "file").touch()
    (tmp_path / "link").symlink_to("file")
    (tmp_path / "to_folder").symlink_to(".")
    assert (is_file(tmp_path / "file"), is_folder(tmp_path / "file")) == (True, False)
    assert (is_file(tmp_path / "link"), is_folder(str(tmp_path / "to_folder"))) == (True, True)
    assert (is_file(tmp_path), is_folder(tmp_path)) == (False, True)


@pytest.mark.parametrize("name", ["none", "a" * 300, "a/" * 3000, "nul\0", "loop", "far"])
def test_no_name_is_too_odd_to_ask(tmp_path, name):
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "far").symlink_to("b" * 300)
    assert not is_file(tmp_path / name)
    assert not is_folder(tmp_path / name)
