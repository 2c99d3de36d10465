"""Rule ``graph.qos``: what a subscription requests is not offered, so nothing passes."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.judge.ranges.qos_match import Mismatch, mismatches
from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.graph import Role
from roslens.model.graphs.end import End, Key
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.graph.doubt import exclude_each_other, weighed, weighed_apart
from roslens.source.rules.graph.ends import by_name, conditions_of, ends, listed
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.qos",
    "Incompatible quality of service",
    "A subscription requests more than a publisher of its topic offers: reliable against best effort, transient local "
    "against volatile, a shorter deadline or lease duration, a stricter liveliness. The two are never connected. It "
    "is an error if the subscription receives nothing from any publisher, a warning if it loses one of its "
    "publishers. Unknown policies are assumed to be compatible. Offer more at the publisher, or request less at the "
    "subscription.",
    Consequence.WRONG,
    Certainty.PROVEN,
    ("ros", "graph", "qos", "connectivity"),
    "Publisher and subscription both exist and seem connected, but no message arrives and neither of them fails: the "
    "middleware only logs one warning, which is easily missed.",
    url="https://docs.ros.org/en/rolling/Concepts/Intermediate/About-Quality-of-Service-Settings.html",
)


class _Pair(msgspec.Struct, frozen=True):
    publisher: End
    subscription: End


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each topic and each set of policies that keeps ends of it apart."""
    for (kind, name), all_ends in by_name(ends(configuration)).items():
        if kind == "topic":
            yield from _of_topic(name, all_ends, together=surroundings.together)


def _of_topic(name: str, all_ends: list[End], *, together: bool) -> Iterator[Finding]:
    publishers = [end for end in all_ends if end.role is Role.PUBLISHER]
    pairs: dict[tuple[Mismatch, ...], list[_Pair]] = {}
    fed: set[Key] = set()
    for subscription in (end for end in all_ends if end.role is Role.SUBSCRIPTION):
        for publisher in publishers:
            if exclude_each_other(publisher.clauses, subscription.clauses):
                continue
            lacking = tuple(sorted(_lacking(publisher, subscription)))
            if lacking:
                pairs.setdefault(lacking, []).append(_Pair(publisher, subscription))
            else:
                fed.add(subscription.key)
    for lacking, joined in pairs.items():
        yield _told(name, lacking, joined, fed, together=together)


def _lacking(publisher: End, subscription: End) -> Iterator[Mismatch]:
    offered, requested = publisher.one.endpoint.qos, subscription.one.endpoint.qos
    if offered is None or requested is None:
        return
    for one in mismatches(offered, requested):
        # No limit and an unknown one are the same number: a publisher of which a part is unknown may have one.
        if one.policy in ("deadline", "lease") and publisher.one.qos_unknown:
            continue
        yield one


def _told(name: str, lacking: tuple[Mismatch, ...], joined: list[_Pair], fed: set[Key], *, together: bool) -> Finding:
    starved = [pair for pair in joined if pair.subscription.key not in fed]
    pair = (starved or joined)[0]
    publisher, subscription = pair.publisher, pair.subscription
    certainty, doubt = weighed(
        RULE.certainty if starved else Certainty.LIKELY,
        (publisher.one.proof, subscription.one.proof),
        conditions_of(publisher, subscription),
    )
    if not together:
        certainty, doubt = weighed_apart(doubt)
    requested = ", ".join(one.requested for one in lacking)
    offered = ", ".join(one.offered for one in lacking)
    asks = "; ".join(one.asks for one in lacking)
    loss = "it receives nothing" if starved else "it receives nothing from this publisher, but from others"
    rest = len({(one.publisher.key, one.subscription.key) for one in joined}) - 1
    others = [one.subscription.label for one in joined if one.subscription.key != subscription.key]
    others += [one.publisher.label for one in joined if one.publisher.key != publisher.key]
    more = f" The same between {rest} more pair{'s' if rest > 1 else ''}: {listed(others)}." if rest else ""
    message = (
        f"{subscription.label} requests {requested} on {name}, {publisher.label} offers {offered}: {loss} "
        f"(it requires {asks}).{more} Offer {requested} at the publisher or request {offered} at the subscription."
    )
    context = " ".join((*(one.policy for one in lacking), subscription.node.name, publisher.node.name))
    return occurrence(
        RULE,
        message,
        subscription.where,
        entity=subscription.entity,
        certainty=certainty,
        context=context,
        doubt=doubt,
    )
