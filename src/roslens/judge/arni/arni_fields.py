"""What the fields of an ARNI specification are in roslens' words.

Source: the messages of ARNI 1.1 (`arni_msgs`, `rosgraph_msgs/TopicStatistics`) and how its processing node rates them.
"""

from __future__ import annotations

import msgspec

from roslens.model.entity import EntityKind


class ArniField(msgspec.Struct, frozen=True):
    """A field of ARNI's statistics.

    Attributes:
        signal: key of the signal; empty where roslens measures no such thing.
        factor: by which ARNI's numbers become those of the signal.
        percentile: 100 where ARNI means the greatest sample.
        note: what is different; empty for nothing.
        array: whether it is a list, one item for each core, interface or drive.
    """

    signal: str = ""
    factor: float = 1.0
    percentile: float = 0.0
    note: str = ""
    array: bool = False


_NEVER_RATED = "ARNI never rated it, since it compared a duration with a number; now it is rated"
_NEVER_MEASURED = "ARNI never measured it; it is now rated if the host reports it"
_SPREAD = ArniField(note="roslens does not measure how much it spreads; write a percentile, such as `p95 <= …`")
_GREATEST = "the greatest of the values in the window"
_EACH = "ARNI had a range for each; roslens rates the worst of them"
_CONNECTED = {
    "frequency": ArniField("rate"),
    "bandwidth": ArniField("bandwidth"),
    "dropped_msgs": ArniField(note="a count in a window of unknown length; write `loss` in percent"),
    "stamp_age_mean": ArniField("age", note=_NEVER_RATED),
    "stamp_age_max": ArniField("age_max", note=_NEVER_RATED),
    "stamp_age_stddev": _SPREAD,
    "period_mean": ArniField("period", note=_NEVER_RATED),
    "period_max": ArniField("largest_gap", note=f"{_NEVER_RATED}, the gap that is still going on included"),
    "period_stddev": ArniField("jitter", note=_NEVER_RATED),
    "delivered_msgs": ArniField(note="ARNI left it out too; write `rate`"),
    "traffic": ArniField(note="ARNI left it out too; write `bandwidth`"),
}

FIELDS: dict[EntityKind, dict[str, ArniField]] = {
    EntityKind.TOPIC: _CONNECTED,
    EntityKind.CONNECTION: _CONNECTED,
    EntityKind.HOST: {
        "cpu_usage_mean": ArniField("cpu"),
        "cpu_usage_max": ArniField("cpu", percentile=100, note=_GREATEST),
        "cpu_usage_core_mean": ArniField("cpu_core_max", note=_EACH, array=True),
        "cpu_usage_core_max": ArniField("cpu_core_max", percentile=100, note=f"{_EACH}, {_GREATEST}", array=True),
        "cpu_temp_mean": ArniField("temperature", note="the hottest sensor"),
        "cpu_temp_max": ArniField("temperature", percentile=100, note=f"the hottest sensor, {_GREATEST}"),
        "cpu_temp_core_mean": ArniField("temperature", note=_EACH, array=True),
        "cpu_temp_core_max": ArniField("temperature", percentile=100, note=f"{_EACH}, {_GREATEST}", array=True),
        "gpu_temp_mean": ArniField("gpu_temperature", note=_NEVER_MEASURED, array=True),
        "gpu_usage_mean": ArniField("gpu", note=_NEVER_MEASURED, array=True),
        "ram_usage_mean": ArniField("memory_share"),
        "ram_usage_max": ArniField("memory_share", percentile=100, note=_GREATEST),
        "message_frequency_mean": ArniField(note="packets per second of each interface, which roslens does not count"),
        "bandwidth_mean": ArniField(note="in and out were one; write `network_in` or `network_out`"),
        "drive_free_space": ArniField("disk_free", 2.0**20, note=_EACH, array=True),
        "drive_read": ArniField("disk_read", note="all drives together", array=True),
        "drive_write": ArniField("disk_write", note="all drives together", array=True),
    },
    EntityKind.NODE: {
        "node_cpu_usage_mean": ArniField("cpu"),
        "node_cpu_usage_max": ArniField("cpu", percentile=100, note=_GREATEST),
        "node_ramusage_mean": ArniField("memory_share"),
        "node_ramusage_max": ArniField("memory_share", percentile=100, note=_GREATEST),
        "node_write_mean": ArniField("disk_write", note="ARNI added what was read to it"),
        "node_read_mean": ArniField("disk_read", note="ARNI always measured 0"),
        "node_message_frequency_mean": ArniField(note="ARNI measured a period there; write `rate` of the topics"),
        "node_bandwidth_mean": ArniField(note="bytes in a window, not per second; write `bandwidth` of the topics"),
        "node_cpu_usage_core_mean": ArniField(note="roslens does not split the CPU of a node by core; write `cpu`"),
    },
}
"""Kind of entity to the fields that ARNI has of it. What ends in ``_stddev`` is a spread, whatever it is of."""


def field_of(kind: EntityKind, name: str) -> ArniField | None:
    """Return what a field means, None for one that ARNI does not have."""
    known = FIELDS[kind].get(name)
    if known is None and name.endswith("_stddev") and name.replace("_stddev", "_mean") in FIELDS[kind]:
        return _SPREAD
    if known is None and name.endswith("_max") and name.replace("_max", "_mean") in FIELDS[kind]:
        mean = FIELDS[kind][name.replace("_max", "_mean")]
        note = f"{mean.note}, {_GREATEST}" if mean.note else _GREATEST
        return mean if not mean.signal else msgspec.structs.replace(mean, percentile=100.0, note=note)
    return known
