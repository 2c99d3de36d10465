"""XML with the place of each element."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.workspace.elements import MAXIMUM_DEPTH, Element, read_elements


def everything(element: Element) -> list[Element]:
    return [element, *(inner for child in element.elements() for inner in everything(child))]


def test_each_element_knows_its_bytes() -> None:
    content = b'<?xml version="1.0"?>\n<a><b x=">"/><c></c><d><d/></d><e y="/"> </e>\xc3\xa4<f/></a>\n'
    document = read_elements(content)
    assert document.root is not None
    spans = [content[element.start : element.end] for element in everything(document.root)]
    assert spans[1:] == [b'<b x=">"/>', b"<c></c>", b"<d><d/></d>", b"<d/>", b'<e y="/"> </e>', b"<f/>"]
    assert spans[0] == content[22:-1]
    assert document.place(22) == (2, 1)
    assert document.faults == ()


def test_texts() -> None:
    root = read_elements(b"<a> x <b>y</b> &lt;<!-- no --><![CDATA[ <z> ]]></a>").root
    assert root is not None
    assert root.text() == "x  < <z>"
    assert root.full_text() == " x y < <z> "
    assert root.markup() == "x <b>y</b> &lt; &lt;z&gt;"


def test_a_comment_inside_an_empty_element_does_not_move_its_end() -> None:
    content = b"<a><b><!-- /></b> --></b><c><?p /?></c></a>"
    root = read_elements(content).root
    assert root is not None
    assert [content[child.start : child.end] for child in root.elements()] == [
        b"<b><!-- /></b> --></b>",
        b"<c><?p /?></c>",
    ]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "iso-8859-1", "cp1252"])
def test_encodings(encoding: str) -> None:
    name = {"utf-8-sig": "utf-8"}.get(encoding, encoding)
    content = f'<?xml version="1.0" encoding="{name}"?><a>Grüße</a>'.encode(encoding)
    document = read_elements(content)
    assert document.faults == ()
    assert document.root is not None
    assert document.root.text() == "Grüße"


@pytest.mark.parametrize(
    ("declared", "stored"), [("klingon", "utf-8"), ("shift_jis", "iso-8859-1"), ("utf-8", "cp1252")]
)
def test_an_encoding_that_cannot_be_read_is_told_and_guessed(declared: str, stored: str) -> None:
    document = read_elements(f'<?xml version="1.0" encoding="{declared}"?><a>Grüße</a>'.encode(stored))
    assert len(document.faults) == 1
    assert "it was read as" in document.faults[0].advice
    assert document.root is not None
    assert document.root.text() == "Grüße"


def test_depth_is_limited() -> None:
    document = read_elements(b"<a>" * 100_000)
    assert [fault.offset for fault in document.faults] == [3 * MAXIMUM_DEPTH]
    assert document.root is not None
    assert len(everything(document.root)) == MAXIMUM_DEPTH


def test_what_is_open_at_a_fault_ends_there() -> None:
    document = read_elements(b"<a><b>x</b><c>y</a>")
    assert document.root is not None
    assert [element.tag for element in everything(document.root)] == ["a", "b", "c"]
    assert document.root.end == document.faults[0].offset
    assert 'mismatched tag, at "' in document.faults[0].what


TAGS = st.sampled_from(("a", "b:c", "d-e", "ä"))
TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc", "Cn")), max_size=8)
ELEMENTS = st.recursive(
    st.builds(
        lambda tag, attributes: Element(tag, attributes, 0, 0, []), TAGS, st.dictionaries(TAGS, TEXTS, max_size=2)
    ),
    lambda inner: st.builds(
        lambda tag, children: Element(tag, {}, 0, 0, children), TAGS, st.lists(inner | TEXTS.filter(bool), max_size=4)
    ),
    max_leaves=8,
)


@given(element=ELEMENTS)
@settings(max_examples=150, deadline=None)
def test_what_is_written_is_read_back(element: Element) -> None:
    written = element.written()
    document = read_elements(written.encode())
    assert document.faults == ()
    assert document.root is not None
    assert document.root.written() == written
    for part in everything(document.root):
        assert written.encode()[part.start : part.end].decode() == part.written()
