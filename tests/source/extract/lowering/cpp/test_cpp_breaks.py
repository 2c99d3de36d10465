import pytest

from roslens.source.extract.symbolic.condition import as_written

PUB = "create_publisher<std_msgs::msg::String>({}, 1);"


def said(node_of, body: str) -> dict[str, tuple[str, ...]]:
    return {str(one.name): as_written(one.conditions) for one in node_of(body).endpoints}


def test_what_follows_a_break_under_a_condition_is_made_where_it_does_not_hold(node_of):
    body = f"switch (2) {{ case 2: {{ if (ask(1)) {{ break; }}\n{PUB.format(chr(34) + 'a' + chr(34))}\nbreak; }} }}"
    assert said(node_of, body) == {"a": ("not ask(1)",)}


def test_the_next_case_follows_only_where_no_break_was_reached(node_of):
    a, b = PUB.format('"a"'), PUB.format('"b"')
    body = f"switch (2) {{ case 2: if (ask(1)) {{ {a}\nbreak; }} case 3: {b} }}"
    assert said(node_of, body) == {"a": ("ask(1)",), "b": ("not ask(1)",)}


def test_a_break_in_a_condition_within_another_one(node_of):
    a, b = PUB.format('"a"'), PUB.format('"b"')
    body = f"switch (2) {{ case 2: if (on()) {{ if (off()) {{ break; }}\n{a} }}\n{b}\nbreak; default: break; }}"
    found = said(node_of, body)
    assert found["a"] == ("on()", "not off()")
    assert found["b"] == ("not off() or not on()",)


@pytest.mark.parametrize("inner", ["for (;;) { if (ask(1)) { break; } }", "while (ask(2)) { break; }"])
def test_a_break_of_a_loop_in_a_case_is_the_loops(node_of, inner: str):
    a = PUB.format('"a"')
    assert said(node_of, f"switch (2) {{ case 2: {inner}\n{a}\nbreak; }}") == {"a": ()}


def test_continue_in_a_case_is_of_the_loop_around(node_of):
    a, b = PUB.format('"a"'), PUB.format('"b"')
    choice = f"switch (number()) {{ case 2: if (ask(1)) {{ continue; }}\n{a}\nbreak; }}"
    body = f"for (int i = 0; i < 2; ++i) {{ {choice}\n{b} }}"
    assert said(node_of, body) == {"a": ("number() == 2", "not ask(1)"), "b": ("not (number() == 2 and ask(1))",)}


def test_many_breaks_do_not_multiply_what_follows(node_of):
    a = PUB.format('"a"')
    many = "".join(f"if (one({n})) {{ if (two({n})) {{ break; }}\nuse({n}); }}\n" for n in range(40))
    assert set(said(node_of, f"switch (2) {{ case 2: {many}{a}\nbreak; }}")) == {"a"}
