from pathlib import Path

import pytest
from process_metrics.small_repository import SmallRepository, small_repository


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> SmallRepository:
    """A repository that nobody changes."""
    return small_repository(tmp_path_factory.mktemp("small") / "repository")


@pytest.fixture
def empty(tmp_path: Path) -> SmallRepository:
    return SmallRepository(tmp_path / "empty")
