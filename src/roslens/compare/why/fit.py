"""Whether the ends of a name fit each other: their types, and what they offer and request."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.judge.ranges.qos_match import mismatches
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.graph import Endpoint, Role
from roslens.model.qos import quality_text

_MOST = 8


class Placed(msgspec.Struct, frozen=True):
    """An endpoint, and where it comes from, in words; ``uncertain`` where a part of its quality is not known."""

    endpoint: Endpoint
    place: str = ""
    uncertain: bool = False

    @property
    def label(self) -> str:
        """The node and the place."""
        return f"{self.endpoint.node} ({self.place})" if self.place else self.endpoint.node


def type_fit(ends: Sequence[Placed], of: str) -> Step | None:
    """Return whether all ends have one type and one version of it; None where no type is known."""
    by_type: dict[tuple[str, str], list[Placed]] = {}
    for one in ends:
        if one.endpoint.type:
            by_type.setdefault((one.endpoint.type, one.endpoint.hash), []).append(one)
    if not by_type:
        return None
    names = {name for name, _ in by_type}
    hashes = {digest for _, digest in by_type if digest}
    if len(names) == 1 and len(hashes) < 2:
        return Step(Asks.TYPE, StepState.OK, f"all ends have {next(iter(names))}", of)
    lines = tuple(
        f"{name}{f' ({digest[:16]}…)' if digest and len(names) == 1 else ''}: {one.label}"
        for (name, digest), several in sorted(by_type.items())
        for one in several
    )
    if len(names) > 1:
        says = f"its ends have {len(names)} types, {' and '.join(sorted(names))}: those never meet"
        return Step(Asks.TYPE, StepState.NOT, says, of, lines[:_MOST], "use one type on both sides")
    says = f"its ends have {len(hashes)} versions of {next(iter(names))}: those cannot read each other"
    return Step(Asks.TYPE, StepState.NOT, says, of, lines[:_MOST], "build both sides with the same definition")


def qos_fit(ends: Sequence[Placed], of: str) -> Step | None:
    """Return whether each subscription is offered what it requests; None where either side or its quality is unknown.

    One that receives from nobody is a cause. One that receives from some publishers is told in the evidence.
    """
    publishers = [one for one in ends if one.endpoint.role is Role.PUBLISHER]
    subscriptions = [one for one in ends if one.endpoint.role is Role.SUBSCRIPTION]
    known = [one for one in (*publishers, *subscriptions) if one.endpoint.qos is not None]
    if not publishers or not subscriptions or not known:
        return None
    lines, starved, reasons = [], [], set[str]()
    for sub in subscriptions:
        apart = {pub.label: _lacking(pub, sub) for pub in publishers}
        lines += [f"{sub.label} and {label}: {words}" for label, words in apart.items() if words]
        if all(apart.values()):
            starved.append(sub)
            reasons.update(apart.values())
    if starved:
        names = ", ".join(dict.fromkeys(one.endpoint.node for one in starved))
        reason = reasons.pop() if len(reasons) == 1 else "each publisher offers less than is requested"
        says = f"{names} can receive nothing: {reason}"
        how = "offer more at the publisher, or request less at the subscription"
        return Step(Asks.QOS, StepState.NOT, says, of, tuple(lines[:_MOST]), how)
    if len(known) < len(publishers) + len(subscriptions):
        unknown = [one.label for one in (*publishers, *subscriptions) if one.endpoint.qos is None]
        says = f"what is known fits; unknown of {', '.join(unknown[:_MOST])}"
        return Step(Asks.QOS, StepState.UNSEEN, says, of, tuple(lines[:_MOST]), "ROS 2 tells it while it runs")
    offered = " / ".join(dict.fromkeys(quality_text(one.endpoint.qos) for one in publishers if one.endpoint.qos))
    says = "every subscription is offered what it requests"
    if lines:
        says = "every subscription has a publisher that fits it, but not all fit"
    return Step(Asks.QOS, StepState.OK, says, of, tuple(lines[:_MOST]) or (f"offered: {offered}",))


def _lacking(publisher: Placed, subscription: Placed) -> str:
    offered, requested = publisher.endpoint.qos, subscription.endpoint.qos
    if offered is None or requested is None:
        return ""
    found = [
        one for one in mismatches(offered, requested)
        # No limit and an unknown one are the same number.
        if not (publisher.uncertain and one.policy in ("deadline", "lease"))
    ]  # fmt: skip
    return "; ".join(f"{one.requested} is requested, {one.offered} offered" for one in found)
