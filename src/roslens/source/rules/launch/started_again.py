"""Rule ``launch.started_again``: a handler of every process starts one itself, which calls it again."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.launch.each_call import each_call
from roslens.source.rules.rule import FileRule
from roslens.source.rules.views.launch_code import MENTIONS, TRUTH, LaunchCall, LaunchCode, shown

_HANDLERS = {"OnProcessStart": ("on_start", "start"), "OnProcessExit": ("on_exit", "exit")}
"""By handler: the argument with what it does, and the event."""
_PROCESSES = frozenset({"ExecuteProcess", "ExecuteLocal", "Node", "LifecycleNode", "ComposableNodeContainer"})


def _judged(call: LaunchCall, code: LaunchCode) -> Iterator[tuple[Node, str]]:
    """Yield the handlers without a target that start a process."""
    if call.name not in _HANDLERS or not call.is_whole or call.argument("target_action") is not None:
        return
    name, event = _HANDLERS[call.name]
    once = call.argument("handle_once")
    if once is not None and (code.sort(once) != TRUTH or code.view.text(code.value(once)) == "True"):
        return
    given = call.argument(name)
    for one in code.items(given) or ((given,) if given is not None else ()):
        made = code.call(code.value(one))
        if made is not None and made.name in _PROCESSES:
            message = (
                f"{call.name} has no target_action: the {event} of each process executes {shown(one, code)}, and "
                f"launch refuses to execute an action twice; expected `target_action=` with the process that is meant"
            )
            yield call.node, message
            return


RULE = FileRule(
    id="launch.started_again",
    title="Handler of every process that starts one",
    finds="`OnProcessStart` or `OnProcessExit` without `target_action` whose actions are a node or another process, "
    "without `handle_once=True`. Give it the process that is meant as `target_action`.",
    why="Without a target each process of the launch calls the handler, that which it starts among them: the same "
    "action is executed a second time, which launch refuses, and the launch ends.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch.actions import RegisterEventHandler\nfrom launch.event_handlers import OnProcessStart\n"
    "from launch_ros.actions import Node\n\n"
    "base = Node(package='base', executable='base')\narm = Node(package='arm', executable='arm')\n"
    "start = RegisterEventHandler(OnProcessStart(on_start=[arm]))",
    good="from launch.actions import RegisterEventHandler\nfrom launch.event_handlers import OnProcessStart\n"
    "from launch_ros.actions import Node\n\n"
    "base = Node(package='base', executable='base')\narm = Node(package='arm', executable='arm')\n"
    "start = RegisterEventHandler(OnProcessStart(target_action=base, on_start=[arm]))",
    found=each_call("launch.started_again", _judged),
)
