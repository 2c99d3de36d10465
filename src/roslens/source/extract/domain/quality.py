"""What is known of a quality of service while source is evaluated: presets, one policy changed, one of several."""

from __future__ import annotations

import re

import msgspec

from roslens.model.qos import Qos
from roslens.source.extract.domain.abstract_value import Named, Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.kinds import (
    all_of_kind,
    has_kind,
    is_number,
    is_whole,
    known_text,
    name_of,
    reason_of,
)
from roslens.source.extract.symbolic.text import Condition, Text

PRESETS = {
    "SensorDataQoS": Qos("best_effort", "volatile", "keep_last", 5),
    "qos_profile_sensor_data": Qos("best_effort", "volatile", "keep_last", 5),
    "SystemDefaultsQoS": Qos(),
    "qos_profile_system_default": Qos(),
    "ServicesQoS": Qos("reliable", "volatile", "keep_last", 10),
    "qos_profile_services_default": Qos("reliable", "volatile", "keep_last", 10),
    "ParametersQoS": Qos("reliable", "volatile", "keep_last", 1000),
    "qos_profile_parameters": Qos("reliable", "volatile", "keep_last", 1000),
    "ParameterEventsQoS": Qos("reliable", "volatile", "keep_last", 1000),
    "qos_profile_parameter_events": Qos("reliable", "volatile", "keep_last", 1000),
    "ClockQoS": Qos("best_effort", "volatile", "keep_last", 1),
    "RosoutQoS": Qos("reliable", "transient_local", "keep_last", 1000),
    "BestAvailableQoS": Qos("best_available", "best_available", "keep_last", 10),
    "rmw_qos_profile_default": Qos("reliable", "volatile", "keep_last", 10),
    "qos_profile_default": Qos("reliable", "volatile", "keep_last", 10),
    "rmw_qos_profile_sensor_data": Qos("best_effort", "volatile", "keep_last", 5),
    "rmw_qos_profile_services_default": Qos("reliable", "volatile", "keep_last", 10),
    "rmw_qos_profile_parameters": Qos("reliable", "volatile", "keep_last", 1000),
    "rmw_qos_profile_parameter_events": Qos("reliable", "volatile", "keep_last", 1000),
    "rmw_qos_profile_system_default": Qos(),
    "rmw_qos_profile_best_available": Qos("best_available", "best_available", "keep_last", 10),
}
_OF_RCLPY = {
    "SENSOR_DATA": PRESETS["qos_profile_sensor_data"],
    "SYSTEM_DEFAULT": PRESETS["qos_profile_system_default"],
    "SERVICES_DEFAULT": PRESETS["qos_profile_services_default"],
    "PARAMETERS": PRESETS["qos_profile_parameters"],
    "PARAMETER_EVENTS": PRESETS["qos_profile_parameter_events"],
    "ACTION_STATUS_DEFAULT": Qos("reliable", "transient_local", "keep_last", 1),
}
"""Of rclpy.qos.QoSPresetProfiles."""
DEFAULT_QUALITY = QosValue(PRESETS["rmw_qos_profile_default"])
INITIALISATION = "rclcpp.QoSInitialization"
QUALITY_TYPES = frozenset({"rclcpp.QoS", "QoS", "rmw_qos_profile_t"})
"""Names of types of C++ whose values are qualities of service, whatever else is known of them."""
DURATIONS = {"deadline": "deadline_s", "lifespan": "lifespan_s", "liveliness_lease_duration": "lease_s"}
_ENDLESS = frozenset({"rclpy.duration.Infinite", "rclpy.qos.Infinite", "RMW_DURATION_INFINITE"})
_WORDS = {
    "reliable": "reliable",
    "best_effort": "best_effort",
    "besteffort": "best_effort",
    "volatile": "volatile",
    "transient_local": "transient_local",
    "transientlocal": "transient_local",
    "keep_last": "keep_last",
    "keeplast": "keep_last",
    "keep_all": "keep_all",
    "keepall": "keep_all",
    "automatic": "automatic",
    "manual_by_topic": "manual_by_topic",
    "manualbytopic": "manual_by_topic",
    "best_available": "best_available",
    "bestavailable": "best_available",
}
_OF_MIDDLEWARE = re.compile("rmw_qos_policy_(?:reliability|durability|history|liveliness)_")
POLICIES = ("reliability", "durability", "history", "liveliness")


def quality_of(value: Value) -> QosValue | None:
    """Return what is given as quality of service as one; a number is a depth."""
    match value:
        case bool():
            return None
        case int():
            return QosValue(Qos("reliable", "volatile", "keep_last", value))
        case Obj():
            return value.held("qos", QosValue)
        case Named() if ".QoSPresetProfiles." in value.name:
            known = _OF_RCLPY.get(value.name.removesuffix(".value").rpartition(".")[2])
            return QosValue(known) if known is not None else None
        case Named() if value.name.rpartition(".")[2] in PRESETS:
            return QosValue(PRESETS[value.name.rpartition(".")[2]])
        case list([Named() as first, *_]) if _OF_MIDDLEWARE.match(_last(first)):
            return profile_of(value)
        case Text():
            return QosValue(Qos(), str(value))
        case Unknown():
            return QosValue(Qos(), str(value.reason))
        case QosValue():
            return value
    return None


def quality_by_key(key: Value) -> QosValue:
    """Return the preset of rclpy that has a short name, as ``sensor_data``."""
    known = _OF_RCLPY.get((known_text(key) or "").upper())
    return QosValue(Qos(), f"the preset {key}") if known is None else QosValue(known)


def keeping(base: QosValue, kept: QosValue) -> QosValue:
    """Return a quality of service with the history that something else says, not the policies."""
    qos_ = msgspec.structs.replace(base.qos, history=kept.qos.history, depth=kept.qos.depth)
    return QosValue(qos_, base.unknown or kept.unknown)


def lasting(base: QosValue, name: str, value: Value) -> QosValue:
    """Return a quality of service with a duration that is given."""
    if name_of(value) in _ENDLESS:
        value = 0
    if is_number(value):
        return QosValue(msgspec.structs.replace(base.qos, **{DURATIONS[name]: float(value)}), base.unknown)
    return QosValue(base.qos, f"its {name.replace('_', ' ')} is unknown")


def with_policy(base: QosValue, name: str, value: Value) -> QosValue:
    """Return a quality of service with a policy that is given by its enumerator."""
    match value:
        case Named():
            word = _WORDS.get(_enumerator(value), "")
        case _:
            word = ""
    if not word:
        return QosValue(msgspec.structs.replace(base.qos, **{name: ""}), f"its {name} is unknown")
    return QosValue(msgspec.structs.replace(base.qos, **{name: word}), base.unknown)


def _enumerator(value: Named) -> str:
    last = _last(value)
    return last[len(found[0]) :] if (found := _OF_MIDDLEWARE.match(last)) else last


def _last(value: Named) -> str:
    return value.name.rpartition(".")[2].lower()


def changed(base: QosValue, name: str, value: Value) -> QosValue:
    """Return a quality of service of which a member is set; what is no part of it changes nothing."""
    if name in POLICIES:
        return with_policy(base, name, value)
    if name in DURATIONS:
        return lasting(base, name, value)
    if name != "depth":
        return base
    if is_whole(value):
        return QosValue(msgspec.structs.replace(base.qos, depth=value), base.unknown)
    return QosValue(msgspec.structs.replace(base.qos, depth=0), f"its depth is {reason_of(value, str(value))}")


def profile_of(policies: list[Value]) -> QosValue:
    """Return a profile of the middleware that is written as its members in their order."""
    names = ("history", "depth", "reliability", "durability", "deadline", "lifespan", "liveliness",
             "liveliness_lease_duration")  # fmt: skip
    found = QosValue(Qos())
    for name, value in zip(names, policies, strict=False):
        found = found if name_of(value).endswith("_DEFAULT") else changed(found, name, value)
    return found


def history_of(history: Value, depth: Value) -> QosValue:
    """Return the usual quality of service with a history, and the number of messages that it keeps."""
    return changed(changed(DEFAULT_QUALITY, "history", history), "depth", depth)


def one_of(value: Value, other: Value, condition: Condition) -> QosValue | None:
    """Return what two qualities of service have in common, of which a condition chooses; None where neither is one."""
    if not has_kind((value, other), QosValue) and not _presets(value, other):
        return None
    first, second = quality_of(value), quality_of(other)
    if first is None or second is None:
        return QosValue(Qos(), f"one of two by {condition}"[:200])
    agreed = {
        name: getattr(first.qos, name) for name in Qos.__struct_fields__
        if getattr(first.qos, name) == getattr(second.qos, name)
    }  # fmt: skip
    differ = len(agreed) < len(Qos.__struct_fields__)
    return QosValue(Qos(**agreed), first.unknown or second.unknown or (f"one of two by {condition}"[:200] * differ))


def _presets(value: Value, other: Value) -> bool:
    # A number is a depth only beside a quality of service.
    return any(quality_of(one) is not None for one in all_of_kind((value, other), Named))
