"""What is counted of each call, and what is not."""

import struct

import pytest
from native.series import series

from roslens.live.inside import slots
from roslens.live.inside.slots import ASKED, HEARD, PUBLISHED, REPLIED, REQUESTED, TAKEN
from roslens.live.inside.snapshot import snapshot

START = 1_700_000_000_000_000_000
ONE, OTHER, OWN = "11" * 16, "22" * 16, "ab" * 16
OVERFLOW = struct.Struct("=Q")


def counted(node):
    """The slots by kind, topic and publisher."""
    found = [snapshot(memoryview(raw)) for raw in node.slots()]
    return {(one.kind, one.topic, one.gid.rstrip(b"\0").hex()): one for one in found}


def only(node):
    (one,) = counted(node).values()
    return one


def message(number, sent=START, received=START + 1000, gid=ONE):
    return f"message {sent} {received} {number} {gid}"


@pytest.mark.parametrize(("how", "size"), [("typed", -1), ("serialized", 300), ("loaned", -1)])
@pytest.mark.parametrize("nested", [0, 1])
def test_every_way_to_publish_counts_once(either, how, size, nested):
    node = either()
    node.say("publisher /scan / laser", "set size 100", f"set nested {nested}", *[f"publish 0 {how}"] * 3)
    one = only(node)
    assert (one.kind, one.topic, one.node, one.messages, one.size) == (PUBLISHED, "/scan", "/laser", 3, size)
    assert series(one)[0][0] == 2
    assert one.first
    assert one.lost == -1


@pytest.mark.parametrize("how", ["info", "serialized_info", "loaned_info"])
@pytest.mark.parametrize("nested", [0, 1])
def test_every_take_with_information_tells_publisher_and_latency(either, how, nested):
    node = either()
    node.say("subscription /scan / map", f"set nested {nested}", "set size 10")
    for number in (1, 2, 3):
        assert node.say(message(number), f"take 0 {how}") == [0, 1]
    one = only(node)
    assert (one.kind, one.messages, one.lost, one.gid.rstrip(b"\0").hex()) == (TAKEN, 3, 0, ONE)
    assert series(one)[1] == pytest.approx((3, 3e-6, 3e-12))
    assert one.size == (30 if how == "serialized_info" else -1)


@pytest.mark.parametrize(("how", "size"), [("plain", -1), ("serialized", 10), ("loaned", -1)])
def test_a_take_without_information_is_counted_for_nobody(either, how, size):
    node = either()
    node.say("subscription /scan / map", "set size 10", f"take 0 {how}")
    one = only(node)
    assert (one.messages, one.size, one.lost, one.gid, series(one)[1][0]) == (1, size, -1, bytes(24), 0)


@pytest.mark.parametrize(("release", "gid"), [("", ONE), ("humble", "11" * 24)])
def test_a_sequence_counts_each_message_in_each_distribution(either, release, gid):
    node = either(release=release)
    node.say("subscription /scan / map", message(5, gid="11" * 24), *["take 0 sequence"] * 2)
    one = only(node)
    assert (one.gid.rstrip(b"\0").hex(), one.messages, one.lost, one.pending) == (gid, 8, 0, 0)
    assert series(one)[1][0] == 8
    assert series(one)[0] == pytest.approx((7, 7e-6, 7e-12))


def test_nothing_taken_or_failed_is_not_counted(either):
    node = either()
    node.say("publisher /a / n", "subscription /b / n", "publish 0 typed", message(1), "take 1 info")
    node.say(
        "set empty 1", "take 1 info", "take 1 sequence", "set empty 0", "set fail 1", "publish 0 typed", "take 1 info"
    )
    assert [one.messages for one in counted(node).values()] == [1, 1]


def test_results_are_those_of_the_middleware(either):
    node = either()
    node.say("set fail 1")
    assert node.say("publisher /a / n") == [-1]
    node.say("set fail 0", "publisher /a / n", "subscription /b / n", "set fail 1")
    assert node.say("publish 1 typed", "take 2 info") == [1, 10]


def test_each_publisher_of_a_subscription_has_its_own_slot(either):
    node = either()
    node.say("subscription /tf / map")
    lines = []
    for number in range(1, 4):
        for publisher in range(1, 101):
            lines += [message(number, gid=f"{publisher:032x}"), "take 0 info"]
    node.say(*lines)
    found = counted(node)
    assert len(found) == 100
    assert {(one.messages, one.lost, one.pending) for one in found.values()} == {(3, 0, 0)}


def test_losses_settle(either):
    """Late messages fill their gap; a late joiner has lost nothing; nor has who sees a publisher begin anew."""
    node = either()
    node.say("subscription /scan / map", f"time {START}")
    node.say(message(1000), "take 0 info", message(1004), "take 0 info", message(1002), "take 0 info")
    assert (only(node).lost, only(node).pending) == (0, 2)
    node.say(f"time {START + 1_000_000_001}", message(1005), "take 0 info")
    assert (only(node).lost, only(node).pending) == (2, 0)
    node.say(message(1), "take 0 info", message(2), "take 0 info")
    node.say(message(1, gid=OTHER), "take 0 info", message(9_000_000_000_000), "take 0 info")
    node.say(f"time {START + 3_000_000_000}", message(9_000_000_000_001), "take 0 info")
    assert {(one.lost, one.pending) for one in counted(node).values()} == {(2, 0), (0, 0)}


def test_numbers_that_are_not_supported_tell_no_losses(either):
    node = either()
    node.say("subscription /scan / map", message(2**64 - 1), "take 0 info", "take 0 info")
    assert (only(node).messages, only(node).lost) == (2, -1)


def test_a_middleware_that_says_its_numbers_are_wrong_is_believed(node):
    of = node(environment={"FAKE_UNNUMBERED": "1"})
    of.say("subscription /scan / map", message(1), "take 0 info", message(9), "take 0 info")
    assert (only(of).messages, only(of).lost) == (2, -1)


@pytest.mark.parametrize("when", ["made", "later"])
def test_what_a_content_filter_leaves_out_is_not_lost(either, when):
    node = either()
    node.say("subscription /scan / map filtered" if when == "made" else "subscription /scan / map")
    if when == "later":
        assert node.say("filter 0") == [0]
    node.say(message(1), "take 0 info", message(9), "take 0 info")
    assert (only(node).messages, only(node).lost, only(node).pending) == (2, -1, 0)


@pytest.mark.parametrize(
    ("sent", "received"), [(0, START), (-5, START), (START, 0), (2**63 - 1, START), (1, START), (START, 2**63 - 1)]
)
def test_times_that_cannot_be_are_no_latency(either, sent, received):
    node = either()
    node.say(f"time {START}", "subscription /scan / map", message(1, sent, received), "take 0 info")
    one = only(node)
    assert one.messages == 1
    assert series(one)[1][0] == (1 if (sent, received) == (START, 0) else 0)


def test_information_of_another_layout_is_not_believed(either):
    node = either()
    node.say("subscription /scan / map", "set foreign 1", message(1), "take 0 info")
    one = only(node)
    assert (one.messages, one.gid, one.lost, series(one)[1][0]) == (1, bytes(24), -1, 0)


def test_a_middleware_older_than_humble_is_let_alone(either):
    node = either(release="ancient")
    node.say("publisher /a / n", "publish 0 typed", "subscription /b / n")
    assert node.say(message(1), "take 1 info")[-1] == 1
    assert node.slots() == []
    assert node.state() == "preload: not counting: the middleware is older than that of ROS 2 Humble"


@pytest.mark.parametrize("scope", ["local", "global", "outside"])
def test_the_middleware_is_found_wherever_it_was_loaded(node, scope):
    of = node(scope=scope)
    of.say("publisher /a / n", "publish 0 typed")
    assert only(of).messages == 1


def test_calls_of_a_service_on_both_sides(either):
    node = either()
    node.say("client /add / asker", "service /add / adder")
    for number in range(1, 4):
        at = START + number * 1_000_000_000
        node.say(f"call {number} {ONE}", f"time {at}", "serve 0 request")
        node.say(f"message {at} {at + 1000} 0 00", f"time {at + 2000}", "serve 1 ask")
        node.say(f"time {at + 5_002_000}", "serve 1 reply", f"time {at + 6_000_000}", "serve 0 response")
    found = {one.kind: one for one in counted(node).values()}
    assert {kind: (one.topic, one.node, one.messages) for kind, one in found.items()} == {
        REQUESTED: ("/add", "/asker", 3),
        ASKED: ("/add", "/adder", 3),
        REPLIED: ("/add", "/adder", 3),
        HEARD: ("/add", "/asker", 3),
    }
    assert series(found[ASKED])[1] == pytest.approx((3, 3e-6, 3e-12))
    assert series(found[REPLIED])[3] == pytest.approx((3, 15e-3, 75e-6))
    assert series(found[HEARD])[3] == pytest.approx((3, 18e-3, 108e-6))
    assert series(found[REQUESTED])[3][0] == series(found[ASKED])[3][0] == 0


def test_a_response_to_nothing_known_has_no_time(either):
    node = either()
    node.say("client /add / asker", f"call 7 {ONE}", "serve 0 response")
    one = only(node)
    assert (one.kind, one.messages, series(one)[3][0]) == (HEARD, 1, 0)


def test_handles_come_and_go(either):
    node = either()
    for number in range(200):
        node.say(f"publisher /t{number % 3} / n", f"publish {number} typed", f"destroy {number}")
    found = [snapshot(memoryview(raw)) for raw in node.slots()]
    assert len(found) == 200
    assert {one.messages for one in found} == {1}


def test_the_slot_of_what_was_destroyed_says_so_and_serves_again_when_it_was_read(either):
    node = either()
    node.say(f"time {START}", "publisher /keeps / n", "publish 0 typed")
    for number in range(1, 100):
        now = START + number * 1_000_000_000
        node.say(f"time {now}", f"publisher /t{number} / n", f"publish {number} typed", f"destroy {number}")
        found = counted(node)
        assert found[PUBLISHED, f"/t{number}", OWN].ended == now
        assert found[PUBLISHED, "/keeps", OWN].ended == 0
    assert len(node.slots()) == 11
    assert {one.messages for one in found.values()} == {1}


def test_when_all_slots_are_taken_the_ones_silent_for_a_minute_are_given_away(either):
    node = either()
    node.say(f"time {START}", "subscription /tf / map")
    lines = []
    oldest, others = 500, [number for number in range(1, slots.CAPACITY + 1) if number != 500]
    for publisher in range(1, slots.CAPACITY + 1):
        received = START + (0 if publisher == oldest else publisher)
        lines += [message(1, received=received, gid=f"{publisher:032x}"), "take 0 info"]
    node.say(*lines)
    newcomer = [message(1, received=START + 30_000_000_000, gid=OTHER), "take 0 info"]
    node.say(f"time {START + 30_000_000_000}", *newcomer)
    assert (TAKEN, "/tf", OTHER) not in counted(node)
    assert slots.HEADER.unpack_from(node.file())[8] == 1
    later = START + 61_000_000_000
    node.say(f"time {later}", *newcomer, message(2, received=later, gid=OTHER), "take 0 info")
    found = counted(node)
    assert found[TAKEN, "/tf", OTHER].messages == 2
    assert found[TAKEN, "/tf", OTHER].generation == 2
    assert (TAKEN, "/tf", f"{oldest:032x}") not in found
    lines = []
    for publisher in others:
        lines += [message(2, received=later, gid=f"{publisher:032x}"), "take 0 info"]
    node.say(*lines)
    assert {one.messages for one in counted(node).values()} == {2}


@pytest.mark.parametrize(
    ("claim", "left"),
    [("self taken published", {PUBLISHED, TAKEN}), ("self taken", {TAKEN}), ("1 taken published", set()), ("x", set())],
)
def test_what_python_claims_is_left_to_it(node, claim, left):
    of = node()
    of.claim(claim)
    of.say("publisher /a / n", "subscription /b / n", "publisher /rosout / n", "client /c / n", message(1))
    of.say("publish 0 typed", "take 1 info", "publish 2 typed", "serve 3 request")
    everything = {(PUBLISHED, "/a"), (TAKEN, "/b"), (PUBLISHED, "/rosout"), (REQUESTED, "/c")}
    expected = everything - ({(PUBLISHED, "/a")} if PUBLISHED in left else set())
    expected -= {(TAKEN, "/b")} if TAKEN in left else set()
    assert {key[:2] for key in counted(of)} == expected
    assert slots.HEADER.unpack_from(of.file())[8] == 0


def test_when_the_claim_goes_the_library_counts(node):
    of = node()
    of.claim("self published")
    of.say(f"time {START}", "publisher /a / n", "publish 0 typed")
    assert counted(of) == {}
    of.claim("")
    of.say("publish 0 typed", f"time {START + 1_000_000_001}", "publish 0 typed")
    assert only(of).messages == 1


def test_a_child_leaves_the_file_to_its_parent(either):
    node = either()
    assert node.say("publisher /a / n", "publish 0 typed", "fork 0", "publish 0 typed") == [0, 0, 0, 0]
    assert only(node).messages == 2


def test_the_file_goes_with_the_process_and_its_lock_however_it_ends(node):
    import fcntl

    of = node()
    of.say("publisher /a / n")
    (path,) = of.counters.iterdir()
    assert path.name.startswith(f"{of.process.pid}-")
    assert path.stat().st_mode & 0o777 == 0o600
    assert of.counters.stat().st_mode & 0o777 == 0o700
    with path.open("rb") as file:
        with pytest.raises(BlockingIOError):
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        of.close()
        assert list(of.counters.iterdir()) == []
        killed = node()
        killed.say("publisher /a / n")
        (left,) = killed.counters.iterdir()
        killed.process.kill()
        killed.process.communicate()
    with left.open("rb") as file:
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)


def test_a_folder_that_cannot_be_is_told_once_and_the_node_runs(node, tmp_path):
    (tmp_path / "counters0").write_text("no folder")
    of = node()
    assert of.say("publisher /a / n", "publish 0 typed", "publisher /b / n") == [0, 0, 1]
    assert of.close() == f"roslens: the traffic of this process is not counted: {tmp_path}/counters0: Not a directory\n"
