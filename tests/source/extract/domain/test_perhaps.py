"""Items that a list has only if something holds."""

from roslens.source.extract.domain.perhaps import Perhaps, is_counted, perhaps
from roslens.source.extract.symbolic.text import And, Written


def test_items_keep_each_condition():
    (one, other) = perhaps(["a", Perhaps("b", Written("x"))], Written("y"), None)
    assert one == Perhaps("a", Written("y"))
    assert other == Perhaps("b", And((Written("y"), Written("x"))))


def test_a_list_is_counted_where_each_item_is_there():
    assert is_counted(["a"])
    assert not is_counted(["a", Perhaps("b", Written("x"))])
