import json
import stat

import pytest

from roslens.live.act.actions import snapshot
from roslens.live.act.ros import ActionError
from roslens.model.acting.reaction import ActionCall, Decision
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph, Node, Process
from roslens.model.verdict import State, Verdict

TOPIC = EntityId(EntityKind.TOPIC, "/scan")
STANDING = snapshot.Standing(
    Graph("ros2", nodes=(Node("/a", "h", 7),), processes=(Process("h", 7, "a b"),)),
    (Verdict(TOPIC, "r.rate", "rate", State.LOW, 1.0, 2.0, 3.5),),
    ((TOPIC, {"rate": 3.5}),),
    ("12:00 /a appeared", "12:01 /scan low"),
)
DECISION = Decision("r/../1.0", "r", "topic:/scan", 0, ActionCall("snapshot"), 1e9)


def test_how_things_stand_is_kept_for_this_user_alone(tmp_path):
    text = snapshot.act(DECISION, STANDING, tmp_path / "snapshots")
    (place,) = (tmp_path / "snapshots").iterdir()
    assert text == f"kept in {place}"
    assert place.name == "20010909T014640-r_.._1.0"
    assert {one.name for one in place.iterdir()} == {
        "decision.json", "graph.json", "verdicts.json", "values.json", "processes.json", "log.txt",
    }  # fmt: skip
    assert json.loads((place / "verdicts.json").read_text())[0]["entity"] == "topic:/scan"
    assert json.loads((place / "processes.json").read_text())[0]["command"] == "a b"
    assert (place / "log.txt").read_text().splitlines()[-1] == "12:01 /scan low"
    assert all(stat.S_IMODE(one.stat().st_mode) == 0o600 for one in place.iterdir())


def test_what_cannot_be_written_is_a_failure(tmp_path):
    (tmp_path / "snapshots").write_text("a file")
    with pytest.raises(ActionError, match="cannot be written"):
        snapshot.act(DECISION, STANDING, tmp_path / "snapshots")
