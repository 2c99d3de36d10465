import pytest

from roslens.model.acting.process_end import UNKNOWN, end_of_status, end_words, in_order


@pytest.mark.parametrize(
    ("status", "text", "words", "orderly"),
    [
        (0, "exit 0", "exit 0", True),
        (256, "exit 1", "exit 1", False),
        (2, "signal 2", "SIGINT", True),
        (15, "signal 15", "SIGTERM", True),
        (11 | 128, "signal 11", "SIGSEGV", False),
        (9, "signal 9", "SIGKILL", False),
    ],
)
def test_an_end_is_told_by_its_wait_status(status, text, words, orderly):
    assert (end_of_status(status), end_words(text), in_order(text)) == (text, words, orderly)


def test_what_nobody_saw_is_not_known():
    assert (in_order(UNKNOWN), in_order("")) == (None, None)
    assert (end_words(UNKNOWN), end_words("signal 999")) == ("unknown", "signal 999")
