from collections.abc import Iterator

import pytest

from testbed.allowed import why_not
from testbed.hosts import Bed
from testbed.measure import answering


@pytest.fixture(scope="session")
def allowed() -> None:
    """Skips where this machine lets nobody make hosts."""
    if reason := why_not():
        pytest.skip(reason)


@pytest.fixture(scope="module")
def bulk(allowed: None) -> Iterator[Bed]:
    with Bed(["here", "there"], "bulk") as bed:
        answering(bed["there"])
        yield bed


@pytest.fixture(scope="module")
def shaped(allowed: None) -> Iterator[Bed]:
    with Bed(["here", "there"], "shaped") as bed:
        answering(bed["there"])
        yield bed
