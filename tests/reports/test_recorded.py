"""The tables that are kept agree with the cases, and the page is made of them."""

import pytest

from reports.page import PAGE, page
from reports.recorded import LATEST, RESULTS, Table, keep, tables
from reports.report_case import ROUNDS, rebuilt
from reports.scoring import Score

BASELINE = {"first": "639fe4fc", "second": "639fe4fc", "third": "3ac20e7f", "fourth": "7780a44e"}
"""The revision that the reports were rebuilt on, before anything was changed for them."""


def test_the_page_is_that_of_the_tables():
    assert PAGE.read_text("utf-8") == page()


@pytest.mark.parametrize("name", ROUNDS)
def test_tables_have_every_case_and_no_other(name):
    cases = {one.name: bool(one.case.bad) for one in rebuilt(name)}
    kept = tables(name)
    assert kept[0].revision == BASELINE[name]
    for table in kept:
        assert {one.name: one.verdict is not None for one in table.scores} == cases, table.revision
        for one in table.scores:
            assert bool(one.by) == (one.verdict not in (None, "silent")), one.name


def test_tables_are_named_by_their_revision():
    for path in RESULTS.glob("*/*.json"):
        assert path.parent.name in ROUNDS
        revisions = [one.revision for one in tables(path.parent.name)]
        assert path.stem == LATEST or path.stem in revisions


def test_the_latest_table_comes_last(tmp_path):
    def table(revision, date):
        return Table(revision, date, [Score("01-a", "told", "x", [])])

    keep("first", LATEST, table("c", "2026-01-01"), tmp_path)
    keep("first", "b", table("b", "2026-03-01"), tmp_path)
    keep("first", "a", table("a", "2026-02-01"), tmp_path)
    assert [one.revision for one in tables("first", tmp_path)] == ["a", "b", "c"]
    assert tables("second", tmp_path) == []


def test_a_file_that_is_no_table_is_named(tmp_path):
    (tmp_path / "first").mkdir()
    (tmp_path / "first" / "a.json").write_text("{}")
    with pytest.raises(ValueError, match=r"a\.json"):
        tables("first", tmp_path)


def test_a_table_of_no_round_is_refused(tmp_path):
    with pytest.raises(ValueError, match="fifth"):
        keep("fifth", "a", Table("a", "", []), tmp_path)
