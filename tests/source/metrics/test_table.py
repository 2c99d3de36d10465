"""The contract every metric keeps: whoever adds one learns what is still missing."""

from __future__ import annotations

import re
from pathlib import Path
from types import ModuleType

import pytest

import roslens.source.metrics
from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity
from roslens.source.metrics.table import METRICS, QUANTITIES, metrics_with

ROOT = Path(__file__).parents[3]
FUNCTIONS = {
    "of_function",
    "of_lines",
    "of_halstead",
    "of_file",
    "of_class",
    "of_values",
    "of_files",
    "of_graph",
    "of_findings",
}
KINDS = {
    "of_function": {EntityKind.FUNCTION},
    "of_lines": {EntityKind.FUNCTION, EntityKind.FILE},
    "of_halstead": {EntityKind.FUNCTION, EntityKind.FILE},
    "of_file": {EntityKind.FILE},
    "of_class": {EntityKind.CLASS},
    "of_graph": {EntityKind.PACKAGE},
    "of_findings": {EntityKind.PACKAGE},
}
# The published keys; whoever takes one away breaks what users have written.
PUBLISHED = """loc comment_lines comment_ratio eloc cyclomatic_complexity cognitive_complexity nesting parameters calls
static_paths cbo wmc mac noc dit lcom halstead_volume maintainability_index dependents rqv rcv"""


def name_of(metric: ModuleType) -> str:
    return metric.__name__.rpartition(".")[2]


def missing(metric: ModuleType, root: Path) -> list[str]:
    """Say everything that the contract asks for and ``metric`` has not."""
    quantity: Quantity = metric.QUANTITY
    key = quantity.key
    said = [f"QUANTITY.{field} says nothing" for field in TOLD if not getattr(quantity, field)]
    if key != name_of(metric):
        said.append(f"the file must be named {key}.py, as its quantity")
    if not metric.__doc__:
        said.append("the module has no docstring")
    has = FUNCTIONS & set(vars(metric))
    if not has:
        said.append(f"none of {sorted(FUNCTIONS)} is there")
    for function in has & KINDS.keys():
        if set(quantity.kinds) != KINDS[function]:
            said.append(f"{function} measures {sorted(kind.value for kind in KINDS[function])}, QUANTITY.kinds differ")
        if not vars(metric)[function].__doc__:
            said.append(f"{function} has no docstring")
    example = root / "tests" / "fixtures" / "metrics" / key
    if not any("expect" in path.read_text("utf-8") for path in example.rglob("*") if path.is_file()):
        said.append(f"no value worked out by hand (`expect: …`) in tests/fixtures/metrics/{key}/")
    if not (root / "tests" / "source" / "metrics" / f"test_{key}.py").is_file():
        said.append(f"no tests/source/metrics/test_{key}.py")
    page = (root / "docs" / "reference" / "metrics" / "quantities.md").read_text("utf-8")
    if f"\n## {key}\n" not in page:
        said.append("no section in docs/reference/metrics/quantities.md; make it anew")
    return said


TOLD = ("title", "text", "formula", "source", "limits", "kinds")


@pytest.mark.parametrize("metric", METRICS, ids=name_of)
def test_a_metric_is_complete(metric):
    lacking = missing(metric, ROOT)
    assert not lacking, f"{name_of(metric)}: " + "; ".join(lacking)


def test_every_module_with_a_quantity_is_in_the_table():
    folder = Path(roslens.source.metrics.__path__[0])
    declared = {
        path.stem for path in folder.rglob("*.py") if re.search(r"^QUANTITY\b", path.read_text("utf-8"), re.MULTILINE)
    }
    assert declared == {name_of(metric) for metric in METRICS}


def test_keys_are_unique_and_the_published_ones_are_there():
    assert len(QUANTITIES) == len(METRICS)
    assert set(PUBLISHED.split()) <= QUANTITIES.keys()


@pytest.mark.parametrize("metric", METRICS, ids=name_of)
def test_values_worked_out_by_hand(metric, check_example, check_workspace, example_findings):
    key = name_of(metric)
    if "of_findings" in vars(metric):
        findings, expected = example_findings(key)
        assert metric.of_findings(findings) == expected
    elif "of_graph" in vars(metric):
        check_workspace(key)
    else:
        check_example(key)


@pytest.mark.parametrize("metric", METRICS, ids=name_of)
def test_texts_are_sentences_and_bounds_make_sense(metric):
    quantity = metric.QUANTITY
    assert quantity.text.endswith(".")
    assert quantity.limits.endswith(".")
    assert quantity.title[0].isupper()
    assert quantity.minimum is not None
    assert quantity.maximum is None or quantity.minimum < quantity.maximum


def test_a_metric_of_values_stands_below_those_it_needs():
    order = list(QUANTITIES)
    for metric in metrics_with("of_values"):
        source = Path(str(metric.__file__)).read_text("utf-8")
        needed = {key for key in order if re.search(rf'"{key}"|import [^\n]*\b{key}\b', source)} - {metric.QUANTITY.key}
        assert needed
        assert all(order.index(key) < order.index(metric.QUANTITY.key) for key in needed), metric


def test_an_incomplete_metric_is_told_what_it_lacks(tmp_path):
    metric = ModuleType("roslens.source.metrics.holes")
    metric.QUANTITY = Quantity(key="wholes", title="Holes", unit="", kinds=(EntityKind.FILE,), text="")
    metric.of_class = lambda subject, counting: 1.0
    page = tmp_path / "docs" / "reference" / "metrics" / "quantities.md"
    page.parent.mkdir(parents=True)
    page.write_text("# Metrics\n")
    said = "; ".join(missing(metric, tmp_path))
    for part in ("QUANTITY.text", "QUANTITY.formula", "QUANTITY.source", "QUANTITY.limits", "wholes.py", "docstring"):
        assert part in said
    for part in ("of_class measures ['class']", "fixtures/metrics/wholes/", "test_wholes.py", "no section"):
        assert part in said
