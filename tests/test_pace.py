import pace
import pytest


def test_what_is_done_soon_passes_and_what_takes_long_does_not():
    with pace.soon(60):
        pass
    with pytest.raises(AssertionError), pace.soon(0):
        sum(range(1000))


def test_a_slow_machine_is_forgiven(monkeypatch):
    monkeypatch.setattr(pace, "slowness", lambda: 1e9)
    with pace.soon(1e-6):
        sum(range(100_000))
