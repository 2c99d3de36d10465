"""Rule ``launch.missing_keyword``: a class of launch is called without what it requires, or with too much."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.launch.each_call import each_call
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import Signature
from roslens.source.rules.views.launch_code import MENTIONS, LaunchCall, LaunchCode


def _judged(call: LaunchCall, _code: LaunchCode) -> Iterator[tuple[Node, str]]:
    """Yield each call that lacks a required argument, or has more arguments by position than there are places."""
    message = _too_many(call) or (_missing(call) if call.is_whole else "")
    if message and not call.signature.is_open:
        yield call.node, message


def _too_many(call: LaunchCall) -> str:
    places = call.signature.positional
    if "*" in places or len(call.positional) <= len(places):
        return ""
    given = f"{len(call.positional)} argument{'s' if len(call.positional) > 1 else ''} by position"
    taken = f"at most {len(places)}" if places else "none"
    return f"`{call.name}` is given {given} and takes {taken}: a TypeError; expected {_usage(call.signature)}"


def _missing(call: LaunchCall) -> str:
    by_place = call.signature.positional[: len(call.positional)]
    missing = [one for one in call.signature.required if one not in call.keywords and one not in by_place]
    # A keyword of an earlier version stands for what is missing; it is reported by its own rule.
    if not missing or any(name not in call.signature.known for name in call.keywords):
        return ""
    names = " and ".join(f"`{one}`" for one in missing)
    return f"`{call.name}` is called without {names}: a TypeError; expected {_usage(call.signature)}"


def _usage(signature: Signature) -> str:
    name = signature.name.rpartition(".")[2]
    places = [one for one in signature.positional if one in signature.required]
    others = [one for one in signature.required if one not in places]
    known = signature.positional or others or [one for one in signature.known if one != "condition"][:1]
    shown = [*places, *(f"{one}=…" for one in others)] or [f"{one}=…" for one in known[:1]]
    return f"`{name}({', '.join(shown)})`"


RULE = FileRule(
    id="launch.missing_keyword",
    title="Class of launch called with too few or too many arguments",
    finds="A call of a class of `launch` or `launch_ros` without an argument that every supported distribution "
    "requires, such as `executable` of `Node`, `namespace` of `ComposableNodeContainer` or `package` of "
    "`ComposableNode`; or with more arguments by position than it takes: `LogInfo('text')`, `TextSubstitution('a')`, "
    "`PathJoinSubstitution(a, b)`, `LaunchConfiguration('a', 'b')`.",
    why="Python raises a TypeError while the launch file is read: nothing starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    mentions=MENTIONS,
    bad="from launch.actions import LogInfo\n\nsaid = LogInfo('the arm is ready')",
    good="from launch.actions import LogInfo\n\nsaid = LogInfo(msg='the arm is ready')",
    found=each_call("launch.missing_keyword", _judged),
)
