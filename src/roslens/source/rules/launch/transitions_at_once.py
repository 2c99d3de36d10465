"""Rule ``launch.transitions_at_once``: a lifecycle node is told to activate while it still configures."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import function_around, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.views.launch_code import MENTIONS, LaunchCode, launch_code
from roslens.source.rules.views.python_names import text_of

_CONFIGURE, _ACTIVATE = "configure", "activate"
_TRANSITIONS = {"TRANSITION_CONFIGURE": _CONFIGURE, "1": _CONFIGURE, "TRANSITION_ACTIVATE": _ACTIVATE, "3": _ACTIVATE}
"""By the end of what names them; the numbers are those of lifecycle_msgs/msg/Transition."""


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each event that activates a node, where the same list or description configures it as well."""
    code = launch_code(view)
    if code is None or b"ChangeState" not in view.words:
        return
    for together in _together(code):
        asked: dict[str, dict[str, Node]] = {}
        for item in together:
            made = code.value(item)
            which, matcher = _transition(made, code)
            if made is not None and which:
                asked.setdefault(matcher, {})[which] = made
        for events in asked.values():
            if _CONFIGURE in events and _ACTIVATE in events:
                line = events[_CONFIGURE].start_point[0] + 1
                message = (
                    f"the node is told to activate together with the event of line {line} that configures it: the "
                    "requests are sent at once, and activating is refused until configuring has ended; expected "
                    "OnStateTransition with goal_state='inactive' around it"
                )
                yield view.hit("launch.transitions_at_once", events[_ACTIVATE], message)


def _together(code: LaunchCode) -> Iterator[Sequence[Node]]:
    """Yield what is launched at once: the items of each list, and what is added to one description."""
    added: dict[tuple[int, str], list[Node]] = defaultdict(list)
    for call in code.calls:
        for value in (*call.positional, *call.keywords.values()):
            items = code.items(value)
            if len(items) > 1:
                yield items
    for node in code.other_calls:
        function = node.child_by_field_name("function")
        listed = node.child_by_field_name("arguments")
        if function is not None and listed is not None and text_of(function).endswith(".add_action"):
            around = function_around(node)
            added[around.start_byte if around is not None else 0, text_of(function)] += listed.named_children[:1]
    yield from added.values()


def _transition(node: Node | None, code: LaunchCode) -> tuple[str, str]:
    """Return which transition an event asks for, and of which nodes as written; twice nothing of anything else."""
    emitted = code.call(node)
    if emitted is None or emitted.name != "EmitEvent":
        return "", ""
    event = code.value(emitted.argument("event"))
    if (
        event is None
        or event.type != "call"
        or not text_of(event.child_by_field_name("function")).endswith("ChangeState")
    ):
        return "", ""
    given = keywords(event, code.view)
    asked = text_of(code.value(given.get("transition_id"))).rpartition(".")[2]
    matcher = text_of(code.value(given.get("lifecycle_node_matcher")))
    return (_TRANSITIONS[asked], matcher) if asked in _TRANSITIONS and matcher else ("", "")


RULE = FileRule(
    id="launch.transitions_at_once",
    title="Lifecycle node activated while it configures",
    finds="`EmitEvent` of `ChangeState` with `TRANSITION_ACTIVATE` in the same list of actions, or added to the same "
    "description, as the event with `TRANSITION_CONFIGURE` for the same nodes. Send it when the node is inactive: in "
    "`RegisterEventHandler(OnStateTransition(goal_state='inactive', …))`.",
    why="Both requests are sent at once and in any order. A node that is unconfigured or still configures refuses to "
    "activate, nobody asks again, and it stays inactive: it publishes nothing.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch", "lifecycle"),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch import LaunchDescription\nfrom launch.actions import EmitEvent\n"
    "from launch.events import matches_action\nfrom launch_ros.actions import LifecycleNode\n"
    "from launch_ros.events.lifecycle import ChangeState\n\n"
    "arm = LifecycleNode(package='arm', executable='arm', name='arm', namespace='')\nis_arm = matches_action(arm)\n"
    "description = LaunchDescription([\n    arm,\n"
    "    EmitEvent(event=ChangeState(lifecycle_node_matcher=is_arm, transition_id=Transition.TRANSITION_CONFIGURE)),\n"
    "    EmitEvent(event=ChangeState(lifecycle_node_matcher=is_arm, transition_id=Transition.TRANSITION_ACTIVATE)),\n"
    "])",
    good="from launch import LaunchDescription\nfrom launch.actions import EmitEvent, RegisterEventHandler\n"
    "from launch.events import matches_action\nfrom launch_ros.actions import LifecycleNode\n"
    "from launch_ros.event_handlers import OnStateTransition\nfrom launch_ros.events.lifecycle import ChangeState\n\n"
    "arm = LifecycleNode(package='arm', executable='arm', name='arm', namespace='')\nis_arm = matches_action(arm)\n"
    "activate = EmitEvent(event=ChangeState(\n"
    "    lifecycle_node_matcher=is_arm, transition_id=Transition.TRANSITION_ACTIVATE))\n"
    "description = LaunchDescription([\n    arm,\n"
    "    RegisterEventHandler(OnStateTransition(\n"
    "        target_lifecycle_node=arm, goal_state='inactive', entities=[activate])),\n"
    "    EmitEvent(event=ChangeState(lifecycle_node_matcher=is_arm, transition_id=Transition.TRANSITION_CONFIGURE)),\n"
    "])",
    found=found,
)
