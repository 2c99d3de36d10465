import pytest

from roslens.source.extract.ir.program_text import expression_text
from roslens.source.extract.lowering.cpp.cpp_macros import is_registration, macro_value, registrations
from roslens.source.syntax.query.cpp_query import parse_tree


@pytest.mark.parametrize(
    ("written", "value"),
    [
        (b' "a" // comment', '"a"'),
        (b'"a" "b"', '"ab"'),
        (b'PREFIX "/b" SUFFIX', '(PREFIX + "/b" + SUFFIX)'),
        (b"10", "10"),
        (b"((-2.5))", "-2.5"),
        (b"0x1F", "31"),
        (b"true", "true"),
        (b"NULL", "null"),
        (b"a::B", "a.B"),
        (b"1 << 3", "`1 << 3`"),
        (b"do_it()", "`do_it()`"),
        (b"unsigned char", "`unsigned char`"),
        (b"(a) + (b)", "`(a) + (b)`"),
        (b'"a \\"b\\""', '"a \\"b\\""'),
    ],
)
def test_values_of_macros(written: bytes, value: str) -> None:
    found = macro_value(written)
    assert found is not None
    assert expression_text(found) == value


def test_an_empty_macro_has_no_value() -> None:
    assert macro_value(b"  /* nothing */ ") is None
    assert macro_value(b"()") is None


def test_registrations_with_their_places() -> None:
    content = (
        b"/* PLUGINLIB_EXPORT_CLASS(a::No, b::No) */\n"
        b'auto x = "PLUGINLIB_EXPORT_CLASS(a::No, b::No)";\n'
        b"  PLUGINLIB_EXPORT_CLASS(a::Yes,\n b::Yes)\n"
        b'PLUGINLIB_EXPORT_CLASS_WITH_NAME("a/name", a::Named, b::Named)\n'
    )
    found = list(registrations(content, parse_tree(content)))
    assert [(expression_text(one.expression), one.line) for one in found] == [
        ("PLUGINLIB_EXPORT_CLASS(a.Yes, b.Yes)", 3),
        ('PLUGINLIB_EXPORT_CLASS_WITH_NAME("a/name", a.Named, b.Named)', 5),
    ]
    assert is_registration(b"RCLCPP_COMPONENTS_REGISTER_NODE(a::B)")
    assert not is_registration(b"REGISTER(a::B)")
