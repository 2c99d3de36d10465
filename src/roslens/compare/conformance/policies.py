"""Policies of a quality of service that endpoints exchange during discovery, by name."""

from __future__ import annotations

from roslens.model.qos import Qos

NAMES = ("reliability", "durability", "liveliness", "deadline", "lifespan", "lease")


def policies(qos: Qos, *, certain: bool = True) -> dict[str, str]:
    """Return policies as text; depth and history stay with who has them, and are left out.

    Args:
        qos: of an endpoint.
        certain: whether a policy that it does not state is as in every profile of ROS 2.
    """
    liveliness = qos.liveliness or ("automatic" if certain else "")
    found = {"reliability": qos.reliability, "durability": qos.durability, "liveliness": liveliness}
    for name, seconds in (("deadline", qos.deadline_s), ("lifespan", qos.lifespan_s), ("lease", qos.lease_s)):
        if seconds or certain:
            found[name] = f"{seconds:g} s" if seconds else "none"
    return {name: value for name, value in found.items() if value}
