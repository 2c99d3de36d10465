"""Columns: way-points of long edges, shared by those of one end; fewer crossings than before."""

from __future__ import annotations

from roslens.dashboard.layout.order import route, untangle


def test_an_edge_to_the_next_column_needs_no_way_point() -> None:
    columns = route([[0], [1]], 2, [(1, 0)])
    assert columns.columns == [[0], [1]]
    assert columns.ways == [[0, 1]]
    assert columns.right[0] == [1]
    assert columns.left[1] == [0]


def test_a_long_edge_passes_each_column_between() -> None:
    columns = route([[0], [1], [2], [3]], 4, [(3, 0)])
    (way,) = columns.ways
    assert way[0] == 0
    assert way[-1] == 3
    assert [columns.columns[number][-1] for number in (1, 2)] == way[1:-1]


def test_what_one_needs_from_afar_makes_one_line() -> None:
    columns = route([[0, 1, 2, 3], [4], [5]], 6, [(5, needed) for needed in range(4)])
    assert {way[1] for way in columns.ways} == {6}
    assert columns.columns[1] == [4, 6]
    assert columns.left[6] == [0, 1, 2, 3]
    assert columns.right[6] == [5]


def test_what_many_need_from_afar_makes_one_line_too() -> None:
    columns = route([[0], [1], [2, 3, 4]], 5, [(dependent, 0) for dependent in (2, 3, 4)])
    assert columns.left[5] == [0]
    assert columns.right[5] == [2, 3, 4]


def test_two_crossing_edges_are_untangled() -> None:
    columns = route([[0, 1], [2, 3]], 4, [(2, 1), (3, 0)])
    first, second = untangle(columns)
    assert (first.index(0) < first.index(1)) == (second.index(3) < second.index(2))


def test_an_order_without_crossings_stays() -> None:
    columns = route([[0, 1], [2, 3]], 4, [(2, 0), (3, 1)])
    assert untangle(columns) == [[0, 1], [2, 3]]
