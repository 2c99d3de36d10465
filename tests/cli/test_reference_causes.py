"""What is reported of the way to a first cause."""

from roslens.cli.references.reference_causes import lines, rows
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import Link, State, Verdict

SCAN = EntityId(EntityKind.TOPIC, "/scan")
CAUSED = Verdict(
    SCAN, "r.scan.rate", "rate", State.ABSENT, 101.0, 102.5, cause="node:/lidar", evidence="silent for 1.5 s",
    why=(Link("node:/lidar", "is published by", "is gone"),),
)  # fmt: skip
FIRST = Verdict(EntityId(EntityKind.NODE, "/lidar"), "roslens.gone", "presence", State.ABSENT, 101.0, 101.0,
                evidence="is gone", leads_to="/scan silent")  # fmt: skip


def test_in_words():
    assert lines(100.0, [FIRST, CAUSED]) == [
        "       1.00 s  roslens.gone is absent: is gone → /scan silent",
        "               it is a first cause",
        "       2.50 s  r.scan.rate is absent: silent for 1.5 s",
        "               topic:/scan is published by node:/lidar (is gone)",
    ]


def test_for_programs():
    first, caused = rows(100.0, [FIRST, CAUSED])
    assert (first["first_cause"], first["at"]) == (True, 1.0)
    assert list(caused["why"]) == [{"entity": "node:/lidar", "relation": "is published by", "evidence": "is gone"}]
    assert caused["cause"] == "node:/lidar"
