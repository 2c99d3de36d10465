"""How slow this machine is now: what a bound on processor time is stretched by, so that no neighbour breaks it."""

import time
from collections.abc import Iterator
from contextlib import contextmanager

CALM_NS = 10.5
"""What a turn of an empty loop takes on the calm machine that the bounds were set on."""
TURNS = 200_000


def slowness() -> float:
    """How many times longer a turn of an empty loop takes now than on a calm machine; at least 1."""
    best = float("inf")
    for _ in range(5):
        begun = time.process_time()
        for _ in range(TURNS):
            pass
        best = min(best, time.process_time() - begun)
    return max(1.0, best / TURNS * 1e9 / CALM_NS)


def turned_s(begun: float) -> float:
    """Processor seconds since `begun`, a `time.process_time()`, as a calm machine would have taken them."""
    return (time.process_time() - begun) / slowness()


@contextmanager
def soon(most_s: float) -> Iterator[None]:
    """Assert that what is done within takes less processor time than this on a calm machine, whatever else runs."""
    begun = time.process_time()
    yield
    # How fast the machine is matters only to what took long.
    assert time.process_time() - begun < most_s or turned_s(begun) < most_s
