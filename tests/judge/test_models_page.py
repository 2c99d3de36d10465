"""The reference page and the schema are fresh, and what they show works."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

from roslens.judge.pages.models_page import EXAMPLE, model_schema, models_page
from roslens.judge.quality.quality_model import MODELS, builtin_models, load_model, rules_of
from roslens.model.errors import DocumentError
from roslens.model.finding import Severity
from roslens.source.metrics.table import QUANTITIES
from roslens.source.tools.cccc_quantities import CCCC_QUANTITIES

REFERENCE = Path(__file__).parents[2] / "docs" / "reference"
KNOWN = {**QUANTITIES, **{quantity.key: quantity for quantity in CCCC_QUANTITIES}}


def test_the_page_is_fresh():
    models = [load_model(name, KNOWN) for name in builtin_models()]
    written = (REFERENCE / "models.md").read_text("utf-8")
    assert written == models_page(models), "make docs writes it anew"


def test_the_schema_is_fresh():
    written = (REFERENCE / "model.schema.json").read_text("utf-8")
    assert written == json.dumps(model_schema(), indent=2, ensure_ascii=False) + "\n", "make docs writes it anew"


def test_the_example_of_the_page_works(tmp_path: Path):
    (tmp_path / "our-robot.yaml").write_text(EXAMPLE, "utf-8")
    model = load_model("our-robot.yaml", KNOWN, base=tmp_path)
    rules = {rule.id: rule for rule in rules_of(model)}
    assert "our-robot.noc.max" not in rules
    assert rules["our-robot.eloc.max"].severity is Severity.WARNING
    assert rules["our-robot.cyclomatic_complexity.max"].severity is Severity.ERROR
    assert "our-robot.file_loc.max" in rules
    assert "our-robot.nesting.max.max" in rules
    by_id = {constraint.id: constraint for constraint in model.constraints}
    assert by_id["loc"].name == "driver::*"
    assert str(by_id["cyclomatic_complexity"].range) == "<= 10"
    assert "team" in rules["our-robot.loc.max"].tags


@pytest.fixture(scope="module")
def validator() -> jsonschema.Draft202012Validator:
    jsonschema.Draft202012Validator.check_schema(model_schema())
    return jsonschema.Draft202012Validator(model_schema())


@pytest.mark.parametrize("text", [EXAMPLE, *(path.read_text("utf-8") for path in sorted(MODELS.glob("*.yaml")))])
def test_the_schema_takes_what_roslens_takes(validator: jsonschema.Draft202012Validator, text: str):
    validator.validate(yaml.safe_load(text))


@pytest.mark.parametrize(
    "change",
    [
        {"kind": "reference"},
        {"name": "My Model"},
        {"severity": "fatal"},
        {"unknown": 1},
        {"constraints": [{"quantity": "loc", "kind": "file"}]},
        {"constraints": [{"quantity": "loc", "kind": "method", "maximum": 3}]},
        {"constraints": [{"quantity": "loc", "kind": "file", "maximum": "3"}]},
        {"constraints": [{"quantity": "loc", "kind": "file", "maximum": 3, "other": 1}]},
    ],
)
def test_the_schema_refuses_what_roslens_refuses(
    validator: jsonschema.Draft202012Validator, change: dict[str, Any], tmp_path: Path
):
    document = {"kind": "quality model", "name": "mine", "extends": "ros", **change}
    assert not validator.is_valid(document)
    (tmp_path / "m.yaml").write_text(yaml.safe_dump(document), "utf-8")
    with pytest.raises(DocumentError, match=r"m\.yaml:\d+:\d+: "):
        load_model("m.yaml", KNOWN, base=tmp_path)
