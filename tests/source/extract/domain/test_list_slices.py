import pytest

from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.domain.list_slices import is_slice, part_of
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import Text, unknown


@pytest.mark.parametrize(
    ("written", "holds"), [("1:", True), (":-1", True), ("a:b", True), ("a", False), ("d[':']", False)]
)
def test_what_is_a_slice(written, holds):
    assert is_slice(written) is holds


def test_parts_of_what_is_known():
    assert part_of([1, 2, 3], "1:") == [2, 3]
    assert part_of([1, 2, 3], ":-1") == [1, 2]
    assert part_of(Text.of("/scan"), "1:") == Text.of("scan")


def test_parts_of_what_is_not():
    hole = unknown(OfParameter("names"), parameter="names", default="[a, b]")
    assert part_of(hole, "1:").holes[0].reason == "a part of {parameter names}"
    assert isinstance(part_of([1, 2], "a:b"), Unknown)
    assert part_of(Unknown("x"), "1:") == Unknown("x")
