"""Where packages stand, as text and tables."""

import csv
import json

import pytest

from roslens.judge.quality.field import Distribution, Field
from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.model.result import PackageSummary
from roslens.report.study.standings import standings_csv, standings_json, standings_of, standings_text

PACKAGE = EntityKind.PACKAGE
QUANTITIES = (
    Quantity("calls", "Calls", "calls", (EntityKind.FUNCTION,), "t", folds=(Fold.MEAN, Fold.MAX)),
    Quantity("comments", "Comments", "%", (PACKAGE,), "t", better=Better.HIGHER),
    Quantity("loc", "Lines", "lines", (PACKAGE,), "t", better=Better.NEITHER),
    Quantity("new", "New", "", (PACKAGE,), "t"),
)
STEPS = tuple(map(float, range(0, 101, 10)))
FIELD = Field(
    "f", "2026-01-01", "1", 200, (),
    (
        *(Distribution(key, PACKAGE, 200, STEPS) for key in ("calls", "calls.max", "comments", "loc")),
        Distribution("loc", PACKAGE, 30, tuple(value / 2 for value in STEPS), "role=driver"),
        Distribution("comments", PACKAGE, 3, STEPS, "role=driver"),
    ),
)  # fmt: skip


@pytest.fixture
def found():
    summary = PackageSummary("p", "p", ".", values={"calls": 12, "calls.max": 95, "comments": 4, "loc": 45, "new": 1})
    return list(standings_of(summary, QUANTITIES, FIELD, ("role=driver", "language=")))


def test_each_quantity_with_its_folds_and_groups(found):
    assert [(one.quantity, [(a.group, a.percentile) for a in one.among], one.worse) for one in found] == [
        ("calls", [("", 12)], 12),
        ("calls.max", [("", 95)], 95),
        ("comments", [("", 4)], 96),
        ("loc", [("", 45), ("role=driver", 90)], None),
    ]


def test_text_has_what_is_unusual(found):
    assert standings_text(found, FIELD, complete=False).splitlines()[1:] == [
        "",
        "p",
        "! Calls, max  95 calls  95 of all (200)",
        "! Comments         4 %  4 of all (200)",
    ]
    assert "  Lines       45 lines  45 of all (200), 90 of driver (30)" in standings_text(found, FIELD, complete=True)
    assert standings_text(found[:1], FIELD, complete=False).splitlines()[2] == "nothing is unusual"
    assert standings_text([], FIELD, complete=True).splitlines()[2] == "no value that the field knows"


def test_tables(found):
    rows = list(csv.DictReader(standings_csv(found).splitlines()))
    assert rows[-1] == {
        "package": "p", "quantity": "loc", "value": "45", "group": "role=driver", "n": "30", "percentile": "90"
    }  # fmt: skip
    document = json.loads(standings_json(found, FIELD))
    assert document["field"] == {"name": "f", "day": "2026-01-01", "packages": 200, "repositories": 0}
    assert [one["quantity"] for one in document["standings"]] == ["calls", "calls.max", "comments", "loc"]
