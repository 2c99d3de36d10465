"""The severity of a finding is a table of its consequence and its certainty."""

import pytest

from roslens.model.weight.consequence import Certainty, Consequence, severity_of, supposed
from roslens.model.weight.severity import Severity

NOTE, WARNING, ERROR = Severity.NOTE, Severity.WARNING, Severity.ERROR
TABLE = {
    "stops the build": (ERROR, WARNING, WARNING),
    "stops the start": (ERROR, WARNING, WARNING),
    "wrong at run time": (ERROR, WARNING, WARNING),
    "may be wrong at run time": (WARNING, WARNING, NOTE),
    "hard to maintain": (WARNING, NOTE, NOTE),
    "style": (NOTE, NOTE, NOTE),
}
CELLS = [
    (consequence, certainty, severity)
    for consequence, row in TABLE.items()
    for certainty, severity in zip(("proven", "likely", "heuristic"), row, strict=True)
]


def test_all_cells_are_here():
    assert [one.value for one in Consequence] == list(TABLE)
    assert [one.value for one in Certainty] == ["proven", "likely", "heuristic"]
    assert len(CELLS) == 18


@pytest.mark.parametrize(("consequence", "certainty", "severity"), CELLS)
def test_a_cell(consequence, certainty, severity):
    assert severity_of(Consequence(consequence), Certainty(certainty)) is severity


@pytest.mark.parametrize(("consequence", "certainty", "severity"), CELLS)
def test_what_nobody_confirmed_is_a_note_where_it_is_heuristic(consequence, certainty, severity):
    expected = NOTE if certainty == "heuristic" else severity
    assert severity_of(Consequence(consequence), Certainty(certainty), unproven=True) is expected


def test_only_what_is_proven_is_an_error():
    errors = {certainty for _consequence, certainty, severity in CELLS if severity is ERROR}
    assert errors == {"proven"}


@pytest.mark.parametrize("severity", Severity)
def test_what_is_supposed_keeps_the_severity(severity):
    assert severity_of(*supposed(severity)) is severity


def test_they_are_ordered_from_worst_to_mildest():
    assert sorted(Consequence, key=lambda one: -one.rank) == list(Consequence)
    assert sorted(Certainty, key=lambda one: -one.rank) == list(Certainty)


def test_what_stops_or_misleads_the_robot_is_grave():
    assert [one.value for one in Consequence if one.grave] == [
        "stops the build", "stops the start", "wrong at run time",
    ]  # fmt: skip
