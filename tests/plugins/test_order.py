"""Plug-ins run after what they need; what they will not get is reported."""

import pytest

from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity
from roslens.plugins.member import LoadSpec, Member, Source
from roslens.plugins.order import Unavailable, generations, order
from roslens.plugins.points import Manifest


def make(name, needs=(), gives=(), builtin=False):
    quantities = tuple(Quantity(key, key, "1", (EntityKind.FILE,), "text") for key in gives)
    manifest = Manifest(name, "1.0", "1.0", needs=tuple(needs), quantities=quantities)
    return Member(manifest, "test", LoadSpec(Source.FILE), (), builtin=builtin)


def names(members):
    return [member.name for member in members]


def test_each_comes_after_what_it_needs():
    members = [make("a", needs=["c.x.max"]), make("b", needs=["plugin:a", "loc"]), make("c", gives=["c.x"]), make("d")]
    ordered = order(members, provided={"loc"})
    assert names(ordered.members) == ["c", "d", "a", "b"]
    assert not ordered.failures
    assert [names(group) for group in generations(members)] == [["c", "d"], ["a"], ["b"]]


def test_order_does_not_depend_on_the_order_given():
    members = [make("a"), make("b", needs=["plugin:c"]), make("c"), make("d")]
    assert names(order(members).members) == names(order(members[::-1]).members)


def test_a_missing_need_takes_its_dependants_along_and_names_both():
    ordered = order([make("a", needs=["b.x"]), make("b", needs=["lok"], gives=["b.x"]), make("c")], provided={"loc"})
    assert names(ordered.members) == ["c"]
    assert [str(failure) for failure in ordered.failures] == [
        "plug-in 'b' needs quantity 'lok', which nothing measures. Did you mean 'loc'?",
        "plug-in 'a' needs quantity 'b.x', which nothing measures. Add a plug-in that provides it, or disable a",
    ]
    (failure,) = order([make("a", needs=["plugin:gone"])]).failures
    assert str(failure).startswith("plug-in 'a' needs plug-in 'gone', which is missing or cannot run")


def test_a_cycle_names_both():
    ordered = order([make("a", needs=["plugin:b"]), make("b", needs=["plugin:a"]), make("c")])
    assert names(ordered.members) == ["c"]
    assert [str(failure) for failure in ordered.failures] == [
        "plug-in 'a' and plug-in 'b' wait for each other; expected needs without a cycle. Disable one of a, b",
        "plug-in 'b' and plug-in 'a' wait for each other; expected needs without a cycle. Disable one of a, b",
    ]


def test_what_waits_for_a_cycle_names_who_it_waits_for():
    ordered = order([make("a", needs=["plugin:b"]), make("b", needs=["plugin:a"]), make("c", needs=["plugin:a"])])
    assert not ordered.members
    assert [failure.what for failure in ordered.failures][2] == "plug-in 'c' waits for plug-in 'a', which cannot run"


@pytest.mark.parametrize("builtin", [False, True])
def test_a_missing_program_is_a_failure_but_for_built_in_plugins(builtin):
    ordered = order([make("a", needs=["program:cppcheck"], builtin=builtin)], is_installed=lambda _program: False)
    assert not ordered.members
    if builtin:
        assert ordered.unavailable == (Unavailable("a", "cppcheck"),)
        assert not ordered.failures
    else:
        assert "needs the program 'cppcheck', which is not installed" in str(ordered.failures[0])


def test_a_plugin_may_need_what_it_gives_itself():
    assert names(order([make("a", needs=["a.x"], gives=["a.x"])]).members) == ["a"]


def test_programs_are_looked_for_on_the_search_path(tmp_path, monkeypatch):
    member = make("a", needs=["program:mine"])
    monkeypatch.setenv("PATH", str(tmp_path))
    assert order([member]).failures
    (tmp_path / "mine").touch(mode=0o755)
    assert not order([member]).failures
