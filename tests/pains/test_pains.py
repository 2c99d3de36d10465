"""Each reason is told as docs/why.md shows it, and the page shows all of them."""

import pytest

from pains.page import PAGE, block, blocks
from pains.pains import PAINS

SHOWN = blocks(PAGE.read_text("utf-8"))


@pytest.mark.parametrize("pain", PAINS, ids=[one.key for one in PAINS])
def test_the_first_cause_is_the_reason_and_what_the_page_shows(pain):
    said = block(pain)
    lines = said.splitlines()
    assert lines[1].startswith("First cause: ")
    # Three lines, in which all that matters has to stand.
    assert pain.must in " ".join(line.strip() for line in lines[1:4])
    assert said == SHOWN[pain.key], "PYTHONPATH=tests python -m pains writes the page anew"


def test_the_page_shows_every_reason_once():
    assert sorted(SHOWN) == sorted(one.key for one in PAINS)
    assert len(PAINS) >= 22
