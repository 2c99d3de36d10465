from __future__ import annotations

import msgspec
import pytest

from roslens.model.entity import Entity, EntityId, EntityKind
from roslens.source.metrics.measure_file import measure_file
from roslens.source.metrics.table import QUANTITIES
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FileFacts, Halstead, Lines, SyntaxFault

LINES = Lines(10, 6, 3, 1)
COUNTS = Halstead(6, 4, 6, 8)


@pytest.fixture
def measure(function_of):
    def measure(*functions, syntax="cpp", counting=None, **facts):
        made = [function_of(lines=LINES, halstead=COUNTS, **one) for one in functions]
        whole = FileFacts(syntax, Lines(30, 20, 6, 4), COUNTS, functions=tuple(made), **facts)
        return measure_file("pkg/src/a.cpp", whole, counting or CountingSettings())

    return measure


def test_the_file_comes_first_then_its_functions(measure):
    file, first, second = measure(
        {"name": "b", "qualified_name": "n::b", "signature": "(int)", "line": 3, "end_line": 5},
        {"name": "a", "qualified_name": "n::a", "signature": "", "approximate": True},
    )
    assert (file.id, file.kind, file.name, file.path) == (
        "file:pkg/src/a.cpp",
        EntityKind.FILE,
        "a.cpp",
        "pkg/src/a.cpp",
    )
    assert first.id == "function:pkg/src/a.cpp#n::b(int)"
    assert (first.name, first.line, first.end_line, first.parent) == ("n::b", 3, 5, file.id)
    assert (first.approximate, second.approximate) == (False, True)
    assert second.id == "function:pkg/src/a.cpp#n::a()"
    assert EntityId.parse(first.id) == EntityId(EntityKind.FUNCTION, "pkg/src/a.cpp#n::b(int)")


def test_the_same_name_again_is_numbered(measure):
    ids = [entity.id.partition("#")[2] for entity in measure({}, {}, {"signature": "(int)"}, {})[1:]]
    assert ids == ["f()", "f()~2", "f(int)", "f()~3"]


def test_every_quantity_of_functions_is_measured_within_its_bounds(measure):
    values = measure({"control": "if\n  for"})[1].values
    assert values.keys() == {key for key, one in QUANTITIES.items() if EntityKind.FUNCTION in one.kinds}
    for key, value in values.items():
        quantity = QUANTITIES[key]
        assert quantity.minimum <= value
        assert quantity.maximum is None or value <= quantity.maximum


def test_what_is_measured_of_functions_goes_up_to_the_file(measure):
    values = measure({"control": "if"}, {"control": "if\nif\nif"}, {})[0].values
    assert values["cyclomatic_complexity"] == (2 + 4 + 1) / 3
    assert values["cyclomatic_complexity.max"] == 4
    assert values["functions"] == 3
    assert values["loc"] == 20
    assert values["comment_ratio"] == 30
    assert values["maintainability_index"] > 0


def test_a_file_without_functions_has_no_values_of_functions(measure):
    values = measure()[0].values
    assert values["functions"] == 0
    assert "cyclomatic_complexity" not in values
    assert "duplication_ratio" not in values


def test_an_empty_file_is_measured():
    values = measure_file("a.py", FileFacts("python", Lines()), CountingSettings())[0].values
    assert values["loc"] == values["halstead_volume"] == 0
    assert "comment_ratio" not in values
    assert "maintainability_index" not in values


def test_a_fault_makes_the_file_approximate(measure):
    assert measure(faults=(SyntaxFault(1, 1, 1, "}"),))[0].approximate
    assert not measure()[0].approximate


def test_python_reads_cases_as_arms(measure):
    control = "switch\n  case\n  case\n    return"
    assert measure({"control": control}, syntax="python")[1].values["static_paths"] == 3
    assert measure({"control": control}, syntax="cpp")[1].values["static_paths"] == 2


def test_options_reach_the_metrics(measure):
    function = {"control": "lambda\n  if"}
    assert measure(function)[1].values["cyclomatic_complexity"] == 2
    counting = CountingSettings(lambdas=False)
    assert measure(function, counting=counting)[1].values["cyclomatic_complexity"] == 1


def test_what_is_measured_is_what_is_read_back(measure):
    measured = measure({"control": "if"}, {})
    read_back = msgspec.json.decode(msgspec.json.encode(measured), type=tuple[Entity, ...])
    assert msgspec.json.encode(read_back) == msgspec.json.encode(measured)
