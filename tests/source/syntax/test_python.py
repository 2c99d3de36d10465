"""Facts of Python files: every construct has a file and the facts that were worked out for it by hand."""

import json
from collections import Counter
from pathlib import Path

import pytest

from roslens.source.syntax.facts import ClassFacts, Control, FileFacts, FunctionFacts
from roslens.source.syntax.python import parse_python

FIXTURES = Path(__file__).parents[2] / "fixtures" / "syntax" / "python"
CONSTRUCTS = sorted(path.name for path in FIXTURES.iterdir())


def _numbered(found):
    """Yield qualified names with ``~2`` behind the second of the same."""
    seen = Counter()
    for one in found:
        seen[one.qualified_name] += 1
        number = seen[one.qualified_name]
        yield (one.qualified_name if number == 1 else f"{one.qualified_name}~{number}"), one


def _as_written(value):
    """Turn facts into what a person writes down."""
    if isinstance(value, dict):
        return value
    return [list(one) if isinstance(one, tuple) else one for one in value] if isinstance(value, tuple) else value


def _drawn(control: tuple[Control, ...]) -> list[str]:
    return ["  " * one.depth + one.role + (" ?" if one.part == "condition" else "") for one in control]


def _of_function(facts: FunctionFacts, key: str):
    if key == "control":
        return _drawn(facts.control)
    if key == "lines":
        lines = facts.lines
        return [lines.physical, lines.code, lines.comment, lines.blank]
    return _as_written(getattr(facts, key))


def _of_class(facts: ClassFacts, key: str):
    if key == "fields":
        return [[field.name, list(field.types), field.access, field.static] for field in facts.fields]
    if key == "methods":
        return [method.name for method in facts.methods]
    return _as_written(getattr(facts, key))


def _expected(construct: str) -> dict:
    return json.loads((FIXTURES / construct / f"{construct}.json").read_text())


def _found(construct: str) -> FileFacts:
    return parse_python((FIXTURES / construct / f"{construct}.py").read_bytes())


@pytest.mark.parametrize("construct", CONSTRUCTS)
def test_functions(construct):
    expected = _expected(construct)["functions"]
    found = dict(_numbered(_found(construct).functions))
    assert list(found) == list(expected)
    for name, facts in expected.items():
        assert {key: _of_function(found[name], key) for key in facts} == facts, name


@pytest.mark.parametrize("construct", CONSTRUCTS)
def test_classes(construct):
    expected = _expected(construct).get("classes", {})
    found = dict(_numbered(_found(construct).classes))
    for name, facts in expected.items():
        assert {key: _of_class(found[name], key) for key in facts} == facts, name


@pytest.mark.parametrize("construct", CONSTRUCTS)
def test_files(construct):
    expected = {key: value for key, value in _expected(construct).items() if key not in {"functions", "classes"}}
    found = _found(construct)
    assert {key: _as_written(getattr(found, key)) for key in expected} == expected
    assert found.syntax == "python"
    assert found.faults == ()
