"""A process that has ROS 2 in it, and what of its environment decides whom it can meet."""

from __future__ import annotations

import msgspec


class RosProcess(msgspec.Struct, frozen=True, order=True):
    """A process of this host that has loaded a client library of ROS 2, and what its environment says.

    ``domain`` is the text of ``ROS_DOMAIN_ID``, ``rmw`` that of ``RMW_IMPLEMENTATION``, ``discovery`` that of
    ``ROS_AUTOMATIC_DISCOVERY_RANGE``, ``transports`` that of ``FASTDDS_BUILTIN_TRANSPORTS``; empty where it is not set.
    ``user`` is the numeric id of its owner.
    """

    pid: int
    command: str
    user: int
    domain: str = ""
    rmw: str = ""
    discovery: str = ""
    transports: str = ""
