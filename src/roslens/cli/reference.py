"""Writes the reference pages that come from declarations: ``python -m roslens.cli.reference docs/reference``."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path


def pages() -> Mapping[str, str]:
    """Return every generated page by its path below ``docs/reference``."""
    from roslens.judge.pages.action_pages import action_pages
    from roslens.judge.pages.models_page import model_schema, models_page
    from roslens.judge.pages.reactions_page import reactions_page
    from roslens.judge.pages.references_page import reference_schema, references_page
    from roslens.judge.quality.quality_model import builtin_models, load_model
    from roslens.live.window.signals import BY_KEY
    from roslens.report.graph.conformance_document import conformance_schema
    from roslens.report.graph.graph_document import graph_schema
    from roslens.source.history.describe import process_page
    from roslens.source.history.metrics.table import PROCESS_METRICS
    from roslens.source.metrics.describe import metrics_page
    from roslens.source.metrics.table import QUANTITIES
    from roslens.source.rules.graph import plugin as graph
    from roslens.source.rules.graph.page import graph_rules_page
    from roslens.source.rules.pages import rule_pages
    from roslens.source.rules.published.standards import standards_page
    from roslens.source.rules.table import native_rules
    from roslens.source.tools.cccc_quantities import CCCC_QUANTITIES
    from roslens.source.tools.checks.page import tool_page, tools_page
    from roslens.source.tools.used import TOOLS

    known = {**QUANTITIES, **{quantity.key: quantity for quantity in CCCC_QUANTITIES}}
    models = [load_model(name, known) for name in builtin_models()]
    return {
        "metrics/quantities.md": metrics_page(QUANTITIES.values()),
        "metrics/process.md": process_page(PROCESS_METRICS),
        "models.md": models_page(models),
        "model.schema.json": _json(model_schema()),
        "references.md": references_page(BY_KEY),
        "reactions.md": reactions_page(),
        "reference.schema.json": _json(reference_schema(BY_KEY)),
        "tools.md": tools_page(),
        **{f"tools/{name}.md": tool_page(name) for name in TOOLS},
        **action_pages(),
        "graph.schema.json": _json(graph_schema()),
        "conformance.schema.json": _json(conformance_schema()),
        **rule_pages(native_rules()),
        "standards.md": standards_page(native_rules()),
        "graph_rules.md": graph_rules_page(graph.manifest.rules, graph.manifest.options),
    }


def _json(schema: Mapping[str, object]) -> str:
    return json.dumps(schema, indent=2, ensure_ascii=False) + "\n"


def main(words: Sequence[str] | None = None) -> int:
    """Write the pages below the folder given."""
    parser = argparse.ArgumentParser(prog="python -m roslens.cli.reference", description=__doc__)
    parser.add_argument("folder", type=Path, help="folder for the pages; it is made where it is missing")
    target: Path = parser.parse_args(words).folder
    for path, text in pages().items():
        place = target / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, "utf-8")
        print(place)
    return 0


if __name__ == "__main__":
    sys.exit(main())
