"""A server of PostgreSQL for one run of the tests."""

import pytest
from postgres_server import postgres_server


@pytest.fixture(scope="session")
def server():
    """Yield a server."""
    with postgres_server() as one:
        yield one
