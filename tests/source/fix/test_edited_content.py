import pytest

from roslens.model.edit import Edit, edit_at
from roslens.source.fix.edited_content import EditError, edited


def at(content, what, text):
    start = content.index(what)
    return edit_at(content, start, start + len(what), text)


def test_what_is_beside_edits_stays():
    content = b"int a = NULL;\r\n\tint b;  \nint c = NULL"
    assert edited(content, [at(content, b"NULL", "nullptr"), at(content, b"int c", "long c")]) == (
        b"int a = nullptr;\r\n\tint b;  \nlong c = NULL"
    )


def test_insertions_at_one_place_stand_in_the_order_of_their_texts():
    content = b"<a/>\n"
    edits = [edit_at(content, 4, 4, "\n<c/>"), edit_at(content, 4, 4, "\n<b/>"), edit_at(content, 4, 4, "\n<c/>")]
    assert edited(content, edits) == edited(content, reversed(edits)) == b"<a/>\n<b/>\n<c/>\n"


def test_line_ends_are_those_of_the_file():
    content = b"a\r\nb\r\n"
    assert edited(content, [edit_at(content, 3, 3, "x\ny\r\n")]) == b"a\r\nx\r\ny\r\nb\r\n"


def test_nothing_is_written_before_a_byte_order_mark():
    content = b"\xef\xbb\xbfint a;\n"
    assert edited(content, [edit_at(content, 0, 0, "#pragma once\n")]) == b"\xef\xbb\xbf#pragma once\nint a;\n"


def test_another_encoding_stays_what_it_is():
    content = "// Größe\nint a = NULL;\n".encode("latin-1")
    assert edited(content, [at(content, b"NULL", "nullptr")]) == "// Größe\nint a = nullptr;\n".encode("latin-1")
    with pytest.raises(EditError, match="not UTF-8"):
        edited(content, [at(content, b"NULL", "größe")])


@pytest.mark.parametrize("edits", [[Edit("", 0, 9, "")], [Edit("", 0, 3, "x"), Edit("", 2, 4, "y")]])
def test_what_does_not_fit_is_refused(edits):
    with pytest.raises(EditError, match="does not fit"):
        edited(b"int a;\n", edits)
