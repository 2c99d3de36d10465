"""The reference page of quality models and the JSON Schema of their documents, generated from the accepted keys."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from roslens.judge.quality.constraint import Constraint
from roslens.judge.quality.quality_model import DOCUMENT_KIND, MODEL_KEYS, QualityModel
from roslens.judge.quality.read_constraints import CONSTRAINT_KEYS, KINDS
from roslens.model.finding import Severity

EXAMPLE = """\
kind: quality model
name: our-robot
title: Requirements on our own code
extends: ros
without: [noc]
tags: [team]
constraints:
  # Stricter than the ROS model: replaces its constraint of the same id.
  - quantity: cyclomatic_complexity
    kind: function
    maximum: 10
    severity: error
    rationale: Reviews of longer functions found nothing.

  # Only drivers, and only their long functions.
  - quantity: loc
    kind: function
    name: "driver::*"
    maximum: 60

  # A second constraint on one quantity has an id of its own.
  - quantity: loc
    id: file_loc
    kind: file
    maximum: 500

  # A fold of a quantity: the deepest nesting in the package.
  - quantity: nesting.max
    kind: package
    maximum: 6
    severity: note
"""

_HEAD = """\
# Quality models

A quality model is a YAML document with limits of quantities. `roslens check --model NAME` applies one of the built-in
models below, `--model PATH` your own; several may be given, and `models = [...]` in `roslens.toml` sets them for a
workspace. The default is `extreme:note` and `ros:note`: `:note`, `:warning` or `:error` behind a name gives all limits
of the model that severity, and without it they have their own. All limits are *hard to maintain*; a warning says that
whoever set it acts on it, so that `--model extreme` brings the worst of them back as the last row of "Fix first".
`make docs` generates this page from `src/roslens/judge/`.

Bounds are inclusive: a finding is a value *above* `maximum` or *below* `minimum`. Its rule is called
`<model>.<id>.max` or `<model>.<id>.min`; its tags are `metrics`, the name of the model, and those of the model and
the constraint. A quantity that was not measured violates nothing.

## Writing your own

```yaml
"""

_AFTER_EXAMPLE = """\
```

Errors are reported with file, line and column, what was found and what was expected. Keys that are not in the
tables below are errors too. Texts are taken literally (`name: no` is the text `no`), numbers are decimal.
[`model.schema.json`](model.schema.json) lets editors check and complete such documents.

`extends` inherits the constraints of other models, and those of later ones take precedence; a constraint of your own
replaces all inherited ones with its `id`. The rules of inherited constraints are named after your model.
"""


def models_page(models: Iterable[QualityModel]) -> str:
    """Return the reference page in Markdown, with a section for each of ``models``."""
    parts = [
        _HEAD + EXAMPLE + _AFTER_EXAMPLE,
        _keys("### Keys of a model", MODEL_KEYS),
        _keys("### Keys of a constraint", CONSTRAINT_KEYS),
        "## Built-in models\n",
        *map(_section, models),
    ]
    return "\n".join(parts)


def model_schema() -> dict[str, object]:
    """Return the JSON Schema (2020-12) of a model document."""
    severity: dict[str, object] = {"enum": [severity.value for severity in Severity]}
    texts: dict[str, object] = {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}
    constraint = _described(
        CONSTRAINT_KEYS,
        {
            "kind": {"enum": [kind.value for kind in KINDS]},
            "minimum": {"type": "number"},
            "maximum": {"type": "number"},
            "severity": severity,
            "tags": texts,
        },
    )
    constraint["required"] = ["quantity", "kind"]
    constraint["anyOf"] = [{"required": ["minimum"]}, {"required": ["maximum"]}]
    model = _described(
        MODEL_KEYS,
        {
            "kind": {"const": DOCUMENT_KIND},
            "name": {"type": "string", "pattern": "^[a-z][a-z0-9_-]*$"},
            "version": {"type": ["string", "number"]},
            "extends": texts,
            "without": texts,
            "severity": severity,
            "tags": texts,
            "constraints": {"type": "array", "items": constraint},
        },
    )
    model["required"] = ["kind", "name"]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "roslens quality model",
        **model,
    }


def _described(keys: Mapping[str, str], types: Mapping[str, dict[str, object]]) -> dict[str, object]:
    properties = {key: {"description": text, **types.get(key, {"type": "string"})} for key, text in keys.items()}
    return {"type": "object", "additionalProperties": False, "properties": properties}


def _keys(heading: str, keys: Mapping[str, str]) -> str:
    rows = [f"| `{key}` | {text} |" for key, text in keys.items()]
    return "\n".join([heading, "", "| key | meaning |", "| --- | --- |", *rows, ""])


def _section(model: QualityModel) -> str:
    rows = [_row(constraint) for constraint in model.constraints]
    lines = [f"### {model.name}", "", f"{model.title}. {model.text}", "", f"Source: {model.source}.", ""]
    return "\n".join([*lines, "| kind | quantity | limit | source |", "| --- | --- | --- | --- |", *rows, ""])


def _row(constraint: Constraint) -> str:
    unit = f" {constraint.unit}" if constraint.unit == "%" else ""
    return f"| {constraint.kind.value} | `{constraint.quantity}` | {constraint.range}{unit} | {constraint.source} |"
