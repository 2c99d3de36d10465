import pytest

from roslens.model.edit import Edit, edit_at, place_of


@pytest.mark.parametrize(
    ("content", "at", "place"),
    [
        (b"a\nbc", 3, (2, 2)),
        ("// é 🤖 x".encode(), 11, (1, 9)),
        (b"\xef\xbb\xbfint a;", 7, (1, 5)),
        ("// é x".encode("latin-1"), 5, (1, 6)),
    ],
)
def test_columns_are_those_of_editors(content, at, place):
    assert place_of(content, at) == place


def test_an_edit_knows_its_place():
    content = "é\nint a;\n".encode()
    assert edit_at(content, 3, 6, "long", "a.cpp") == Edit("a.cpp", 3, 6, "long", 2, 1, 2, 4)
    assert edit_at(content, 3, 3, "x") == Edit("", 3, 3, "x", 2, 1, 2, 1)
    assert edit_at(content, 0, 3, "").end_line == 2
