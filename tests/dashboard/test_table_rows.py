"""Rows as HTML: everything escaped, signs with words, links where there is a page."""

from __future__ import annotations

from roslens.dashboard.address import PageRef
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.dashboard.tables.table_rows import rows_html, ticks

HOSTILE = "<img src=x onerror=alert(1)>'\"&"


def rows(column: Column, *cells: Cell, link: str = "/there") -> str:
    table = Table("t", "T", (Column("first", "First"), column), tuple((Cell("x"), cell) for cell in cells))
    return str(rows_html(table, lambda ref: link))


def test_text_is_escaped_wherever_it_stands() -> None:
    column = Column("c", "C")
    for cell in (
        Cell(HOSTILE),
        Cell(1, text=HOSTILE),
        Cell("x", hint=HOSTILE),
        Cell("x", refs=((HOSTILE, PageRef("rules")),)),
    ):
        assert "<img" not in rows(column, cell)
    assert "<img" not in rows(Column("c", "C", "code"), Cell(HOSTILE))
    assert "<img" not in rows(column, Cell("x", ref=PageRef("rules")), link=f'"{HOSTILE}')
    table = Table("t", "T", (column,), ((Cell("x"),),), identities=(HOSTILE,))
    assert "<img" not in rows_html(table, lambda _: "")


def test_a_cell_links_only_to_a_page_that_is_there() -> None:
    cell = Cell("amcl", ref=PageRef("package", "amcl"))
    assert '<a href="/there">amcl</a>' in rows(Column("c", "C"), cell)
    assert "<a" not in rows(Column("c", "C"), cell, link="")


def test_a_rating_is_sign_and_word() -> None:
    found = rows(Column("c", "C", "number"), Cell(12, rating="high"))
    assert "#g-high" in found
    assert '<span class="sr">high</span>' in found


def test_bars_are_shares_of_the_most() -> None:
    found = rows(Column("c", "C", "number", bar=True), Cell(5), Cell(10), Cell(0), Cell(None))
    assert 'width="50.0%"' in found
    assert 'width="100.0%"' in found
    assert found.count("<rect") == 2


def test_what_stands_between_backticks_is_code() -> None:
    assert ticks("use `a<b>` here") == "use <code>a&lt;b&gt;</code> here"
    assert ticks("one ` alone <b>") == "one ` alone &lt;b&gt;"
    assert ticks("plain") == "plain"
    assert ticks("47 calls (limit 10, 4.7 x)") == "47 calls (limit 10, 4.7\N{NO-BREAK SPACE}x)"


def test_a_name_does_not_break_after_the_slash_that_it_begins_with() -> None:
    assert ">/scan<" in rows(Column("c", "C", "name"), Cell("/scan"))
    assert ">/amcl/<wbr>pose<" in rows(Column("c", "C", "name"), Cell("/amcl/pose", ref=PageRef("rules")))
    assert "of /odom<" in rows(Column("c", "C", "name"), Cell("publisher /a of /odom"))


def test_cells_of_rows_with_several_places_carry_the_heads_of_their_columns_too() -> None:
    columns = (
        Column("p", "Period", "number", unit="s"),
        Column("c", "Callback", "code"),
        Column("a", "Made at", "code"),
    )
    found = str(rows_html(Table("t", "T", columns, ((Cell(0.1), Cell("x"), Cell("y")),)), lambda _: ""))
    assert [f'data-label="{label}"' in found for label in ("Period (s)", "Callback", "Made at")] == [True] * 3


def test_cells_beside_whole_sentences_carry_the_heads_of_their_columns() -> None:
    columns = (
        Column("a", "Severity", "mark"),
        Column("b", "What"),
        Column("c", HOSTILE, "code"),
        Column("d", "Why", "prose"),
    )
    cells = (Cell("note"), Cell("x"), Cell("y"), Cell("z"))
    found = str(rows_html(Table("t", "T", columns, (cells,)), lambda _: ""))
    assert found.count("data-label") == 1
    assert "<img" not in found
    assert "data-label" not in str(rows_html(Table("t", "T", columns[:3], (cells[:3],)), lambda _: ""))
