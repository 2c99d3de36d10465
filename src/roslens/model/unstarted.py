"""Why code that makes endpoints is in no node that is known, by what it is."""

from __future__ import annotations

from types import MappingProxyType

REASONS = MappingProxyType(
    {
        "program": "a program that no build makes or installs",
        "script": "a script that nothing starts by name",
        "plugin": "a plug-in that no known program loads",
        "library": "code of a library that no known program uses",
    }
)
"""By the kind of a :class:`~roslens.model.configuration.ConfiguredNode` that stands for such code."""
