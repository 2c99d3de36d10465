import pytest

from roslens.live.inside import slots
from roslens.live.inside.snapshot import difference, lost_by, snapshot, text_at

SECOND = 1_000_000_000


@pytest.fixture
def slot():
    words = memoryview(bytearray(slots.SLOT_BYTES))
    made = slots.Slot(words)
    made.begin(slots.PUBLISHED, b"", "/scan", "/lidar", "")
    return words, made


def test_a_later_copy_has_the_names_of_the_earlier_and_numbers_of_its_own(slot):
    words, made = slot
    made.published(SECOND, 10)
    before = snapshot(words)
    made.published(2 * SECOND, 10)
    after = snapshot(words, before)
    assert after == snapshot(words)
    assert after.topic is before.topic
    assert difference(before, after, 1.0, 2.0).count == 1


def test_a_slot_that_became_another_endpoints_has_its_names(slot):
    words, made = slot
    before = snapshot(words)
    made.begin(slots.PUBLISHED, b"", "/image", "/camera", "")
    assert (snapshot(words, before).topic, snapshot(words, before).node) == ("/image", "/camera")


def test_nothing_is_lost_where_nobody_counts_losses(slot):
    words, made = slot
    made.published(SECOND, 10)
    assert lost_by(snapshot(words), 10 * SECOND) == 0
    assert lost_by(None, SECOND) == 0


def test_a_text_ends_with_a_zero():
    assert text_at(b"ab\0c", 0) == "ab"
    assert text_at(b"\xff\0", 0) == "\ufffd"
