import pytest
from process_metrics.local_forge import local_forge


@pytest.fixture
def forge():
    with local_forge() as made:
        yield made
