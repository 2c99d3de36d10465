"""Parameters that set the quality of service of an endpoint, where its code allows that.

A node declares one for each policy, below ``qos_overrides``, the resolved name of the topic, and ``publisher`` or
``subscription`` (rclcpp, detail/qos_parameters.hpp; rclpy, qos_overriding_options.py).
"""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import EndpointFact, Overrides, ParameterFact, Sure
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.text import Text, unknown

_SPACE = "qos_overrides."
_WORDS = {
    "reliability": ("reliable", "best_effort", "system_default", "best_available"),
    "durability": ("volatile", "transient_local", "system_default", "best_available"),
    "history": ("keep_last", "keep_all", "system_default"),
    "liveliness": ("automatic", "manual_by_topic", "system_default", "best_available"),
}
_DEFAULT = "system_default"
_DURATIONS = {"deadline": "deadline_s", "lifespan": "lifespan_s", "liveliness_lease_duration": "lease_s"}
_NANO = 1e-9
_NEVER_NS = 2**63 - 1
"""A duration without an end, as parameters hold it."""
_PUBLISHERS_ONLY = frozenset({"lifespan"})
_ROLES = frozenset({Role.PUBLISHER, Role.SUBSCRIPTION})


class Overriding:
    """What parameters set of the endpoints of one node, taken in the order in which code makes them.

    Attributes:
        declared: the parameters that are declared for that.
    """

    def __init__(self, values: Values, *, shared: bool) -> None:
        """Begin with the parameters that are set for the node.

        Args:
            values: they.
            shared: whether endpoints may have one profile as an object: rclpy changes it for all that are made of it
                later. rclcpp takes a copy.
        """
        self.declared: list[ParameterFact] = []
        self._values, self._shared = values, shared
        self._changed: list[tuple[Qos, str]] = []

    def take(self, fact: EndpointFact, topic: Text, sure: Sure = Sure.CERTAIN, *, looped: bool = False) -> EndpointFact:
        """Return an endpoint with the quality of service that parameters give it.

        Args:
            fact: the endpoint.
            topic: its resolved name.
            sure: how sure that name is.
            looped: whether it is one of several that are made at one place, nobody knows in which order.
        """
        if fact.role not in _ROLES or fact.qos is None:
            return fact
        may = fact.overrides or Overrides(())
        suffix = f"_{may.id}" if may.id else ""
        ending = f".{fact.role.value}{suffix}."
        prefix = Text.of(_SPACE, topic, ending)
        policies = [one for one in may.policies if fact.role is Role.PUBLISHER or one not in _PUBLISHERS_ONLY]
        own = [] if prefix.holes else [one for one in policies if self._values.value(Text.of(prefix, one)) is not None]
        doubtful = self._doubtful(fact.qos, ending if looped else "", policies, own) if self._shared else []
        base = fact if not doubtful else _unsure(fact, doubtful, "parameters change its profile for another endpoint")
        self._declare(base, prefix, policies, may, sure)
        open_ = prefix.holes or may.conditions or may.unknown
        set_ = own if not open_ or not any(name.startswith(_SPACE) for name in self._values.set) else policies
        self._changed += [(fact.qos, one) for one in set_]
        return _changed(base, may, prefix, policies, self._values)

    def _doubtful(self, qos: Qos, ending: str, policies: list[str], own: list[str]) -> list[str]:
        """Return the policies that parameters of other endpoints may have changed."""
        found = {policy for other, policy in self._changed if other == qos}
        if ending:
            found |= {one for one in policies for name in self._values.set if name.endswith(ending + one)}
        return sorted(found.difference(own))

    def _declare(self, fact: EndpointFact, prefix: Text, policies: list[str], may: Overrides, sure: Sure) -> None:
        conditions = (*fact.conditions, *may.conditions)
        place = msgspec.structs.replace(fact.evidence, sure=sure)
        self.declared += [
            ParameterFact(Text.of(prefix, one), place, "declared", _KINDS.get(one, "string"),
                          _default(fact, one), conditions=conditions)
            for one in policies
        ]  # fmt: skip


_KINDS = {"depth": "int", "avoid_ros_namespace_conventions": "bool", **dict.fromkeys(_DURATIONS, "int")}


def _default(fact: EndpointFact, policy: str) -> Text:
    """Return the default of a parameter: what the code gives; durations in nanoseconds."""
    qos = fact.qos or Qos()
    if fact.qos_unknown or fact.qos is None:
        return unknown(f"the {policy.replace('_', ' ')} in the code")
    if policy in _DURATIONS:
        return Text.of(str(round(getattr(qos, _DURATIONS[policy]) / _NANO)))
    if policy == "avoid_ros_namespace_conventions":
        return Text.of("false")
    if policy == "depth":
        return Text.of(str(qos.depth))
    return Text.of(getattr(qos, policy) or _DEFAULT)


def _changed(fact: EndpointFact, may: Overrides, prefix: Text, policies: list[str], values: Values) -> EndpointFact:
    if fact.overrides is None:
        return fact
    if prefix.holes or may.unknown or may.conditions:
        # Who sets nothing below ``qos_overrides`` changes nothing.
        if not any(name.startswith(_SPACE) for name in values.set):
            return fact
        return _unsure(fact, policies or list(_WORDS), "parameters below qos_overrides may set it")
    for policy in policies:
        setting = values.value(Text.of(prefix, policy))
        if setting is not None:
            fact = _with(fact, policy, setting)
    return fact


def _with(fact: EndpointFact, policy: str, setting: Setting) -> EndpointFact:
    """Return an endpoint with one policy as a parameter sets it."""
    known, qos = setting.value.known, fact.qos or Qos()
    value = None if known is None else _value(policy, known.strip().strip("'\""))
    if value is None:
        where = f"{setting.evidence.path}:{setting.evidence.line}"
        return _unsure(fact, [policy], f"its {policy.replace('_', ' ')} is set to {setting.value} ({where})")
    return msgspec.structs.replace(fact, qos=msgspec.structs.replace(qos, **value))


def _value(policy: str, written: str) -> dict[str, Any] | None:
    """Return the field of a quality of service that a value of a parameter means; None where it is none."""
    if policy in _WORDS:
        return {policy: "" if written == _DEFAULT else written} if written in _WORDS[policy] else None
    if policy == "avoid_ros_namespace_conventions":
        return {} if written.lower() in ("true", "false") else None
    if not written.isdigit():
        return None
    if policy == "depth":
        return {"depth": int(written)}
    return {_DURATIONS[policy]: 0.0 if int(written) >= _NEVER_NS else int(written) * _NANO}


def _unsure(fact: EndpointFact, policies: list[str], reason: str) -> EndpointFact:
    empty: dict[str, Any] = {}
    for one in policies:
        if one in _WORDS:
            empty[one] = ""
        elif one in _DURATIONS:
            empty[_DURATIONS[one]] = 0.0
        elif one == "depth":
            empty["depth"] = 0
    qos = msgspec.structs.replace(fact.qos or Qos(), **empty)
    return msgspec.structs.replace(fact, qos=qos, qos_unknown=fact.qos_unknown or reason)
