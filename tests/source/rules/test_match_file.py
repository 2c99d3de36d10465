"""When a rule is asked: what a file must mention, what tests are spared, where an anchor stands."""

import pytest

from roslens.model.source import Language
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.parsed_file import parse_file
from roslens.source.rules import match_file as module
from roslens.source.rules.match_file import match_file
from roslens.source.rules.rule import TESTS, TESTS_HINTS, FileRule
from roslens.source.settings import MacroSettings

WEIGHT = {"consequence": Consequence.WRONG, "certainty": Certainty.LIKELY}


@pytest.fixture
def asked(monkeypatch):
    """Return a function that says at which texts one rule is asked."""

    def ask(text, **what):
        seen = []

        def found(node, view):
            seen.append(view.text(node))
            return ()

        rule = FileRule(id="a.b", title="t", finds="f.", why="w", **WEIGHT, syntax="cpp", found=found, **what)
        monkeypatch.setattr(module, "file_rules", lambda syntax: (rule,))
        module._plan.cache_clear()
        match_file(parse_file(text.encode(), Language.CPP, MacroSettings()).view())
        return seen

    yield ask
    module._plan.cache_clear()


def test_an_anchor_is_a_whole_word_outside_of_comments(asked):
    text = "void f() { spin(); spins(); my_spin(); } // spin"
    assert asked(text, anchors=("spin",)) == ["spin"]


def test_an_anchor_of_several_words_stands_as_written(asked):
    text = "void f() { std::cout << 1; cout << std::x; }"
    assert asked(text, anchors=("std::cout",)) == ["std::cout"]


def test_a_file_that_mentions_nothing_of_it_is_not_looked_at(asked):
    assert asked("void f() { spin(); }", anchors=("spin",), mentions=("rclcpp",)) == []
    assert asked("// rclcpp\nvoid f() { spin(); }", anchors=("spin",), mentions=("rclcpp",)) == ["spin"]


def test_a_file_whose_code_has_none_of_its_words_is_not_looked_at(asked):
    assert asked("void f() { spins(); } // spin", whole=True, words=("spin",)) == []
    assert len(asked("void f() { spin(); }", whole=True, words=("spin", "sleep"))) == 1


@pytest.fixture
def together(monkeypatch):
    """Return a function that says what comes of one rule that is asked about all nodes of a type at once."""

    def ask(text, found_among):
        rule = FileRule(
            id="a.b",
            title="t",
            finds="f.",
            why="w",
            **WEIGHT,
            syntax="cpp",
            kinds=("call_expression",),
            found_among=found_among,
        )
        monkeypatch.setattr(module, "file_rules", lambda syntax: (rule,))
        module._plan.cache_clear()
        return match_file(parse_file(text.encode(), Language.CPP, MacroSettings()).view())

    yield ask
    module._plan.cache_clear()


def test_a_rule_may_be_asked_about_all_nodes_at_once(together):
    asked = []

    def found_among(nodes, view):
        asked.append(sorted(map(view.text, nodes)))
        return [view.hit("a.b", node, "m") for node in nodes]

    matched = together("void f() { a(); b(); a(); }", found_among)
    assert asked == [["a()", "a()", "b()"]]
    assert [hit.column for hit in matched.hits] == [12, 17, 22]
    assert together("int a;", found_among).hits == ()
    assert len(asked) == 1


def test_of_what_such_a_rule_finds_no_more_is_kept_than_of_others(together):
    calls = "a(); " * (module.MOST_HITS + 5)
    matched = together(f"void f() {{ {calls} }}", lambda nodes, view: (view.hit("a.b", one, "m") for one in nodes))
    assert len(matched.hits) == module.MOST_HITS
    assert matched.hits[0].column == 12


def test_such_a_rule_that_breaks_is_a_failure(together):
    assert "rule a.b failed: ZeroDivisionError" in together("int a = b();", lambda nodes, view: 1 / 0).failures[0].what


def test_tests_are_spared(asked):
    text = "#include <gtest/gtest.h>\nvoid f() { spin(); }"
    assert asked(text, anchors=("spin",)) == ["spin"]
    assert asked(text, anchors=("spin",), spares_tests=True) == []


def test_quoted_parts_are_asked_for_in_strings_alone(asked):
    assert asked('// /home/a\nauto x = "/home/b"; int home = a /home/ b;', quoted=("/home/",)) == ["/home/b"]


def test_the_pass_of_the_metrics_finds_the_nodes_that_rules_would_find_themselves():
    text = (
        "struct A { A(int a) { if (a) for (;;) { throw a; } } };\nint f() { int a = 1, b; { int a = 2; return a; } }\n"
    )
    alone = parse_file(text.encode(), Language.CPP, MacroSettings())
    shared = parse_file(text.encode(), Language.CPP, MacroSettings())
    kinds = module.kinds_asked("cpp")
    assert shared.facts(kinds) == alone.facts()
    assert shared.view().of_kinds.keys() == kinds
    assert not alone.view().of_kinds
    found = match_file(shared.view())
    assert found == match_file(alone.view())
    assert {"cpp.explicit_constructor", "cpp.shadowed_name", "cpp.throw_pointer"} & {one.rule for one in found.hits}


def test_nodes_of_other_types_than_rules_ask_for_are_looked_for_again():
    parsed = parse_file(b"int f(int a) { goto b; b: return a; }", Language.CPP, MacroSettings())
    parsed.facts(frozenset({"return_statement"}))
    assert "cpp.goto" in {one.rule for one in match_file(parsed.view()).hits}


def test_a_shape_leaves_out_what_it_does_not_say(asked):
    text = "void f() { if (a) { b(); } else if (c) d(); }"
    assert asked(text, kinds=("(else_clause (if_statement) @node)",)) == ["if (c) d();"]


def test_a_rule_on_the_whole_file_goes_through_what_it_gathers(monkeypatch):
    seen = []

    def found(_, view):
        seen.extend(view.text(one) for one in view.nodes("return_statement"))
        seen.extend(view.text(one) for one in view.nodes("(throw_statement (_) @node)"))
        return ()

    gathers = ("return_statement", "(throw_statement (_) @node)")
    words = {"id": "a.b", "title": "t", "finds": "f.", "why": "w", **WEIGHT}
    rule = FileRule(**words, syntax="cpp", found=found, whole=True, gathers=gathers)
    monkeypatch.setattr(module, "file_rules", lambda syntax: (rule,))
    module._plan.cache_clear()
    parsed = parse_file(b"int f() { if (a) throw b; return 1; }", Language.CPP, MacroSettings())
    match_file(parsed.view())
    parsed.facts(module.kinds_asked("cpp"))
    match_file(parsed.view())
    module._plan.cache_clear()
    assert seen == ["return 1;", "b"] * 2


def test_each_mention_of_tests_has_a_hint():
    assert all(any(hint in one for hint in TESTS_HINTS) for one in TESTS)
