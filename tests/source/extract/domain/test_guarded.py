"""Items that a list has only if something holds."""

from roslens.source.extract.domain.guarded import Guarded, guarded, is_counted
from roslens.source.extract.symbolic.text import And, Written


def test_items_keep_each_condition():
    (one, other) = guarded(["a", Guarded("b", Written("x"))], Written("y"), None)
    assert one == Guarded("a", Written("y"))
    assert other == Guarded("b", And((Written("y"), Written("x"))))


def test_a_list_is_counted_where_each_item_is_there():
    assert is_counted(["a"])
    assert not is_counted(["a", Guarded("b", Written("x"))])
