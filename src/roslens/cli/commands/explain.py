"""``roslens explain``: what a rule, a quantity or a quality model means and what to do about it."""

from __future__ import annotations

import argparse
import difflib
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.completion_words import IDS
from roslens.cli.workplace.explainable import known
from roslens.cli.workplace.trust_option import add_trust_argument, admitted_by

if TYPE_CHECKING:
    from roslens.judge.quality.quality_model import QualityModel
    from roslens.model.finding import RuleInfo
    from roslens.model.quantity import Quantity

TEXT = "Explain a rule, a quantity or a quality model."
EXAMPLES = """\
  roslens explain ros.cyclomatic_complexity.max
  roslens explain cyclomatic_complexity
  roslens explain his"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what to explain."""
    what = parser.add_argument("id", metavar="ID", help="rule id, quantity key or model name")
    what.complete = IDS  # type: ignore[attr-defined]
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="whose roslens.toml counts (default: .)")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    add_trust_argument(parser)


def run(options: argparse.Namespace) -> int:
    """Print the explanation.

    Raises:
        UsageError: nothing has that id.
    """
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.model.errors import UsageError

    looked_at = Path(options.path).resolve()
    configuration = admitted_by(options, find_configuration(looked_at, options.config), looked_at)
    models, quantities, rules = known(configuration)
    wanted = options.id
    if wanted in models:
        print(_of_model(models[wanted]))
    elif wanted in quantities:
        print(_of_quantity(quantities[wanted], models))
    elif wanted in rules:
        print(_of_rule(rules[wanted]))
    elif (rule := _of_tool(wanted)) is not None:
        print(_of_rule(rule))
    else:
        near = difflib.get_close_matches(wanted, (*models, *quantities, *rules), 3, 0.5)
        raise UsageError(
            f"nothing has the id {wanted!r}",
            expected="a rule, a quantity or a model",
            advice=f"Did you mean {', '.join(near)}?" if near else "See `roslens plugins`",
        )
    return 0


def _of_tool(identity: str) -> RuleInfo | None:
    """Return the rule of a foreign tool that no data file names, by what its family is."""
    from roslens.source.tools.checks.tool_checks import rule_of
    from roslens.source.tools.used import TOOLS

    tool, _, check = identity.partition(".")
    return rule_of(tool, check) if tool in TOOLS and check else None


def _of_rule(rule: RuleInfo) -> str:
    from roslens.model.weight.consequence import weight_text
    from roslens.model.words.silence_comment import measured_text, silence_comment

    return _sections(
        f"{rule.id}  ({rule.severity.value}: {weight_text(*rule.weight, unproven=rule.unproven)})",
        (
            ("", rule.title),
            ("", rule.description),
            ("Why", rule.rationale),
            ("Reported", rule.bad),
            ("Instead", rule.good),
            ("Fix, by `roslens check --fix`", rule.fix),
            ("Measured", measured_text(rule)),
            ("To leave one finding out", silence_comment(rule)),
            ("Tags", ", ".join(rule.tags)),
            ("Found by", rule.tool),
            ("More", rule.url),
        ),
    )


def _of_quantity(quantity: Quantity, models: dict[str, QualityModel]) -> str:
    folds = ", ".join(fold.value for fold in quantity.folds)
    bounds = "\n".join(
        f"{constraint.kind.value} {constraint.range} ({name})"
        for name, model in models.items()
        for constraint in model.constraints
        if constraint.quantity == quantity.key
    )
    return _sections(
        f"{quantity.key}  [{quantity.unit}]",
        (
            ("", quantity.title),
            ("", quantity.text),
            ("Measured on", ", ".join(kind.value for kind in quantity.kinds)),
            ("Folded upward by", folds),
            ("Formula", quantity.formula),
            ("Source", quantity.source),
            ("Known limits", quantity.limits),
            ("Thresholds", bounds),
        ),
    )


def _of_model(model: QualityModel) -> str:
    lines = "\n".join(
        f"{constraint.kind.value:<10} {constraint.quantity:<26} {constraint.range}" for constraint in model.constraints
    )
    return _sections(
        f"{model.name}  {model.title}", (("", model.text), ("Source", model.source), ("Thresholds", lines))
    )


def _sections(head: str, parts: tuple[tuple[str, str], ...]) -> str:
    blocks = [head]
    for title, text in parts:
        if not text:
            continue
        # Code keeps its lines and its indentation.
        is_code = title in {"Reported", "Instead"}
        wide = text.splitlines()
        lines = wide if is_code else [wrapped for line in wide for wrapped in (textwrap.wrap(line, 96) or [""])]
        blocks.append(textwrap.indent("\n".join(lines), "  ") if not title else f"{title}:\n  " + "\n  ".join(lines))
    return "\n\n".join(blocks)
