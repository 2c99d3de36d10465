"""Which pages there are, and where facts lead."""

from __future__ import annotations

from types import ModuleType

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import Book
from roslens.dashboard.computation.system import systems_of
from roslens.model.configuration import Proof


def test_every_page_is_named_once_and_found(made_up: ModuleType) -> None:
    book = Book(systems_of({"one": made_up.robot(), "two": made_up.robot()}))
    refs = list(book.refs())
    assert len(refs) == len(set(refs))
    assert [ref.key for ref in refs[:2]] == ["one", "two"]
    assert all(book.find(ref.page, ref.key) for ref in refs[2:])
    assert not [ref for ref in refs if ref.key.endswith("set_parameters")]


def test_a_place_leads_to_its_line_where_the_report_has_the_file() -> None:
    book = Book({}, lambda path: path == "a.cpp")
    assert book.place(Proof("a.cpp", 3)).ref == PageRef("file", "a.cpp", anchor="L3")
    assert book.place(Proof("b.cpp", 3)).ref is None
    assert book.place(Proof("b.cpp", 3)).value == "b.cpp:3"
    assert book.place(None).value == ""
