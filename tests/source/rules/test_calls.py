"""What stands around a name: by hand, on code of a few words."""

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.calls import (
    arguments,
    call_at,
    constructed,
    is_conditional,
    is_discarded,
    is_handled,
    keywords,
    loop_around,
    number_of,
    receiver,
    template_argument,
    whole_quotient,
)
from roslens.source.settings import MacroSettings


def at(text, word, language=Language.CPP):
    view = parse_file(text.encode(), language, MacroSettings()).view()
    start = view.code.index(word.encode())
    return view.node_at(start, start + len(word)), view


@pytest.mark.parametrize(
    "callee", ["f", "n.f", "n->f", "a::b::f", "f<int>", "n->f<a::B<int>>", "x().f", "n->template f<int>"]
)
def test_a_call_is_found_from_the_last_part_of_its_name(callee):
    node, _ = at(f"void g() {{ {callee}(1, 2); }}", "f")
    assert len(arguments(call_at(node))) == 2, callee


def test_a_name_that_is_not_called_is_no_call():
    assert call_at(at("void g() { f.x(1); }", "f")[0]) is None
    assert call_at(at("void g() { x(f); }", "f")[0]) is None


def test_receiver_and_template_argument():
    node, view = at("void g() { a->b.f<C, D>(1); }", "f")
    call = call_at(node)
    assert view.text(receiver(call)) == "a->b"
    assert template_argument(call, view) == "C, D"


@pytest.mark.parametrize("text", ["T(1)", "T t(1)", "T t{1}", "T{1}", "auto t = T(1)"])
def test_arguments_of_what_is_constructed(text):
    node, view = at(f"void g() {{ {text}; }}", "T")
    assert [view.text(one) for one in constructed(node)] == ["1"]


def test_keywords_of_python():
    node, view = at("f(1, a=2, **more)", "f", Language.PYTHON)
    assert set(keywords(call_at(node), view)) == {"a", "**"}


@pytest.mark.parametrize(("text", "lost"), [("f();", True), ("(f());", True), ("x = f();", False), ("g(f());", False)])
def test_a_result_is_lost_in_a_statement_of_its_own(text, lost):
    assert is_discarded(call_at(at(f"void h() {{ {text} }}", "f")[0])) is lost


@pytest.mark.parametrize(
    ("text", "handled"),
    [
        ("try { f(); } catch (...) {}", True),
        ("try { } catch (...) { f(); }", False),
        ("try { g([] { f(); }); } catch (...) {}", False),
        ("f();", False),
    ],
)
def test_handled_is_what_stands_in_the_body_of_a_try(text, handled):
    assert is_handled(at(f"void h() {{ {text} }}", "f")[0]) is handled


def test_loops_and_conditions_end_at_the_function():
    inside, _ = at("void h() { while (x) { if (y) f(); } }", "f")
    loop = loop_around(inside)
    assert loop is not None
    assert is_conditional(inside, loop)
    assert loop_around(at("void h() { while (x) { g([] { f(); }); } }", "f")[0]) is None


@pytest.mark.parametrize(("text", "value"), [("0", 0), ("0x10", 16), ("-1.5f", -1.5), ("1'000", 1000), ("n", None)])
def test_literal_numbers(text, value):
    node, view = at(f"void h() {{ g({text}); }}", "g")
    assert number_of(arguments(call_at(node))[0], view) == value


@pytest.mark.parametrize(
    ("text", "value"),
    [("1 / 10", (0, True)), ("10 / 5", (2, False)), ("1.0 / 10", None), ("1 / 0", None), ("1 * 2", None)],
)
def test_quotients_of_whole_numbers(text, value):
    node, view = at(f"void h() {{ g({text}); }}", "g")
    assert whole_quotient(arguments(call_at(node))[0], view) == value
