"""Each sentence of SECURITY, and of README's *Promises*, names a test that is there; the page of them is current."""

import pytest

from promises.__main__ import PAGE, page
from promises.sentences import PARTS, missing, no_claim, promises, shown_by

PROMISES = promises()


def test_each_part_has_some():
    assert {one.part for one in PROMISES} == PARTS.keys()
    assert len(PROMISES) > 70


@pytest.mark.parametrize("promise", PROMISES, ids=[f"{one.part}: {one.text[:60]}" for one in PROMISES])
def test_each_names_a_test_that_is_there(promise):
    assert promise.tests or promise.no_claim, f"no test shows: {promise.text}"
    assert not (promise.tests and promise.no_claim)
    assert [missing(test) for test in promise.tests if missing(test)] == []


def test_nothing_is_declared_of_a_sentence_that_is_gone():
    assert (shown_by().keys() | no_claim().keys()) <= {one.text for one in PROMISES}


def test_the_page_is_current():
    assert PAGE.read_text() == page(), "run `PYTHONPATH=tests python -m promises`"


@pytest.mark.parametrize(
    ("test", "what"),
    [
        ("tests/promises/test_promises.py", ""),
        ("tests/promises/test_promises.py::test_what_is_missing_of_a_test_is_seen", ""),
        ("tests/promises", ""),
        ("tests/promises/test_promises.py::test_that_was_renamed", "no function test_that_was_renamed"),
        ("tests/promises/test_that_is_gone.py", "no file of tests"),
        ("tests/promises/sentences.py", "no file of tests"),
        ("tests/fixtures/metrics", "no file of tests"),
    ],
)
def test_what_is_missing_of_a_test_is_seen(test, what):
    assert missing(test).startswith(what)
    assert bool(missing(test)) == bool(what)
