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
