import re

import msgspec

from roslens.report.graph.to_mermaid import to_mermaid


def test_every_line_joins_what_is_drawn(graph):
    text = to_mermaid(graph)
    assert text.startswith("flowchart LR\n")
    drawn = set(re.findall(r"^  ([a-z]\d+)[\[({]", text, re.MULTILINE))
    ends = re.findall(r"^  ([a-z]\d+) (-->|-\.->) ([a-z]\d+)$", text, re.MULTILINE)
    assert len(ends) == 6
    assert {one for first, _, last in ends for one in (first, last)} <= drawn
    assert any(arrow == "-.->" for _, arrow, _ in ends)
    assert text.count("subgraph") == text.count("\n  end\n") == 1


def test_signs_that_mermaid_reads_are_escaped(graph):
    node = msgspec.structs.replace(graph.nodes[0], name='/a"<b>')
    text = to_mermaid(msgspec.structs.replace(graph, nodes=(node,)))
    assert "/a#quot;#lt;b#gt;" in text
