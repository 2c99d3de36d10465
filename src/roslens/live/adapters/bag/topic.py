"""A topic as a recording knows it."""

from __future__ import annotations

import msgspec


class BagTopic(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """What was recorded of a topic with one type.

    Attributes:
        name: of the topic.
        type: ``package/Type`` (ROS 1) or ``package/msg/Type`` (ROS 2).
        count: messages, as far as the recording tells without reading them all.
        hash: MD5 (ROS 1) or RIHS01 (ROS 2) of the type; empty where it is not stored.
        publishers: nodes that published; only ROS 1 stores them.
        qos: offered profiles as they are stored, YAML text; empty where there are none.
        stamped: messages begin with a header, whose stamp tells their age.
    """

    name: str
    type: str
    count: int = 0
    hash: str = ""
    publishers: tuple[str, ...] = ()
    qos: str = ""
    stamped: bool = False
