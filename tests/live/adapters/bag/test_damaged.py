"""Recordings whose recorder was killed, or that were copied badly: what is there is read, what is not is reported."""

import random
import resource
import sqlite3
import struct
from contextlib import closing

import pytest

from roslens.live.adapters.bag.mcap import open_mcap
from roslens.live.adapters.bag.open_bag import open_bag
from roslens.live.adapters.bag.source import Source
from roslens.model.errors import RoslensError, UsageError

START = 1_700_000_000_000_000_000
COUNT = 200
FUZZED = 2000


def rows_of(kind, content_of, count=COUNT, size=20):
    which = "ros1" if kind.startswith("ros1") else "ros2"
    return [
        (f"/{'abc'[number % 3]}", START + number * 10_000_000, content_of(START, which, size))
        for number in range(count)
    ]


def counted(bag):
    return sum(tally.count for _, tallies in bag.tallies(0.5) for tally in tallies)


def ages(bag):
    stamped = [topic.name for topic in bag.topics]
    return sum(tally.age.count for _, tallies in bag.tallies(0.5, stamped) for tally in tallies)


@pytest.mark.parametrize("kind", ["ros1", "ros1_bz2", "ros1_lz4", "mcap", "mcap_zstd"])
def test_a_file_cut_anywhere_gives_what_stands_before(tmp_path, recording, content_of, kind):
    path = recording(tmp_path, kind, rows_of(kind, content_of), 1_000)
    content = path.read_bytes()
    cut = tmp_path / "cut"
    counts = []
    for share in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1):
        cut.write_bytes(content[: int(len(content) * share) - 1])
        try:
            bag = open_bag(cut)
        except UsageError:
            counts.append(0)
            continue
        assert bag.failures
        counts.append(counted(bag))
        assert counts[-1] == bag.messages
        assert ages(bag) == counts[-1]
    assert counts == sorted(counts)
    assert any(0 < count < COUNT for count in counts)
    assert counts[-1] == COUNT


def test_a_bag_that_was_never_closed_is_read_by_its_chunks(tmp_path, recording, content_of):
    path = recording(tmp_path, "ros1", rows_of("ros1", content_of), 1_000)
    content = path.read_bytes()
    whole = open_bag(path)
    expected = list(whole.tallies(0.5))
    at = content.index(b"index_pos=") + 10
    index_at = struct.unpack_from("<Q", content, at)[0]
    path.write_bytes(content[:at] + bytes(8) + content[at + 8 : index_at])
    bag = open_bag(path)
    assert "its recorder was probably killed" in bag.failures[0].what
    assert "rosbag reindex" in bag.failures[0].advice
    assert bag.topics == whole.topics
    assert list(bag.tallies(0.5)) == expected


def test_messages_of_a_chunk_that_was_never_finished_are_read(tmp_path, recording, content_of):
    path = recording(tmp_path, "ros1", rows_of("ros1", content_of, 30))
    content = path.read_bytes()
    at = content.index(b"index_pos=") + 10
    content = content[:at] + bytes(8) + content[at + 8 :]
    size_at = content.index(b"size=") + 5
    length = struct.unpack_from("<I", content, size_at)[0]
    body = size_at + 4 + 4
    path.write_bytes(content[:size_at] + bytes(8) + content[body : body + length - 10])
    bag = open_bag(path)
    assert bag.messages == counted(bag) == 29
    assert [topic.name for topic in bag.topics] == ["/a", "/b", "/c"]
    assert any("in a file that ends after" in failure.what for failure in bag.failures)


def records(content, at=8):
    while at + 9 <= len(content):
        kind, length = struct.unpack_from("<BQ", content, at)
        yield kind, content[at : at + 9 + length]
        at += 9 + length


FOOTER = struct.pack("<BQQQI", 2, 20, 0, 0, 0) + b"\x89MCAP0\r\n"


@pytest.mark.parametrize("kind", ["mcap", "mcap_zstd"])
@pytest.mark.parametrize("kept", [{1, 6, 7}, {1, 6}])
def test_mcap_without_summary_or_index_is_read_by_its_chunks(tmp_path, recording, content_of, kind, kept):
    path = recording(tmp_path, kind, rows_of(kind, content_of), 1_000)
    whole = open_bag(path)
    content = path.read_bytes()
    bare = tmp_path / "bare.mcap"
    bare.write_bytes(content[:8] + b"".join(record for number, record in records(content) if number in kept) + FOOTER)
    bag = open_bag(bare)
    assert bag.failures == ()
    assert bag.topics == whole.topics
    assert list(bag.tallies(0.5, ["/a"])) == list(whole.tallies(0.5, ["/a"]))
    assert len(list(bag.fields({"/b": ["header.stamp.sec"]}))) == len(list(whole.fields({"/b": ["header.stamp.sec"]})))


def test_mcap_without_chunks_is_read_message_by_message(tmp_path, recording, content_of, monkeypatch):
    path = recording(tmp_path, "mcap", rows_of("mcap", content_of))
    whole = open_bag(path)
    content = path.read_bytes()
    chunk = next(record for number, record in records(content) if number == 6)
    head = next(record for number, record in records(content) if number == 1)
    flat = tmp_path / "flat.mcap"
    flat.write_bytes(content[:8] + head + chunk[9 + 40 :] + FOOTER)
    monkeypatch.setattr("roslens.live.adapters.bag.gather._RUN_BYTES", 3_000)
    bag = open_bag(flat)
    assert bag.failures == ()
    assert bag.topics == whole.topics
    assert list(bag.tallies(0.5, ["/a"])) == list(whole.tallies(0.5, ["/a"]))
    assert len(open_mcap(Source(flat))._chunks) > 3


@pytest.mark.parametrize("kind", ["mcap", "mcap_zstd", "ros1", "ros1_lz4", "ros1_bz2"])
def test_a_damaged_chunk_loses_no_other_and_its_index_is_used(tmp_path, recording, content_of, kind):
    path = recording(tmp_path, kind, rows_of(kind, content_of), 1_000)
    content = bytearray(path.read_bytes())
    chunks = open_bag(path)._parts[0]._chunks
    chunk = chunks[len(chunks) // 2]
    content[chunk.at : chunk.at + chunk.packed] = b"\xff" * chunk.packed
    path.write_bytes(content)
    bag = open_bag(path)
    assert counted(bag) == COUNT
    assert ages(bag) == COUNT - sum(chunk.counts.values())
    assert f"the chunk at byte {chunk.at:,}" in bag.failures[0].what


def test_a_wrong_checksum_is_told_and_the_content_not_used(tmp_path, recording, content_of):
    path = recording(tmp_path, "mcap", rows_of("mcap", content_of, 30))
    content = path.read_bytes()
    at = content.index(b"\x06", 8)
    while struct.unpack_from("<BQ", content, at)[1] > len(content):
        at = content.index(b"\x06", at + 1)
    kept = b"".join(record for number, record in records(content) if number in {1, 6, 7})
    chunk_at = 8 + len(next(record for _, record in records(content)))
    body = bytearray(content[:8] + kept + FOOTER)
    body[chunk_at + 9 + 24 : chunk_at + 9 + 28] = b"\x01\x02\x03\x04"
    path.write_bytes(body)
    bag = open_bag(path)
    assert counted(bag) == 30
    assert list(bag.fields({"/a": ["header.stamp.sec"]})) == []
    assert "a checksum that is wrong" in bag.failures[0].what


def test_a_damaged_database_gives_what_stands_before(tmp_path, recording, content_of):
    path = recording(tmp_path, "sqlite", rows_of("sqlite", content_of, 3000))
    content = bytearray(path.read_bytes())
    middle = len(content) // 2 // 4096 * 4096
    content[middle : middle + 3 * 4096] = b"\xff" * 3 * 4096
    path.write_bytes(content)
    bag = open_bag(path)
    assert 0 < counted(bag) < 3000
    assert "messages that cannot be read" in " ".join(failure.what for failure in bag.failures)


@pytest.mark.parametrize("part", [0.3, 0.5, 0.9])
def test_a_database_that_was_cut_off_gives_what_stands_before(part, tmp_path, recording, content_of):
    path = recording(tmp_path, "sqlite", rows_of("sqlite", content_of, 3000))
    with path.open("r+b") as file:
        file.truncate(int(path.stat().st_size * part))
    bag = open_bag(path)
    assert 3000 * part / 3 < counted(bag) < 3000
    assert [topic.name for topic in bag.topics] == ["/a", "/b", "/c"]
    assert "a file that was cut off" in " ".join(failure.what for failure in bag.failures)


def test_rows_that_are_no_messages_are_left_out(tmp_path, recording, content_of):
    path = recording(tmp_path, "sqlite", rows_of("sqlite", content_of, 30))
    with closing(sqlite3.connect(path)) as database, database:
        database.execute("UPDATE messages SET timestamp = 'soon' WHERE id = 3")
        database.execute("UPDATE messages SET topic_id = 77 WHERE id = 5")
    database.close()
    bag = open_bag(path)
    assert counted(bag) == 28
    reported = " ".join(failure.what for failure in bag.failures)
    assert "is not a number" in reported
    assert "topic 77, which is defined nowhere" in reported


@pytest.mark.parametrize(
    ("content", "found"),
    [
        (b"", "an empty file"),
        (b"garbage, nothing else", "a file that begins with b'garbage"),
        (b"#ROSBAG V1.2\nxxxxxxxxxxxxxx", "rosbag fix"),
        (b"#ROSBAG V2.0\n", "cannot be read"),
        (b"\x89MCAP0\r\n", "cannot be read"),
        (b"SQLite format 3\0", "cannot be read"),
    ],
)
def test_what_is_no_recording_is_refused(tmp_path, content, found):
    path = tmp_path / "x.bag"
    path.write_bytes(content)
    with pytest.raises(UsageError, match=found):
        open_bag(path)


def mutated(content, chance):
    content = bytearray(content)
    for _ in range(chance.choice([1, 1, 2, 5, 20])):
        at = chance.randrange(len(content))
        way = chance.randrange(4)
        if way == 0:
            content[at] = chance.randrange(256)
        elif way == 1:
            content[at : at + 8] = chance.choice([b"\xff" * 8, b"\xff" * 4, bytes(8), b"\xff\xff\xff\x7f"])
        elif way == 2:
            del content[at : at + chance.randrange(1, 40)]
        else:
            content[at:at] = content[at : at + chance.randrange(1, 60)]
        content = content or bytearray(b"x")
    return bytes(content)


@pytest.mark.parametrize("form", ["whole", "without index"])
def test_no_mutated_recording_crashes_hangs_or_takes_memory(tmp_path, recording, content_of, kind, form):
    path = recording(tmp_path, kind, rows_of(kind, content_of, 24, 8), 300)
    whole = path.read_bytes()
    if form == "without index":
        whole = whole[: len(whole) * 2 // 3]
    chance = random.Random(f"{kind} {form}")
    victim = tmp_path / "victim"
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    read = 0
    for case in range(FUZZED // 12 + 1):
        victim.write_bytes(mutated(whole, chance))
        try:
            bag = open_bag(victim)
        except RoslensError:
            continue
        stamped = [topic.name for topic in bag.topics if topic.stamped]
        for _, tallies in bag.tallies(0.1, stamped):
            read += sum(tally.count for tally in tallies)
        # Code is made for every definition, which takes long when each is another one.
        wanted = {topic.name: ["header.stamp.sec", "pose.position.x"] for topic in bag.topics if case % 16 == 0}
        read += sum(1 for _ in bag.fields(wanted))
        bag.graph()
        assert all(str(failure) for failure in bag.failures)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000
    assert read or (kind, form) == ("sqlite", "without index")
