"""Expressions of Python, one by one."""

import pytest

from roslens.source.extract.ir.program import Assign, Call, Evaluate, Expression, Member, Name, Opaque
from roslens.source.extract.ir.program_text import expression_text, program_text
from roslens.source.extract.lowering.python.python_program import program_of_python


def value_of(written: str) -> Expression:
    """Return what ``v = written`` assigns."""
    last = program_of_python(f"v = {written}\n".encode()).body[-1]
    assert isinstance(last, Assign)
    assert last.target == Name("v")
    assert last.value is not None
    return last.value


def body_of(written: str) -> str:
    """Return the statements of a module as text."""
    _, _, body = program_text(program_of_python(written.encode())).partition("body\n")
    return "\n".join(line[2:] for line in body.splitlines())


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("a", "a"),
        ("a.b.c", "a->b->c"),
        ("a . b", "a->b"),
        ("f(x).y", "f(x)->y"),
        ("a[0].b", "a[0]->b"),
        ("a['k']", 'a["k"]'),
        ("a[-1]", "a[-1]"),
        ("a[1, 2]", "a[[1, 2]]"),
        ("a[1:2]", "a[`1:2`]"),
        ("1 if x else 2", "(x ? 1 : 2)"),
        ("not a", "(not a)"),
        ("a and b or c", "((a and b) or c)"),
        ("a is not None", "(a != null)"),
        ("a is b", "(a == b)"),
        ("a not in b", "(not (a in b))"),
        ("a in b", "(a in b)"),
        ("1 < a <= 3", "((1 < a) and (a <= 3))"),
        ("a + b - c", "((a + b) - c)"),
        ("-a", "(- a)"),
        ("+a", "a"),
        ("-1.5", "-1.5"),
        ("~a", "`~a`"),
        ("a // b", "`a // b`"),
        ("a | b", "`a | b`"),
        ("a << 2", "(a << 2)"),
        ("(a)", "a"),
        ("( # why\n a)", "a"),
        ("[1, 'a', x]", '[1, "a", x]'),
        ("(1,)", "[1]"),
        ("1, 2", "[1, 2]"),
        ("{1, 2}", "[1, 2]"),
        ("{'a': 1, **b}", '{"a": 1, `**`: b}'),
        ("f(a, *b, c=1, **d)", "f(a, `*b`, *=b, c=1, **=d)"),
        ("f (a , # why\n b)", "f(a, b)"),
        ("await f()", "f()"),
        ("...", "`...`"),
        ("True", "true"),
        ("None", "null"),
        ("1j", "`1j`"),
        ("1_000", "1000"),
        ("0x10", "16"),
        ("99999999999999999999", "`99999999999999999999`"),
        ("1e999", "`1e999`"),
        ("f'/{a}/b'", 'format["/", a, "/b"]'),
        ("f'{{{a.b}}}'", 'format["{", a->b, "}"]'),
        ("f'{a:02d}'", 'format[format(a, "02d")]'),
        ("f'{a:{w}}'", "format[`{a:{w}}`]"),
        ("f'{a=}'", "format[`{a=}`]"),
        ("f'a' 'b' f'{c}d'", 'format["ab", c, "d"]'),
        ("'a' 'b'", '"ab"'),
        ("'/%s/%s' % (a, b)", 'format["/", a, "/", b]'),
        ("'/%s' % a", 'format["/", a]'),
        ("'%s/%s' % a", '("%s/%s" % a)'),
        ("a % b", "(a % b)"),
        ("'%(x)s' % {'x': y}", "format[y]"),
        ("'%(x)s' % locals()", 'format[locals()["x"]]'),
        ("'%s' % [a]", "format[[a]]"),
        ("'{}/{n}'.format(a, n=b)", 'format[a, "/", b]'),
        ("'{}'.format(*a)", '"{}"->format(`*a`, *=a)'),
        ("'{0.x[k]}'.format(a)", 'format[a->x["k"]]'),
        ("'/a/b'.split('/')", '"/a/b"->split("/")'),
        ("'/'.join(['a', b])", '"/"->join(["a", b])'),
    ],
)
def test_expression(written, expected):
    assert expression_text(value_of(written)) == expected


def test_place_of_a_call():
    program = program_of_python(b"x = 1\nif x:\n    a.b(c)\n")
    branch = program.body[1]
    assert branch.then == (Evaluate(Call(Member(Name("a"), "b"), (Name("c"),), (), (), 3, 5), 3),)


def test_comprehensions_are_loops():
    assert body_of("v = [f(t, u) for t in a if t for u in t]").splitlines() == [
        "#1 = []",
        "for t#1 in a:",
        "  if t#1:",
        "    for u#1 in t#1:",
        "      #1 += [f(t#1, u#1)]",
        "v = #1",
    ]
    assert body_of("v = {k: f(k) for k, w in a.items()}").splitlines() == [
        "#1 = {}",
        "for [k#1, w#1] in a->items():",
        "  #1[k#1] = f(k#1)",
        "v = #1",
    ]


def test_variables_of_a_comprehension_are_its_own():
    assert body_of("t = 1\nf(g(t) for t in t)\nh(t)").splitlines() == [
        "t = 1",
        "#1 = []",
        "for t#1 in t:",
        "  #1 += [g(t#1)]",
        "f(#1)",
        "h(t)",
    ]


def test_a_parameter_hides_a_variable_of_a_comprehension():
    program = program_of_python(b"v = [lambda t: t for t in a]")
    assert "return t\n" in program_text(program)


def test_calls_in_something_opaque_are_kept():
    assert body_of("v = f(a) | b").splitlines() == ["f(a)", "v = `f(a) | b`"]
    assert body_of("x = yield f(a)").splitlines() == ["f(a)", "x = `yield f(a)`"]


def test_what_is_unpacked_is_opaque():
    assert body_of("v = [*a.b(c).d(1)]").splitlines() == ["a->b(c)->d(1)", "v = [`*a.b(c).d(1)`]"]
    assert body_of("f(*a.b(c))").splitlines() == ["a->b(c)", "f(`*a.b(c)`, *=`*a.b(c)`)"]
    assert program_of_python(b"f(*a.b(c))").body[0].expression.column == 4


def test_walrus():
    assert body_of("if (n := f()) > 1: g(n)").splitlines() == ["n = f()", "if (n > 1):", "  g(n)"]


def test_lambda_with_default():
    program = program_of_python(b"f(lambda a, b=g(1), *c: a + b)")
    assert program_text(program).splitlines() == [
        "function#0 lambda(a, b = g(1), *c)",
        "  return (a + b)",
        "body",
        "  f(lambda#0)",
    ]


def test_opaque_text_is_short_and_on_one_line():
    value = value_of("(a |\n   " + "b" * 100 + ")")
    assert isinstance(value, Opaque)
    assert value.text.startswith("a | bbb")
    assert len(value.text) == 80
