"""Key figures against the standard library's, over all and by group."""

import statistics

import pytest

from roslens.model.study import Column, Corpus, Subject
from roslens.source.study.describe import describe
from roslens.source.study.measurements import measurements, write_measurements

VALUES = {"a": (1, 2, 3, 4), "b": (10,), "": (7, 8)}


@pytest.fixture
def corpus():
    packages = [
        Subject(f"{role}{number}", "r", role, values={"q": float(value)})
        for role, values in VALUES.items()
        for number, value in enumerate(values)
    ]
    return Corpus("table", (), (Column("q", "q", minimum=2, maximum=8), Column("none", "none")), tuple(packages))


def test_figures_of_all(corpus):
    every = [value for values in VALUES.values() for value in values]
    with measurements(corpus) as connection:
        (one,) = describe(connection, corpus)
    assert (one.n, one.median, one.least, one.most) == (7, 4, 1, 10)
    assert one.mean == pytest.approx(statistics.fmean(every))
    assert one.deviation == pytest.approx(statistics.stdev(every))
    assert [one.lower, one.median, one.upper] == statistics.quantiles(every, n=4, method="inclusive")
    assert one.beyond == 2
    assert one.share_beyond == pytest.approx(2 / 7)


def test_figures_of_groups_leave_out_what_is_in_none(corpus):
    with measurements(corpus) as connection:
        found = describe(connection, corpus, "role")
        with pytest.raises(ValueError, match="colour"):
            describe(connection, corpus, "colour")
    assert [(one.group, one.n, one.median, one.deviation, one.beyond) for one in found] == [
        ("a", 4, 2.5, pytest.approx(statistics.stdev((1, 2, 3, 4))), 1),
        ("b", 1, 10, None, 1),
    ]


def test_every_measurement_is_written(corpus, tmp_path):
    duckdb = pytest.importorskip("duckdb")
    path = tmp_path / "it's.parquet"
    write_measurements(corpus, path)
    rows = duckdb.read_parquet(str(path)).fetchall()
    assert len(rows) == 7
    assert rows[-1] == ("package", "b0", "b", "", "r", "", "q", 10.0)
    assert [one.name for one in tmp_path.iterdir()] == [path.name]


def test_a_corpus_without_values_has_no_figures():
    empty = Corpus("table", (), (Column("q", "q"),), ())
    with measurements(empty) as connection:
        assert describe(connection, empty) == ()
