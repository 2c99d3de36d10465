"""Quality of service that is offered against what is requested: which policies keep two ends of a topic apart.

After DDS 1.4, 2.2.3: a writer and a reader are only joined where all that is offered is at least as strict as what is
requested. Where one policy is not, nothing at all passes between the two.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.qos import Qos


class Mismatch(msgspec.Struct, frozen=True, order=True):
    """A policy that is not met.

    Attributes:
        policy: ``reliability``, ``durability``, ``liveliness``, ``deadline`` or ``lease``.
        requested: by the subscription, in words.
        offered: by the publisher, in words.
        asks: what the subscription asks for by it, in words.
    """

    policy: str
    requested: str
    offered: str
    asks: str


_STRICT = (
    ("reliability", "reliable", "best_effort", "the retransmission of lost messages"),
    ("durability", "transient_local", "volatile", "messages published before it started"),
    ("liveliness", "manual_by_topic", "automatic", "the publisher itself to assert its liveliness"),
)


def mismatches(offered: Qos, requested: Qos) -> Iterator[Mismatch]:
    """Yield each policy that is requested and that the one offered does not meet; what is unknown meets everything.

    Args:
        offered: by a publisher.
        requested: by a subscription.
    """
    for policy, strict, lax, asks in _STRICT:
        if getattr(requested, policy) == strict and getattr(offered, policy) == lax:
            yield Mismatch(policy, strict, lax, asks)
    for policy, want, give, asks in (
        ("deadline", requested.deadline_s, offered.deadline_s, "a notification of late messages"),
        ("lease", requested.lease_s, offered.lease_s, "a notification when the publisher is gone"),
    ):
        if want and (not give or give > want):
            lax = f"one of {give:g} s" if give else f"no {policy}"
            yield Mismatch(policy, f"a {policy} of {want:g} s", lax, asks)
