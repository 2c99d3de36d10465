from pathlib import Path

import pytest

from roslens.cli.reference import pages

REFERENCE = Path(__file__).parents[2] / "docs" / "reference"


@pytest.mark.parametrize("path", sorted(pages()))
def test_the_page_is_fresh(path: str):
    assert (REFERENCE / path).read_text("utf-8") == pages()[path], "`make docs` writes it anew"
