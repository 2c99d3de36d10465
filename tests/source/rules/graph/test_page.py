from pathlib import Path

from roslens.source.rules.graph import plugin
from roslens.source.rules.graph.page import graph_rules_page

PAGE = graph_rules_page(plugin.manifest.rules, plugin.manifest.options)


def test_the_page_tells_every_rule_and_option():
    for rule in plugin.manifest.rules:
        assert f"\n## {rule.id}\n" in PAGE
        assert rule.rationale in PAGE
    assert all(f"- `{option.name}`: " in PAGE for option in plugin.manifest.options)


def test_the_page_in_the_docs_is_this_one():
    written = Path(__file__).parents[4] / "docs" / "reference" / "graph_rules.md"
    assert written.read_text() == PAGE
