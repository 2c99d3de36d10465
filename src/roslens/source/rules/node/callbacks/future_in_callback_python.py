"""Rule ``node.future_in_callback_python``: a callback in rclpy that loops until a future or event is there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import call_at, function_around, receiver
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.flow.python_callbacks import python_callbacks, ways_to
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_threads import Blocked, blocked, made_by
from roslens.source.rules.flow.spoken_way import spoken_way
from roslens.source.rules.flow.summary import CallbackKind, Registration, Way
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_ASYNC = frozenset({"call_async", "send_goal_async", "get_result_async", "cancel_goal_async"})
_CLIENTS = frozenset({"create_client", "ActionClient"})
_EVENTS = frozenset({"Event"})
_SPINS = ("spin_once", "spin_until_future_complete", "spin", "spin_once_until_future_complete")
_FUNCTIONS = ("function_definition", "lambda")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop until ``future.done()``, or ``event.wait()``, in a callback that keeps back what completes it."""
    call = call_at(node)
    of = receiver(call) if call is not None else None
    if call is None or of is None or above(call, "await") is not None:
        return
    if view.text(node) == "wait":
        told, place = _of_event(call, of, view), call
        expected = "expected to go on in the callback that sets it"
    else:
        loop = _loop_until(call, view)
        if loop is None:
            return
        told, place = _of_future(call, of, view), call
        expected = "expected `await future` in an `async` callback, or `add_done_callback`"
    if told is not None:
        way, why = told
        yield view.hit(
            "node.future_in_callback_python",
            place,
            f"`{view.short(call)}` is waited for in {spoken_way(way, view)}: it never comes while this callback runs, "
            f"for {why.because}; {expected}",
            certainty=why.certainty,
        )


def _loop_until(call: Node, view: FileView) -> Node | None:
    """Return the loop that ends when a call says so, and that lets nothing else run meanwhile."""
    loop = above(call, "while_statement", *_FUNCTIONS)
    if loop is None or loop.type != "while_statement":
        return None
    condition = loop.child_by_field_name("condition")
    if condition is None or any(callee_name(one, view) in _SPINS for one in below(loop, "call")):
        return None
    if next(below(loop, "await"), None) is not None or next(below(loop, "yield"), None) is not None:
        return None
    inside = condition.start_byte <= call.start_byte < condition.end_byte
    if inside:
        return loop if above(call, "not_operator") is not None else None
    choice = above(call, "if_statement", "while_statement")
    if choice is None or choice.type != "if_statement":
        return None
    tested = choice.child_by_field_name("condition")
    ends = choice.child_by_field_name("consequence")
    is_test = tested is not None and tested.start_byte <= call.start_byte < tested.end_byte
    return loop if is_test and ends is not None and _leaves(ends) and _is_endless(condition, view) else None


def _leaves(block: Node) -> bool:
    return any(one.type in ("break_statement", "return_statement") for one in block.named_children)


def _is_endless(condition: Node, view: FileView) -> bool:
    return condition.type == "true" or view.text(condition) in ("1", "rclpy.ok()")


def _of_future(call: Node, of: Node, view: FileView) -> tuple[Way, Blocked] | None:
    for way in ways_to(call, view):
        for value in _passed(of, way, view):
            sent = made_by(value, _ASYNC, view)
            client = _client_of(sent, view) if sent is not None else None
            why = blocked(way.registration, client, view) if client is not None else None
            if why is not None:
                return way, why
    return None


def _client_of(sent: Node, view: FileView) -> Node | None:
    """Return the call that makes the client whose request a call sends; of goals, that of the only action client."""
    of = receiver(sent)
    client = made_by(of, _CLIENTS, view) if of is not None else None
    if client is not None or callee_name(sent, view) in ("call_async", "send_goal_async"):
        return client
    made = [one for one in python_functions(view).calls if callee_name(one, view) == "ActionClient"]
    return made[0] if len(made) == 1 else None


def _passed(of: Node, way: Way, view: FileView) -> Sequence[Node]:
    """Return what an expression is; of a parameter what the function before on the way passes for it."""
    function = way.functions[-1]
    place = _place_of(of, function, view)
    if place is None or way.is_direct:
        return (of,)
    functions = python_functions(view)
    found = []
    for call in functions.calls_in(way.functions[-2]):
        for target in functions.called(call):
            listed = call.child_by_field_name("arguments")
            given = [one for one in listed.named_children if one.type != "comment"] if listed is not None else []
            at = place - target.bound
            if target.function == function and 0 <= at < len(given) and given[at].type != "keyword_argument":
                found.append(given[at])
    return found


def _place_of(of: Node, function: Node, view: FileView) -> int | None:
    listed = function.child_by_field_name("parameters")
    if of.type != "identifier" or listed is None:
        return None
    names = [
        view.text(one.child_by_field_name("name") or (one.named_children[0] if one.named_children else one))
        for one in listed.named_children
    ]
    return names.index(view.text(of)) if view.text(of) in names else None


def _of_event(call: Node, of: Node, view: FileView) -> tuple[Way, Blocked] | None:
    """Return the way to a wait for an event that only callbacks set, which cannot run meanwhile."""
    callbacks = python_callbacks(view)
    if callbacks is None or made_by(of, _EVENTS, view) is None:
        return None
    name = view.text(of)
    setters = [
        one for one in callbacks.functions.calls if callee_name(one, view) == "set" and view.text(receiver(one)) == name
    ]
    for way in callbacks.ways_to(call):
        whys = [_kept_back(way, one, view) for one in setters]
        if whys and all(whys):
            return way, next(one for one in whys if one is not None)
    return None


def _kept_back(way: Way, setter: Node, view: FileView) -> Blocked | None:
    """Return why a place that sets an event cannot run; None where it may, or where nobody knows what runs it."""
    own = function_around(setter)
    if own is None or own == function_around(way.functions[-1]):
        return None
    others = ways_to(setter, view)
    whys = [_keeps_back(way.registration, one.registration, view) for one in others]
    return whys[0] if whys and all(whys) else None


def _keeps_back(waiting: Registration, setting: Registration, view: FileView) -> Blocked | None:
    if waiting.target.function == setting.target.function:
        return None
    if setting.kind is not CallbackKind.DONE:
        return blocked(waiting, setting.call, view)
    future = receiver(setting.call)
    sent = made_by(future, _ASYNC, view) if future is not None else None
    client = _client_of(sent, view) if sent is not None else None
    return blocked(waiting, client, view) if client is not None else None


RULE = FileRule(
    id="node.future_in_callback_python",
    title="Waiting for a future or an event in a callback (rclpy)",
    finds="A loop until `future.done()`, or `event.wait()`, in a callback or in a function that one calls, where what "
    "completes the future or sets the event is another callback in the same mutually exclusive callback group, or "
    "where one thread runs all callbacks. Await the future in an `async` callback or give it `add_done_callback`.",
    why="The answer is delivered by the executor that waits for this callback to end: both wait for ever, and the "
    "node is dead without a message.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("callbacks", "deadlock"),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.client = self.create_client(Ask, "ask")
        self.timer = self.create_timer(1.0, self.tick)
    def tick(self):
        future = self.client.call_async(Ask.Request())
        while not future.done():
            time.sleep(0.01)
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.client = self.create_client(Ask, "ask")
        self.timer = self.create_timer(1.0, self.tick)
    async def tick(self):
        answer = await self.client.call_async(Ask.Request())
""",
    syntax="python",
    anchors=("done", "wait"),
    mentions=RCLPY,
    found=found,
)
