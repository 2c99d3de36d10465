"""Offered profiles as recordings store them: YAML with numbers until rosbag2's format 8, with words since."""

from __future__ import annotations

from typing import Any

from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.model.qos import Qos

_LONGEST_TEXT = 100_000
# A recorder writes "no limit" as the largest time it knows, either 64 bits of nanoseconds or 32 bits of seconds.
_UNLIMITED_S = 2**31 - 1
_WORDS: dict[str, dict[object, str]] = {
    "reliability": {1: "reliable", 2: "best_effort"},
    "durability": {1: "transient_local", 2: "volatile"},
    "history": {1: "keep_last", 2: "keep_all"},
    "liveliness": {1: "automatic", 3: "manual_by_topic"},
}


def profiles_of(text: str) -> list[Qos]:
    """Return the profiles in a text, none where it holds none that can be read."""
    if not text or len(text) > _LONGEST_TEXT:
        return []
    try:
        document = load_yaml(text)
    except UnsafeYamlError:
        return []
    if not isinstance(document, list):
        return []
    return [_profile(entry) for entry in document if isinstance(entry, dict)]


def _profile(entry: dict[str, Any]) -> Qos:
    depth = entry.get("depth")
    return Qos(
        _word("reliability", entry),
        _word("durability", entry),
        _word("history", entry),
        depth if type(depth) is int and depth >= 0 else 0,
        _seconds(entry.get("deadline")),
        _seconds(entry.get("lifespan")),
        _word("liveliness", entry),
        _seconds(entry.get("liveliness_lease_duration")),
    )


def _word(policy: str, entry: dict[str, Any]) -> str:
    value = entry.get(policy)
    words = _WORDS[policy]
    if isinstance(value, str):
        return value if value in words.values() else ""
    return words.get(value, "") if type(value) is int else ""


def _seconds(value: object) -> float:
    if not isinstance(value, dict):
        return 0.0
    seconds, nanoseconds = value.get("sec"), value.get("nsec", 0)
    if type(seconds) is not int or type(nanoseconds) is not int or not 0 <= seconds < _UNLIMITED_S:
        return 0.0
    return seconds + nanoseconds * 1e-9
