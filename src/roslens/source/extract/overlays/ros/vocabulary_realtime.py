"""The vocabulary of realtime_tools: publishers that controllers use from a loop that must not wait.

That of ROS 1 makes its publisher of a handle, a topic and the length of a queue, at once or by ``init``; that of ROS 2
is given one (realtime_publisher.h, realtime_publisher.hpp).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Made, Obj, Unknown, Value
from roslens.source.extract.domain.kinds import first_of_kind, is_whole
from roslens.source.extract.interpreter.vocabulary import CallSite, find_method, method, outer
from roslens.source.extract.overlays.ros.emit import endpoint
from roslens.source.extract.overlays.ros.vocabulary_shared import handle_of

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_NAME = "realtime_tools.RealtimePublisher"
_MADE, _TYPE = "-made", "-type"


@outer(_NAME)
def realtime_publisher(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A publisher, the one that is given, or none before ``init`` makes it."""
    given = first_of_kind(called.arguments, Made)
    if given is not None:
        return given
    found = Obj(_NAME, None, {_TYPE: called.templates[0] if called.templates else Unknown("its type")})
    if len(called.arguments) < 2:
        # That of ROS 2 is of a publisher that is unknown here, as it is created elsewhere.
        return found
    return _made(ctx, found, called)


@method(_NAME, "init")
def made_later(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """The publisher is made."""
    thing.fields[_MADE] = _made(ctx, thing, called)
    return None


def _made(ctx: Context, thing: Obj, called: CallSite) -> Made:
    queue, latched = called.argument(2), called.argument(3)
    return endpoint(
        ctx, handle_of(ctx, called), called, Role.PUBLISHER, called.argument(1), thing.fields[_TYPE],
        queue=queue if is_whole(queue) else -1, latched=latched is True,
    )  # fmt: skip


@method("made", "unlockAndPublish", "tryPublish", "try_publish")
def publish(ctx: Context, thing: Made, called: CallSite) -> Value:
    """What is in the message is published."""
    return _published(ctx, thing, called)


@method(_NAME, "unlockAndPublish")
def publish_of_later(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """What is in the message is published, by what ``init`` made."""
    made = thing.held(_MADE, Made)
    return Unknown("an object that is not yet created") if made is None else _published(ctx, made, called)


def _published(ctx: Context, made: Made, called: CallSite) -> Value:
    plain = CallSite("publish", [], {}, (), (), called.evidence)
    word = find_method(ctx, made, plain)
    return None if word is None else word(ctx, made, plain)
