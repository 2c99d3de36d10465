"""Variables by scope."""

from roslens.source.extract.builds.cmake_scope import Scope


def test_what_is_outside_is_read_and_not_written():
    outer = Scope(first={"a": "1", "b": "2"})
    inner = Scope(outer)
    inner.set("a", "3")
    inner.set("b", None)
    assert inner.get("a") == (True, "3")
    assert inner.get("b") == (True, None)
    assert inner.get("c") == (False, None)
    assert outer.get("a") == (True, "1")


def branches(scope, *values):
    found = []
    for value in values:
        scope.enter()
        scope.set("x", value)
        found.append(scope.leave())
    return found


def either(_name, values):
    return "|".join(map(str, values))


def test_branches_are_merged():
    scope = Scope(first={"x": "0"})
    scope.merge(branches(scope, "1", "2"), None, either)
    assert scope.get("x") == (True, "1|2")


def test_a_branch_that_sets_nothing_leaves_what_was():
    scope = Scope(first={"x": "0"})
    scope.merge([*branches(scope, "1"), {}], None, either)
    assert scope.get("x") == (True, "1|0")


def test_what_is_usual_wins():
    scope = Scope()
    scope.merge(branches(scope, "1", "2"), 1, either)
    assert scope.get("x") == (True, "2")


def test_branches_that_agree():
    scope = Scope()
    scope.merge(branches(scope, "1", "1"), None, either)
    assert scope.get("x") == (True, "1")
