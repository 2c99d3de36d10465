"""What the reference says of the store holds."""

import re
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from roslens.store.runs import Store

PAGE = (Path(__file__).parents[2] / "docs" / "reference" / "store.md").read_text("utf-8")
QUERIES = re.findall(r"```sql\n(.*?)```", PAGE, re.DOTALL)
VIEWS = dict(re.findall(r"^\| `(\w+)` \| `([\w, ]+)` \|$", PAGE, re.MULTILINE))


@pytest.fixture
def connection(tmp_path, write_small):
    path = tmp_path / "store.sqlite"
    with Store.open(path) as store:
        write_small(store)
        write_small(store, "key-2")
    with closing(sqlite3.connect(path)) as connection:
        yield connection


def test_the_page_has_what_is_tested():
    assert len(QUERIES) == 4
    assert len(VIEWS) == 7


@pytest.mark.parametrize("query", QUERIES, ids=range(len(QUERIES)))
def test_the_queries_run(connection, query):
    rows = connection.execute(query).fetchall()
    assert bool(rows) is ("NOT IN" not in query)


@pytest.mark.parametrize("view", VIEWS)
def test_the_views_have_the_columns(connection, view):
    found = [column[0] for column in connection.execute(f"SELECT * FROM {view}").description]
    assert found == VIEWS[view].split(", ")


def test_every_view_is_told_of(connection):
    views = connection.execute("SELECT name FROM sqlite_master WHERE type = 'view'").fetchall()
    assert {name for (name,) in views} == set(VIEWS)
