"""A manifest with many mistakes costs time in proportion to its length."""

import time

from roslens.source.workspace.mistakes import mistakes_of

_BEGIN = (
    b'<package format="2"><name>a</name><version>1.0.0</version><description>d</description>'
    b'<maintainer email="a@b.org">A</maintainer><license>MIT</license><depend '
)


def taken_s(attributes):
    content = _BEGIN + b" ".join(b'a%d="1"' % number for number in range(attributes)) + b">x</depend></package>"
    best = float("inf")
    for _ in range(3):
        begun = time.thread_time()
        assert len(mistakes_of(content, "package.xml")) >= attributes
        best = min(best, time.thread_time() - begun)
    return best


def test_attributes_cost_time_in_proportion_to_their_number():
    # With what is in proportion to the square it would be sixteen times as long.
    assert taken_s(8000) < 8 * taken_s(2000)
