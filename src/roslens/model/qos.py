"""Quality of service of an endpoint, in the words of ROS 2."""

from __future__ import annotations

import msgspec


class Qos(msgspec.Struct, frozen=True, omit_defaults=True):
    """Policies offered by a publisher or requested by a subscription; an empty text is unknown, 0 s is no limit.

    ``reliability`` is ``reliable`` or ``best_effort``; ``durability`` ``volatile`` or ``transient_local``; ``history``
    ``keep_last`` or ``keep_all``; ``liveliness`` ``automatic`` or ``manual_by_topic``. ``depth`` 0 is unknown.
    """

    reliability: str = ""
    durability: str = ""
    history: str = ""
    depth: int = 0
    deadline_s: float = 0.0
    lifespan_s: float = 0.0
    liveliness: str = ""
    lease_s: float = 0.0


def quality_text(qos: Qos) -> str:
    """Return a quality of service in words; what is unknown is left out, ``?`` where all is."""
    history = "keep_all" if qos.history == "keep_all" else f"depth {qos.depth}" if qos.depth else ""
    limits = (("deadline", qos.deadline_s), ("lifespan", qos.lifespan_s), ("lease", qos.lease_s))
    words = [qos.reliability, "" if qos.durability == "volatile" else qos.durability, history]
    words += [f"{name} {seconds:g} s" for name, seconds in limits if seconds]
    words.append("" if qos.liveliness in ("", "automatic") else qos.liveliness)
    return ", ".join(word for word in words if word) or "qos unknown"
