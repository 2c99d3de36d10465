import json

from roslens.compare.finding_difference import FindingDifference
from roslens.compare.graph_difference import Difference
from roslens.model.finding import Finding, Severity
from roslens.report.graph.difference_document import to_difference_json


def test_what_is_different_and_which_findings_are_new_and_gone():
    finding = Finding("graph.qos", Severity.ERROR, "lost", "a.py", 3, fingerprint="f")
    text = to_difference_json(
        [Difference("/a", "node", "", "added", "", "a/b")], "A", "B", FindingDifference((finding,))
    )
    found = json.loads(text)
    assert (found["schema"], found["before"], found["after"]) == ("roslens-graph-difference/1", "A", "B")
    assert found["differences"][0]["node"] == "/a"
    assert [one["rule"] for one in found["findings"]["new"]] == ["graph.qos"]
    assert found["findings"]["gone"] == []


def test_findings_that_nobody_looked_for_are_null():
    assert json.loads(to_difference_json([], "A", "B"))["findings"] is None
