"""ROS 1 bags that were closed before any message came, as rosbag writes them."""

import struct

import pytest

from roslens.cli.main import main
from roslens.live.adapters.bag.open_bag import open_bag


def header(fields):
    parts = [name.encode() + b"=" + value for name, value in fields.items()]
    return b"".join(struct.pack("<I", len(part)) + part for part in parts)


def record(fields, content):
    head = header(fields)
    return struct.pack("<I", len(head)) + head + struct.pack("<I", len(content)) + content


def connection(number, topic):
    fields = {"op": b"\x07", "conn": struct.pack("<I", number), "topic": topic.encode()}
    of = {"topic": topic.encode(), "type": b"std_msgs/String", "md5sum": b"0" * 32}
    return record(fields, header(of | {"message_definition": b"string data\n"}))


@pytest.fixture(params=[[], ["/a"]], ids=["no connection", "a connection"])
def topics(request):
    return request.param


@pytest.fixture
def bag(tmp_path, topics):
    """A header that points to an index without a chunk."""
    magic, padding = b"#ROSBAG V2.0\n", b" " * 4000
    fields = {"op": b"\x03", "conn_count": struct.pack("<I", len(topics)), "chunk_count": bytes(4)}
    index_at = len(magic) + len(record(fields | {"index_pos": bytes(8)}, padding))
    head = record(fields | {"index_pos": struct.pack("<Q", index_at)}, padding)
    path = tmp_path / "no-messages.bag"
    path.write_bytes(magic + head + b"".join(connection(number, topic) for number, topic in enumerate(topics)))
    return path


def test_it_is_a_recording_of_nothing(bag, topics):
    opened = open_bag(bag)
    assert (opened.messages, opened.failures, [topic.name for topic in opened.topics]) == (0, (), topics)
    assert list(opened.tallies()) == []


def test_a_watch_of_it_has_seen_nothing(bag, capsys, monkeypatch):
    monkeypatch.chdir(bag.parent)  # the title is cut where its path is long
    assert main(["watch", "--bag", bag.name]) == 3
    assert "0 messages" in capsys.readouterr().out
