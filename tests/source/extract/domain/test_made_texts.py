import pytest

from roslens.source.extract.domain.made_texts import text_made, with_sign
from roslens.source.extract.symbolic.text import Text


@pytest.mark.parametrize(
    ("name", "arguments", "text"),
    [
        ("str", [True], "True"),
        ("std.string", [Text.of("a")], "a"),
        ("std.to_string", [1.5], "1.500000"),
        ("std.to_string", [3], "3"),
        ("std.string", [3, Text.of("x")], "xxx"),
        ("std.string", [Text.of("abc"), 1, 1], "b"),
        ("std.string", [Text.of("abc"), 2], "*"),
        ("str", [Text.of("a"), Text.of("utf-8")], "a"),
    ],
)
def test_texts_are_made(name, arguments, text):
    assert text_made(name, arguments).pattern == text


def test_one_sign_for_another():
    assert with_sign(Text.of("abc"), 1, Text.of("x")) == Text.of("axc")
    assert with_sign(Text.of("abc"), 7, Text.of("x")).pattern == "*"
