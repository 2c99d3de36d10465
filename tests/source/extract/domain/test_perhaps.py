"""Items that a list has only if something holds."""

from roslens.source.extract.domain.perhaps import Perhaps, is_counted, perhaps


def test_items_keep_each_condition():
    (one, other) = perhaps(["a", Perhaps("b", "x")], "y", None)
    assert one == Perhaps("a", "y")
    assert other == Perhaps("b", "y and x")


def test_a_list_is_counted_where_each_item_is_there():
    assert is_counted(["a"])
    assert not is_counted(["a", Perhaps("b", "x")])
