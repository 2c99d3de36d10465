"""How running ends before its time."""

from roslens.source.extract.builds.cmake_signals import WAYS_OUT, ReturnedError


def test_a_signal_tells_what_is_left():
    assert ReturnedError("break").what == "break"
    assert WAYS_OUT.index("continue") < WAYS_OUT.index("break") < WAYS_OUT.index("return")
