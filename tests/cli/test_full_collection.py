"""The collector goes through everything once a minute, and by its own rule never."""

import gc

import pytest

from roslens.cli.watch.full_collection import EVERY_S, FullCollection


@pytest.fixture(autouse=True)
def _as_before():
    before = gc.get_threshold()
    yield
    gc.set_threshold(*before)


def test_everything_is_gone_through_once_a_minute():
    now, collected = 100.0, []
    collection = FullCollection(lambda: now, lambda: collected.append(now))
    while now < 100.0 + 10 * EVERY_S:
        collection.now_and_then()
        now += 0.25
    assert collected == [100.0 + EVERY_S * place for place in range(1, 10)]


def test_what_is_young_is_still_collected_as_soon_as_there_is_much_of_it():
    FullCollection(lambda: 0.0)
    young, middle, old = gc.get_threshold()
    assert young * middle < 1_000_000
    assert old * middle * young > 10**12
