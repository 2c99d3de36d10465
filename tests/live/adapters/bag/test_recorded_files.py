from pathlib import Path

import pytest

from roslens.live.adapters.bag.damage import FailureLog
from roslens.live.adapters.bag.files.recorded_files import find_files
from roslens.live.adapters.bag.open_bag import open_bag
from roslens.model.errors import UsageError

START = 1_700_000_000_000_000_000


def names(found):
    return [path.name for path in found.paths]


def test_parts_of_a_folder_are_in_the_order_of_their_numbers(tmp_path):
    for name in ("run_10.mcap", "run_9.mcap", "run_1.mcap", "notes.txt"):
        (tmp_path / name).touch()
    assert names(find_files(tmp_path, FailureLog())) == ["run_1.mcap", "run_9.mcap", "run_10.mcap"]


def test_metadata_says_the_order_and_what_is_missing(tmp_path):
    for name in ("b.mcap", "a.mcap"):
        (tmp_path / name).touch()
    (tmp_path / "metadata.yaml").write_text(
        "rosbag2_bagfile_information:\n  relative_file_paths: [b.mcap, old/a.mcap, c.mcap]\n"
        "  compression_mode: MESSAGE\n  compression_format: zstd\n"
    )
    failures = FailureLog()
    found = find_files(tmp_path, failures)
    assert names(found) == ["b.mcap", "a.mcap"]
    assert found.compression == "zstd"
    assert ['"c.mcap"' in failure.what for failure in failures.all()] == [True]
    assert find_files(tmp_path / "metadata.yaml", FailureLog()) == found


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[1",
        "a: 1",
        "rosbag2_bagfile_information: 3",
        "rosbag2_bagfile_information: {relative_file_paths: x}",
        "\x00",
    ],
)
def test_metadata_that_cannot_be_read_is_told_and_the_files_are_read(tmp_path, text):
    (tmp_path / "a.db3").touch()
    (tmp_path / "metadata.yaml").write_text(text)
    failures = FailureLog()
    assert names(find_files(tmp_path, failures)) == ["a.db3"]
    assert "metadata that cannot be read" in failures.all()[0].what


@pytest.mark.parametrize("name", ["missing", "", "folder"])
def test_where_there_is_no_recording_is_said(tmp_path, name):
    (tmp_path / "folder").mkdir()
    path = tmp_path / name
    with pytest.raises(UsageError) as caught:
        open_bag(path)
    assert str(path) in str(caught.value)
    assert "a .bag, .mcap or .db3 file" in str(caught.value)
    assert caught.value.advice
    with pytest.raises(UsageError, match="no recording is named"):
        open_bag([])


def test_one_bad_file_of_several_is_told_and_the_others_are_read(tmp_path, recording, content_of):
    recording(tmp_path, "ros1", [("/a", START, content_of(START, "ros1"))])
    (tmp_path / "x.bag").write_bytes(b"garbage")
    bag = open_bag(tmp_path)
    assert bag.messages == 1
    assert "a file that begins with" in bag.failures[0].what
    (tmp_path / "ros1.bag").write_bytes(b"garbage")
    with pytest.raises(UsageError, match="none of 2 files can be read"):
        open_bag(tmp_path)


def test_generations_are_not_mixed(tmp_path, recording, content_of):
    paths = [recording(tmp_path, kind, [("/a", START, content_of(START, kind))]) for kind in ("ros1", "mcap")]
    with pytest.raises(UsageError, match="recordings of one generation"):
        open_bag(paths)


def test_a_link_to_nowhere_does_not_exist(tmp_path):
    (tmp_path / "x.bag").symlink_to(tmp_path / "nowhere")
    with pytest.raises(UsageError, match="does not exist"):
        open_bag(Path(tmp_path / "x.bag"))
