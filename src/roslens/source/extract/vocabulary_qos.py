"""The vocabulary of quality of service of rclcpp and rclpy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import msgspec

from roslens.model.qos import Qos
from roslens.source.extract.abstract_value import Named, Obj, QosValue, Unknown
from roslens.source.extract.text import Text
from roslens.source.extract.vocabulary import Called, method, outer

if TYPE_CHECKING:
    from roslens.source.extract.evaluation import Evaluation

_PRESETS = {
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
    "SENSOR_DATA": _PRESETS["qos_profile_sensor_data"],
    "SYSTEM_DEFAULT": _PRESETS["qos_profile_system_default"],
    "SERVICES_DEFAULT": _PRESETS["qos_profile_services_default"],
    "PARAMETERS": _PRESETS["qos_profile_parameters"],
    "PARAMETER_EVENTS": _PRESETS["qos_profile_parameter_events"],
    "ACTION_STATUS_DEFAULT": Qos("reliable", "transient_local", "keep_last", 1),
}
"""Of rclpy.qos.QoSPresetProfiles."""
_DEFAULT = _PRESETS["rmw_qos_profile_default"]
_INITIALISATION = "rclcpp.QoSInitialization"
_DURATIONS = {"deadline": "deadline_s", "lifespan": "lifespan_s", "liveliness_lease_duration": "lease_s"}
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


def quality_of(value: Any) -> Any:
    """Return what is given as quality of service as one; a number is a depth."""
    if isinstance(value, bool):
        return None
    if isinstance(value, int):
        return QosValue(Qos("reliable", "volatile", "keep_last", value))
    if isinstance(value, Obj) and isinstance(value.fields.get("qos"), QosValue):
        return value.fields["qos"]
    if isinstance(value, Named) and ".QoSPresetProfiles." in value.name:
        known = _OF_RCLPY.get(value.name.removesuffix(".value").rpartition(".")[2])
        return QosValue(known) if known is not None else None
    if isinstance(value, Named) and value.name.rpartition(".")[2] in _PRESETS:
        return QosValue(_PRESETS[value.name.rpartition(".")[2]])
    if isinstance(value, Text | Unknown):
        reason = value.reason if isinstance(value, Unknown) else str(value)
        return QosValue(Qos(), reason)
    return value if isinstance(value, QosValue) else None


@outer("rclcpp.QoS", "rclpy.qos.QoSProfile", "rclpy.qos.QoSPresetProfiles.get_from_short_key")
def qos(_engine: Evaluation, thing: Any, called: Called) -> Any:
    """A quality of service."""
    value = _from_words(called)
    if isinstance(thing, Obj):
        thing.fields["qos"] = value
        return thing
    return value


def _from_words(called: Called) -> QosValue:
    base = QosValue(Qos("reliable", "volatile", "keep_last", 0))
    first = called.argument(0, "depth", "history_depth")
    if isinstance(first, Obj) and first.type == _INITIALISATION:
        base = _keeping(quality_of(called.argument(1)) or QosValue(_DEFAULT), first.fields["qos"])
    elif isinstance(first, QosValue):
        base = first
    elif isinstance(first, int) and not isinstance(first, bool):
        base = QosValue(Qos("reliable", "volatile", "keep_last", first))
    elif isinstance(first, Named):
        base = quality_of(first) or base
    elif isinstance(first, Text | Unknown):
        reason = first.reason if isinstance(first, Unknown) else str(first)
        base = QosValue(Qos("reliable", "volatile", "keep_last", 0), f"its depth is {reason}")
    for name, value in called.keywords.items():
        if name in ("reliability", "durability", "history", "liveliness"):
            base = _with(base, name, value)
        elif name in _DURATIONS:
            base = _lasting(base, name, value)
    return base


def _keeping(base: QosValue, kept: QosValue) -> QosValue:
    """Return a quality of service with the history that something else says, not the policies."""
    qos_ = msgspec.structs.replace(base.qos, history=kept.qos.history, depth=kept.qos.depth)
    return QosValue(qos_, base.unknown or kept.unknown)


def _lasting(base: QosValue, name: str, value: Any) -> QosValue:
    if isinstance(value, Named) and value.name in _ENDLESS:
        value = 0
    if isinstance(value, int | float) and not isinstance(value, bool):
        return QosValue(msgspec.structs.replace(base.qos, **{_DURATIONS[name]: float(value)}), base.unknown)
    return QosValue(base.qos, f"its {name.replace('_', ' ')} is not known")


def _with(base: QosValue, name: str, value: Any) -> QosValue:
    word = _WORDS.get(value.name.rpartition(".")[2].lower(), "") if isinstance(value, Named) else ""
    if not word:
        return QosValue(msgspec.structs.replace(base.qos, **{name: ""}), f"its {name} is not known")
    return QosValue(msgspec.structs.replace(base.qos, **{name: word}), base.unknown)


@outer("rclcpp.KeepLast", "rclcpp.KeepAll", "rclcpp.QoSInitialization.from_rmw")
def keep(_engine: Evaluation, _thing: Any, called: Called) -> Any:
    """How many messages are kept."""
    first = called.argument(0)
    if called.name.endswith("from_rmw"):
        value = quality_of(first) or QosValue(Qos(), "a profile of the middleware")
    elif called.name.endswith("All"):
        value = QosValue(Qos(history="keep_all", depth=0))
    else:
        value = (quality_of(first) if first is not None else None) or QosValue(Qos(), "how many messages are kept")
    return Obj(_INITIALISATION, None, {"qos": _keeping(QosValue(_DEFAULT), value)})


@outer(*(f"{module}.{name}" for module in ("rclcpp", "rclpy.qos", "rclcpp.qos") for name in _PRESETS))
def preset(_engine: Evaluation, thing: Any, called: Called) -> Any:
    """A quality of service that has a name, with the history that it is given."""
    value = QosValue(_PRESETS[called.name.rpartition(".")[2]])
    first = called.argument(0)
    if isinstance(first, Obj) and first.type == _INITIALISATION:
        value = _keeping(value, first.fields["qos"])
    elif first is not None:
        value = QosValue(value.qos, "how many messages it keeps")
    if isinstance(thing, Obj):
        thing.fields["qos"] = value
        return thing
    return value


@method("qos", "reliable", "best_effort", "transient_local", "durability_volatile", "keep_all", "keep_last",
        "reliability", "durability", "history", "liveliness", "deadline", "lifespan",
        "liveliness_lease_duration", "avoid_ros_namespace_conventions", "reliability_best_available",
        "durability_best_available", "get_rmw_qos_profile")  # fmt: skip
def refined(engine: Evaluation, thing: Any, called: Called) -> Any:
    """A quality of service with one policy changed."""
    del engine
    base = thing.fields["qos"] if isinstance(thing, Obj) else thing
    found = _refined(base, called)
    if isinstance(thing, Obj):
        thing.fields["qos"] = found
        return thing
    return found


for _name in ("QoS", "rclcpp.QoS", "rclcpp.SensorDataQoS", "rclcpp.SystemDefaultsQoS", "rclcpp.ServicesQoS"):
    method(_name, "reliable", "best_effort", "transient_local", "durability_volatile", "keep_all", "keep_last",
           "reliability", "durability", "history", "deadline", "lifespan", "liveliness")(refined)  # fmt: skip


def _refined(base: QosValue, called: Called) -> QosValue:
    name, qos_ = called.name, base.qos
    fixed = {"reliable": {"reliability": "reliable"}, "best_effort": {"reliability": "best_effort"},
             "transient_local": {"durability": "transient_local"}, "durability_volatile": {"durability": "volatile"},
             "keep_all": {"history": "keep_all"}, "reliability_best_available": {"reliability": "best_available"},
             "durability_best_available": {"durability": "best_available"}}  # fmt: skip
    if name in fixed:
        return QosValue(msgspec.structs.replace(qos_, **fixed[name]), base.unknown)
    first = called.argument(0)
    if name == "keep_last" and isinstance(first, int):
        return QosValue(msgspec.structs.replace(qos_, history="keep_last", depth=first), base.unknown)
    if name in ("reliability", "durability", "history", "liveliness") and first is not None:
        return _with(base, name, first)
    return _lasting(base, name, first) if name in _DURATIONS else base
