"""Numbers and texts of Python, and text put together in place."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.ir.program import Call, Format, Literal, Mapping, Name
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.lowering.python.python_program_literals import braces, joined, number, percent, unescape


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("1", 1), ("0b11", 3), ("0o17", 15), ("0777", 511), ("10L", 10), ("1.5e3", 1500.0), ("1_0.5", 10.5), ("0", 0),
        ("1e999", None), ("2j", None), ("9" * 5000, None), (str(2**63), None), (str(2**63 - 1), 2**63 - 1),
    ],
)  # fmt: skip
def test_number(written, expected):
    assert number(written) == expected


@pytest.mark.parametrize(
    "written",
    [
        "'a'", '"a"', "'''a\n'b'''", '"""a"""', "''", '""""""', r"'a\tb\'\x41é\u20ac\\'", r"r'\d\n'", "'a\\\nb'",
        r"'\q'", r"'\101'", r"'\N{BULLET}'", "b'a'", "u'é'", "f'a'", "rb'\\d'",
    ],
)  # fmt: skip
def test_texts_are_as_python_reads_them(written):
    expected = eval(written) if "\\q" not in written else "\\q"
    if isinstance(expected, bytes):
        expected = expected.decode()
    assert program_of_python(f"v = {written}\n".encode()).body[0].value == Literal(expected)


@given(st.text(st.characters(exclude_categories=("Cs",), exclude_characters="\0"), max_size=40))
def test_any_text_comes_back(text):
    assert program_of_python(f"v = {text!r}\n".encode()).body[0].value == Literal(text)


def test_what_is_no_character_stays_readable():
    assert unescape(r"\ud800") == r"\ud800"
    assert unescape(r"\Uffffffff") == r"\Uffffffff"


def test_joined():
    assert joined([]) == Literal("")
    assert joined([Literal("a"), Literal("b")]) == Literal("ab")
    assert joined([Literal(1)]) == Format((Literal(1),))
    assert joined([Literal("a"), Literal(""), Name("x"), Literal("b")]) == Format(
        (Literal("a"), Name("x"), Literal("b"))
    )


@given(
    st.integers(-(10**9), 10**9),
    st.sampled_from(["%d", "%3d", "%-5d|", "%05d", "%+d", "% d", "%x", "%#x", "%i%%", "%s"]),
)
def test_percent_is_what_python_puts(value, template):
    assert evaluated(percent(template, Literal(value), None)) == template % value


@given(st.floats(-1e6, 1e6), st.sampled_from(["%.2f", "%8.3f", "%e", "%g", "%.f", "%08.2f", "%d", "%s", "%r"]))
def test_percent_of_fractions(value, template):
    assert evaluated(percent(template, Literal(value), None)) == template % value


@given(st.text("abc", max_size=5), st.sampled_from(["%s", "%5s", "%-5s|", "%.2s", "%r", "a%sb"]))
def test_percent_of_texts(value, template):
    assert evaluated(percent(template, Literal(value), None)) == template % value


@given(st.integers(0, 99), st.sampled_from(["{}", "{0}/{0}", "{:03d}", "{!r}", "{{{}}}", "a{:>5}b"]))
def test_braces_are_what_python_puts(value, template):
    assert evaluated(braces(template, [Literal(value)], {})) == template.format(value)


def evaluated(expression) -> str:
    """Return the text that an expression of literals is."""
    if isinstance(expression, Literal):
        return str(expression.value)
    if isinstance(expression, Format):
        return "".join(map(evaluated, expression.parts))
    assert isinstance(expression, Call)
    values = [one.value if isinstance(one, Literal) else evaluated(one) for one in expression.arguments]
    return str({"repr": repr, "int": int, "format": format}[expression.function.name](*values))


@pytest.mark.parametrize(
    ("template", "items"),
    [("%s %s", (Literal(1),)), ("%s", (Literal(1), Literal(2))), ("%*d", (Literal(1), Literal(2))), ("50% off", ())],
)
def test_what_does_not_fit_is_left_alone(template, items):
    assert percent(template, Name("x"), items) is None


@pytest.mark.parametrize("template", ["{", "}", "{1}", "{name}", "{:{}}", "{a b}"])
def test_braces_that_do_not_fit_are_left_alone(template):
    assert braces(template, [Literal(1)], {}) is None


def test_percent_by_name():
    mapping = Mapping(((Literal("a"), Name("x")),))
    assert percent("%(a)s!", mapping, None) == Format((Name("x"), Literal("!")))
    assert percent("%(a)s %s", mapping, None) is None
