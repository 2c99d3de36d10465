from roslens.model.configuration import ConfiguredEndpoint, Proof
from roslens.model.graph import Endpoint, Role
from roslens.source.extract.configuration.assemble_actions import folded

PROOF = Proof("a.cpp", 3)
PARTS = (
    ("goal", "ActionGoal"),
    ("cancel", ""),
    ("status", ""),
    ("feedback", "ActionFeedback"),
    ("result", "ActionResult"),
)


def topics(*, server: bool, leave_out: str = "") -> list[ConfiguredEndpoint]:
    found = []
    for part, kind in PARTS:
        sends = (part in ("goal", "cancel")) is not server
        role = Role.PUBLISHER if sends else Role.SUBSCRIPTION
        name = f"/move/{part}"
        kind = f"pkg/Move{kind}" if kind else "actionlib_msgs/Other"
        if part != leave_out:
            found.append(ConfiguredEndpoint(Endpoint("/n", role, name, kind), PROOF, name[1:]))
    return found


def test_five_topics_are_a_server_or_client_by_who_sends_the_goal():
    for server, role in ((True, Role.ACTION_SERVER), (False, Role.ACTION_CLIENT)):
        (action,) = folded(topics(server=server))
        assert (action.endpoint.role, action.endpoint.name, action.endpoint.type) == (role, "/move", "pkg/MoveAction")
        assert action.given == "move"


def test_less_than_five_topics_are_topics():
    for part, _ in PARTS:
        left = topics(server=True, leave_out=part)
        assert folded(left) == left
