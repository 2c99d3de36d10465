"""Measurements by column come back entity by entity."""

import sqlite3
from contextlib import closing

from hypothesis import given
from hypothesis import strategies as st

from roslens.model.entity import Entity, EntityKind
from roslens.store.columns import Columns, by_kind, measured_rows

KINDS = st.sampled_from([EntityKind.PACKAGE, EntityKind.FILE, EntityKind.FUNCTION, EntityKind.NODE])
NUMBERS = st.one_of(st.integers(-(2**63), 2**63 - 1), st.floats(allow_nan=False, allow_infinity=False))
VALUES = st.dictionaries(st.sampled_from("abcdef"), NUMBERS)


@given(st.lists(st.tuples(KINDS, VALUES), max_size=12))
def test_what_goes_in_comes_out(drawn):
    entities = by_kind(Entity(f"e{number}", kind, "", values=values) for number, (kind, values) in enumerate(drawn))
    rows = sorted(measured_rows(entities))
    columns = Columns(rows)
    for position, entity in enumerate(entities):
        assert columns.values(entity.kind.value, position) == entity.values


def test_kinds_stand_together_and_keep_their_order():
    order = [EntityKind.FUNCTION, EntityKind.FILE, EntityKind.CLASS, EntityKind.PACKAGE, EntityKind.FILE]
    entities = [Entity(str(number), kind, "") for number, kind in enumerate(order)]
    assert [entity.id for entity in by_kind(entities)] == ["3", "1", "4", "2", "0"]


def test_one_row_holds_one_quantity_of_a_kind():
    entities = by_kind(
        [
            Entity("p", EntityKind.PACKAGE, "", values={"loc": 9}),
            Entity("f", EntityKind.FUNCTION, "", values={"loc": 3, "calls": 1}),
            Entity("g", EntityKind.FUNCTION, "", values={"calls": 2.5}),
        ]
    )
    assert list(measured_rows(entities)) == [
        ("package", "loc", 0, "[9]"),
        ("function", "loc", 1, "[3,null]"),
        ("function", "calls", 1, "[1,2.5]"),
    ]


def test_sqlite_reads_a_column():
    ((_kind, _quantity, _first, text),) = measured_rows([Entity("p", EntityKind.PACKAGE, "", values={"a": 3})])
    with closing(sqlite3.connect(":memory:")) as connection:
        assert connection.execute("SELECT key, value FROM json_each(?)", (text,)).fetchall() == [(0, 3)]
