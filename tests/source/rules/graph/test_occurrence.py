from roslens.model.configuration import Proof
from roslens.model.finding import Severity
from roslens.source.rules.graph.occurrence import occurrence
from roslens.source.rules.graph.timing.qos import RULE


def test_a_finding_has_the_rule_the_place_and_a_fingerprint_that_lines_do_not_change():
    one, moved = (occurrence(RULE, "x", Proof("a.cpp", line), entity="topic:/x", context="a") for line in (3, 9))
    assert (one.rule, one.severity, one.path, one.line, one.tags, one.tool) == (
        "graph.qos", Severity.ERROR, "a.cpp", 3, RULE.tags, "graph",
    )  # fmt: skip
    assert one.fingerprint == moved.fingerprint
    assert one.fingerprint != occurrence(RULE, "x", Proof("a.cpp", 3), entity="topic:/x", context="b").fingerprint
    assert one.fingerprint != occurrence(RULE, "x", Proof("b.cpp", 3), entity="topic:/x", context="a").fingerprint
