import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.lowering.cpp.cpp_literals import number_value, text_value


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ('"a"', "a"),
        ('""', ""),
        (r'"\n\t\\\"\0"', '\n\t\\"\0'),
        (r'"\x41\101\u00e4\U0001F600"', "AAä😀"),
        (r'"\ud800\UFFFFFFFF"', "\ufffd\ufffd"),
        ('"a\\\nb"', "ab"),
        (r'"\q"', "q"),
        ('u8"a"', "a"),
        ("L'c'", "c"),
        ('R"(a\\n)"', "a\\n"),
        ('LR"x(a)")x"', 'a)"'),
        ('R"x(a)"', 'R"x(a)"'),
        ('"', '"'),
        ("", ""),
        ("a", "a"),
    ],
)
def test_texts(written: str, value: str) -> None:
    assert text_value(written) == value


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("0", 0),
        ("10u", 10),
        ("1'000'000ULL", 1_000_000),
        ("0x1Fu", 31),
        ("0b101", 5),
        ("017", 15),
        ("08", None),
        ("-3", -3),
        ("+ 3", 3),
        ("1.5f", 1.5),
        (".5", 0.5),
        ("1.", 1.0),
        ("1e-3L", 0.001),
        ("0x1p3", 8.0),
        ("0x1.8p1f", 3.0),
        ("0xg", None),
        ("", None),
        ("x", None),
        ("1" * 1000, None),
    ],
)
def test_numbers(written: str, value: float | None) -> None:
    found = number_value(written)
    assert found == value
    assert type(found) is type(value)


@given(st.text(alphabet="abäß \u2028😀", max_size=20))
def test_a_text_without_escapes_is_itself(text: str) -> None:
    assert text_value(f'"{text}"') == text


@given(st.integers(-(10**18), 10**18))
def test_whole_numbers_in_any_base(number: int) -> None:
    assert number_value(str(number)) == number
    assert number_value(hex(number)) == number
    assert number_value(bin(number)) == number


@given(st.text(max_size=20))
def test_anything_has_a_value_or_none(text: str) -> None:
    assert isinstance(text_value(text), str)
    number_value(text)
