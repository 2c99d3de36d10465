"""Publishers and subscriptions of one topic that look matched and are not: nothing arrives, without an error."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import combinations, islice, product

from roslens.judge.ranges.qos_match import mismatches
from roslens.model.failure import Failure
from roslens.model.graph import Endpoint, Role
from roslens.model.qos import Qos

TOOL = "ros2"
MOST_PAIRS = 100
"""Of one topic and one reason, which are reported."""

_Kind = tuple[str, str, "Qos | None"]
_Nodes = dict[str, Endpoint]
_Groups = dict[_Kind, _Nodes]


def misfits(endpoints: Iterable[Endpoint]) -> Iterator[Failure]:
    """Yield one failure per pair of nodes, or of a node with itself, that exchange nothing over a topic, and why.

    Where nobody subscribes, publishers of several types are such pairs: no subscription could take what both send.

    What decides is the same of most ends of a topic: each kind of publisher is held against each kind of subscription,
    so that 200 of both cost no more than one of both.
    """
    by_topic: dict[str, tuple[_Groups, _Groups]] = {}
    for endpoint in endpoints:
        if endpoint.role in (Role.PUBLISHER, Role.SUBSCRIPTION):
            groups = by_topic.setdefault(endpoint.name, ({}, {}))[endpoint.role is Role.SUBSCRIPTION]
            groups.setdefault((endpoint.type, endpoint.hash, endpoint.qos), {}).setdefault(endpoint.node, endpoint)
    for topic, (publishers, subscriptions) in sorted(by_topic.items()):
        reported = set()
        for sending, receiving in product(publishers.values(), subscriptions.values()):
            for failure in _misfits_between(topic, sending, receiving):
                if failure not in reported:
                    reported.add(failure)
                    yield failure
        if not any(kind[0] for kind in subscriptions):
            yield from _several_types(topic, publishers)
        yield from _apart(topic, publishers, subscriptions)


def _misfits_between(topic: str, sending: _Nodes, receiving: _Nodes) -> Iterator[Failure]:
    """Yield the misfits of a kind of publishers and a kind of subscriptions: of all their pairs, or of none."""
    if _misfit(topic, *(next(iter(group.values())) for group in (sending, receiving))) is None:
        return
    for publisher, subscription in islice(product(sending.values(), receiving.values()), MOST_PAIRS):
        failure = _misfit(topic, publisher, subscription)
        if failure is not None:
            yield failure


def _apart(topic: str, publishers: _Groups, subscriptions: _Groups) -> Iterator[Failure]:
    """Yield the publishers and subscriptions of ROS 1 that are not connected, though both run."""
    types = {node: type_ for (type_, _, _), nodes in publishers.items() for node in nodes}
    for subscription in (end for nodes in subscriptions.values() for end in nodes.values()):
        for publisher in subscription.apart or ():
            published = types.get(publisher) or "another type"
            yield Failure(
                TOOL, f"{subscription.node} gets nothing of what {publisher} publishes on {topic}: they are not "
                f"connected, though both run; {published} is published",
                "a connection between them", "Give both the same type, built from the same definition; where it is the "
                f"same, see whether {subscription.node} reaches the host of {publisher}", entity=f"topic:{topic}",
            )  # fmt: skip


def _several_types(topic: str, publishers: _Groups) -> Iterator[Failure]:
    """Yield the pairs of publishers whose types differ, where no subscription shows which of them is wrong."""
    by_type: dict[str, str] = {}
    for (type_, _, _), nodes in publishers.items():
        if type_:
            by_type[type_] = min(*nodes, by_type.get(type_, next(iter(nodes))))
    for (first, node), (second, other) in combinations(sorted(by_type.items()), 2):
        yield Failure(
            TOOL, f"{node} and {other} publish different types on {topic}: {first} and {second}",
            "one type for each topic, since a subscription has one", "Give one of the two topics another name",
            entity=f"topic:{topic}",
        )  # fmt: skip


def misfits_by_topic(endpoints: Iterable[Endpoint], *, by_connection: bool = False) -> dict[str, int]:
    """Return how many pairs of nodes exchange nothing over each topic of which both ends are known; 0 where all do.

    ``by_connection`` is the way of ROS 1, whose master tells no types of subscriptions: topics are left out while it is
    not known of each of their subscriptions whether it is connected.
    """
    ends = [end for end in endpoints if end.role in (Role.PUBLISHER, Role.SUBSCRIPTION)]
    if by_connection:
        unknown = {end.name for end in ends if end.role is Role.SUBSCRIPTION and end.apart is None}
        ends = [end for end in ends if end.name not in unknown]
    found = dict.fromkeys((end.name for end in ends if end.type), 0)
    for failure in misfits(ends):
        topic = failure.entity.partition(":")[2]
        found[topic] = found.get(topic, 0) + 1
    return found


def _misfit(topic: str, publisher: Endpoint, subscription: Endpoint) -> Failure | None:
    pair = f"{subscription.node} gets nothing of what {publisher.node} publishes on {topic}"
    entity = f"topic:{topic}"
    if publisher.type and subscription.type and publisher.type != subscription.type:
        return Failure(
            TOOL, f"{pair}: its type is {subscription.type}", f"{publisher.type}, which is published",
            "Give one of the two topics another name", entity=entity,
        )  # fmt: skip
    if publisher.hash and subscription.hash and publisher.hash != subscription.hash:
        return Failure(
            # Fast DDS hands such messages over; they fail to be read, or are read as something else.
            TOOL,
            f"{subscription.node} does not understand what {publisher.node} publishes on {topic}: its definition of "
            f"{publisher.type} is another ({subscription.hash[:14]})",
            f"that of the publisher ({publisher.hash[:14]})",
            "Build both nodes against the same version of the message package", entity=entity,
        )  # fmt: skip
    if publisher.qos is None or subscription.qos is None:
        return None
    reasons = list(incompatible(publisher.qos, subscription.qos))
    if not reasons:
        return None
    wanted, offered = (", ".join(words) for words in zip(*reasons, strict=True))
    return Failure(
        TOOL, f"{pair}: it requests {wanted}", f"a request that is met by what is offered, {offered}",
        "Offer more at the publisher or request less at the subscription", entity=entity,
    )  # fmt: skip


def incompatible(offered: Qos, requested: Qos) -> Iterator[tuple[str, str]]:
    """Yield, in words, each policy that is requested and the one offered that does not meet it."""
    for one in mismatches(offered, requested):
        yield one.requested, one.offered
