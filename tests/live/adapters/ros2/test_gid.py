from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros2.gid import host_bits, pid_bits, prefix, text_of

# Seen of a node whose process was 27945 (0x6d29), and of one that was 27883 (0x6ceb).
SEEN = "010f78fd296d00a00000000000001403"


def test_the_parts_of_an_identifier_that_was_seen():
    assert pid_bits(SEEN) == 27945
    assert host_bits(SEEN) == "78fd"
    assert prefix(SEEN) == "010f78fd296d00a000000000"


def test_what_the_middleware_appends_is_cut_off():
    assert text_of([*bytes.fromhex(SEEN), 0, 0, 0, 0, 0, 0, 0, 0]) == SEEN


@given(st.binary(min_size=0, max_size=24))
def test_another_layout_names_no_process(gid):
    text = text_of(gid)
    if not text.startswith("010f"):
        assert pid_bits(text) is None
        assert host_bits(text) == ""
    else:
        assert pid_bits(text) is None or 0 <= pid_bits(text) <= 0xFFFF
