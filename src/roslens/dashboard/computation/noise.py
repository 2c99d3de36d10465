"""What of a computation graph is the same in every system and hides what is not: presets that leave it out."""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase

import msgspec

NONE = "none"
"""Stands in an address for: nothing is left out."""


class Preset(msgspec.Struct, frozen=True):
    """Names that are left out together, as patterns of the shell; ``on`` where that holds until the reader chooses."""

    key: str
    title: str
    patterns: tuple[str, ...] = ()
    on: bool = False


IMPLICIT = "implicit"
PRESETS = (
    Preset(IMPLICIT, "what every node has", on=True),
    Preset("rosout", "/rosout", ("*/rosout", "*/rosout_agg"), on=True),
    Preset("events", "/parameter_events", ("*/parameter_events",), on=True),
    Preset(
        "parameters",
        "parameter services",
        (
            "*/describe_parameters",
            "*/get_parameter_types",
            "*/get_parameters",
            "*/list_parameters",
            "*/set_parameters",
            "*/set_parameters_atomically",
            "*/get_type_description",
            "*/get_logger_levels",
            "*/set_logger_levels",
            "*/get_loggers",
            "*/set_logger_level",
            "*/parameter_descriptions",
            "*/parameter_updates",
        ),
        on=True,
    ),
    Preset(
        "lifecycle",
        "life cycle services",
        (
            "*/change_state",
            "*/get_state",
            "*/get_available_states",
            "*/get_available_transitions",
            "*/get_transition_graph",
            "*/transition_event",
        ),
        on=True,
    ),
    Preset("tf", "/tf", ("*/tf", "*/tf_static")),
    Preset(
        "debug",
        "debug topics",
        (
            "*debug*",
            "*/statistics",
            "*/diagnostics",
            "*/diagnostics_agg",
            "*/bond",
            "*/compressed",
            "*/compressedDepth",
            "*/theora",
            "*visualization*",
            "*_marker",
            "*_markers",
        ),
    ),
)
DEFAULT = frozenset(preset.key for preset in PRESETS if preset.on)


def kinds_of_noise(name: str) -> tuple[str, ...]:
    """Return the presets that leave out a topic or service of this name."""
    return tuple(preset.key for preset in PRESETS if matches(name, preset.patterns))


def matches(name: str, patterns: Iterable[str]) -> bool:
    """Return whether the name fits any of the patterns; one without a wildcard also means what lies below it."""
    return any(
        fnmatchcase(name, pattern) or (not set(pattern) & set("*?[") and name.startswith(pattern.rstrip("/") + "/"))
        for pattern in patterns
    )


def presets_of(text: str) -> frozenset[str]:
    """Return the presets that an address names: the default ones where it names none."""
    if not text:
        return DEFAULT
    known = {preset.key for preset in PRESETS}
    return frozenset(part for part in text.split(",") if part in known)
