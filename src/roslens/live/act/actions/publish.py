"""``publish``: a message, once, kept for those who come later, or again and again."""

from __future__ import annotations

from roslens.live.act.ros import ActionError, Asked, Ros

_FASTEST_HZ = 100.0


def prepare(ros: Ros, asked: Asked) -> None:
    """Make the publisher.

    Raises:
        ActionError: the type is not known, a field does not fit, or the rate is none.
    """
    arguments = asked.arguments
    if not 0 < float(arguments["rate"]) <= _FASTEST_HZ:
        raise ActionError(f"a rate of {arguments['rate']:g} Hz", expected=f"above 0 and up to {_FASTEST_HZ:g} Hz")
    ros.advertise(arguments["topic"], arguments["type"], arguments["fields"], latched=arguments["how"] == "latched")


def act(ros: Ros, asked: Asked) -> str:
    """Publish, and return a description with the number of subscribers.

    Raises:
        ActionError: it cannot be published, or nobody is there to hear it.
    """
    arguments = asked.arguments
    topic, latched = arguments["topic"], arguments["how"] == "latched"

    def once() -> int:
        return ros.publish(topic, arguments["type"], arguments["fields"], latched=latched)

    count = once()
    if arguments["how"] == "repeated":
        asked.repeat(1 / float(arguments["rate"]), once)
        return (
            f"published on {topic} to {_subscribers(count)}, and again at {arguments['rate']:g} Hz until it is cleared"
        )
    if not count and not latched:
        raise ActionError(f"published on {topic}, which has no subscriber", expected="a subscriber")
    return f"published on {topic} to {_subscribers(count)}"


def _subscribers(count: int) -> str:
    return "1 subscriber" if count == 1 else f"{count} subscribers"
