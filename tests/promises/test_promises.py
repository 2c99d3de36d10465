"""Each sentence that README and SECURITY promise names a test that is there, and the page of them is current."""

import pytest

from promises.__main__ import PAGE, page
from promises.sentences import ROOT, promises, shown_by

PROMISES = promises()


def test_both_documents_have_some():
    assert {one.document for one in PROMISES} == {"README.md", "SECURITY.md", "SECURITY.md, known limitations"}
    assert len(PROMISES) > 60


@pytest.mark.parametrize("promise", PROMISES, ids=[one.text[:60] for one in PROMISES])
def test_each_names_a_test_that_is_there(promise):
    assert promise.tests, f"no test shows: {promise.text}"
    for test in promise.tests:
        place = ROOT / test
        assert place.exists(), test
        assert place.is_dir() or place.name.startswith("test_"), test


def test_no_test_is_named_for_a_sentence_that_is_gone():
    assert shown_by().keys() <= {one.text for one in PROMISES}


def test_the_page_is_current():
    assert PAGE.read_text() == page(), "run `PYTHONPATH=tests python -m promises`"
