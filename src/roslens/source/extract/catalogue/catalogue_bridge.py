"""What the words on the command line of a bridge to Gazebo make: ``/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan``.

The sign between the two types says the way: ``[`` into ROS, ``]`` out of it, ``@`` both (ros_gz_bridge, README.md).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence
from roslens.source.extract.symbolic.text import Text

_WAYS = {"[": (Role.PUBLISHER,), "]": (Role.SUBSCRIPTION,), "@": (Role.PUBLISHER, Role.SUBSCRIPTION)}
_TYPES = re.compile(r"([A-Za-z]\w*/(?:msg/|srv/)?[A-Za-z]\w*)(?:([@\[\]]).+)?\Z")
_QOS = Qos("reliable", "volatile", "keep_last", 10)


def bridged(words: Iterable[Text], evidence: Evidence) -> Iterator[EndpointFact]:
    """Yield the endpoints that the words of a bridge's command line make; others are passed over."""
    for word in words:
        before, at, types = word.tail.partition("@")
        match = _TYPES.match(types) if at else None
        if match is None:
            continue
        name = Text.of(*word.before, before)
        roles = _WAYS[match[2]] if match[2] else (Role.SERVICE_SERVER,)
        for role in roles:
            qos = None if role is Role.SERVICE_SERVER else _QOS
            yield EndpointFact(role, name, Text.of(match[1]), evidence, qos=qos)
