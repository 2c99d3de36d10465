"""Rule ``node.future_in_callback_python``: a callback in rclpy that loops until a future or event is there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import arguments, call_at, keywords, receiver
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.flow.python_callbacks import python_callbacks, ways_to
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.flow.python_reached import where_reached
from roslens.source.rules.flow.python_threads import Blocked, blocked, made_by
from roslens.source.rules.flow.python_waited import ASYNC, brought_by_callbacks, client_of
from roslens.source.rules.flow.spoken_way import spoken_way
from roslens.source.rules.flow.summary import Way
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_WAITERS = {"wait": frozenset({"Event", "Condition"}), "get": frozenset({"Queue", "SimpleQueue", "LifoQueue"})}
"""What waits until another thread does something, by the name of the method, and the classes that have it."""
_SETTERS = frozenset({"set", "notify", "notify_all", "put", "put_nowait"})
_AT_ONCE = ("False", "0", "0.0")
_SPINS = ("spin_once", "spin_until_future_complete", "spin", "spin_once_until_future_complete")
_FUNCTIONS = ("function_definition", "lambda")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop until ``future.done()``, or ``event.wait()``, in a callback that keeps back what completes it."""
    call = call_at(node)
    of = receiver(call) if call is not None else None
    if call is None or of is None or above(call, "await") is not None:
        return
    if view.text(node) == "get" and b"Queue" not in view.code:
        return
    if view.text(node) in _WAITERS:
        told = _of_event(call, of, view)
        expected = "expected to go on in the callback that brings it"
    else:
        loop = _loop_until(call, view)
        if loop is None:
            return
        told = _of_future(call, of, view)
        expected = "expected `await future` in an `async` callback, or `add_done_callback`"
    if told is not None:
        way, why = told
        yield view.hit(
            "node.future_in_callback_python",
            call,
            f"`{view.short(call)}` is waited for in {spoken_way(way, view)}: it never comes while this callback runs, "
            f"for {why.because}; {expected}",
            certainty=why.certainty,
        )
    elif view.text(node) == "done" and not ways_to(call, view):
        yield from _reached_elsewhere(call, of, view)


def _reached_elsewhere(call: Node, of: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop in a function that a callback of another file calls, for a client in the default group."""
    sent = made_by(of, ASYNC, view)
    client = client_of(sent, view) if sent is not None else None
    where = where_reached(call, view) if client is not None and b"callback_group" not in view.code else ""
    if where:
        yield view.hit(
            "node.future_in_callback_python",
            call,
            f"`{view.short(call)}` is waited for in what a callback of another file calls: it never comes while that "
            "callback runs; expected `await future` in an `async` callback, or `add_done_callback`",
            callback=where,
            certainty=Certainty.LIKELY,
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
            sent = made_by(value, ASYNC, view)
            client = client_of(sent, view) if sent is not None else None
            why = blocked(way.registration, client, view) if client is not None else None
            if why is not None:
                return way, why
    return None


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
    made = made_by(of, _WAITERS[callee_name(call, view)], view)
    if callbacks is None or made is None or any(view.text(one) in _AT_ONCE for one in arguments(call)):
        return None
    if any(view.text(one) in _AT_ONCE for one in keywords(call, view).values()):
        return None
    name = view.text(of)
    setters = [
        one
        for one in callbacks.functions.calls
        if callee_name(one, view) in _SETTERS and view.text(receiver(one)) == name
    ]
    found = ((way, brought_by_callbacks(way, setters, view)) for way in callbacks.ways_to(call))
    return next(((way, why) for way, why in found if why is not None), None)


RULE = FileRule(
    id="node.future_in_callback_python",
    title="Waiting for a future or an event in a callback (rclpy)",
    finds="A loop until `future.done()`, `wait` of an event or condition, or `get` of a queue, in a callback or in a "
    "function that one calls, where what completes the future or sets the event is another callback in the same "
    "mutually exclusive callback group, or where one thread runs all callbacks. Await the future in an `async` "
    "callback or give it `add_done_callback`.",
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
    anchors=("done", "wait", "get"),
    mentions=RCLPY,
    found=found,
)
