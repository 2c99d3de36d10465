"""What a user set for a plug-in, held against what the plug-in declares."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from roslens.model.errors import UsageError
from roslens.plugins.nearest import did_you_mean
from roslens.plugins.points import Manifest, Option

TYPES: dict[str, tuple[type, ...]] = {
    "str": (str,),
    "int": (int,),
    "float": (float, int),
    "bool": (bool,),
    "list": (list, tuple),
}
"""The types an option may have, and the Python types of their values."""


def check_option(option: Option, value: object) -> str:
    """Return what the value is instead of the declared type; empty when it fits."""
    fits = isinstance(value, TYPES[option.type]) and (option.type == "bool" or not isinstance(value, bool))
    if not fits:
        return f"{value!r} ({type(value).__name__})"
    if option.type == "list" and isinstance(value, list | tuple):
        for item in value:
            if not isinstance(item, str):
                return f"a list with {item!r} ({type(item).__name__})"
    return ""


def resolve_options(manifest: Manifest, given: Mapping[str, object]) -> dict[str, Any]:
    """Return the value of every option of a plug-in: what the user gave, else its default.

    Raises:
        UsageError: an option is unknown or has the wrong type; names the nearest known one.
    """
    declared = {option.name: option for option in manifest.options}
    for name, value in given.items():
        where = f"[options.{manifest.name}] {name}"
        option = declared.get(name)
        if option is None:
            expected = f"one of {', '.join(sorted(declared))}" if declared else "no option: the plug-in has none"
            raise UsageError(
                f"unknown option {name!r}", where=where, expected=expected, advice=did_you_mean(name, declared)
            )
        if wrong := check_option(option, value):
            raise UsageError(f"found {wrong}", where=where, expected=option.type, advice=option.text)
    values = {name: given.get(name, option.default) for name, option in declared.items()}
    return {name: _settled(declared[name], value) for name, value in values.items()}


def _settled(option: Option, value: Any) -> Any:
    if option.type == "float" and value is not None:
        return float(value)
    return list(value) if option.type == "list" and value is not None else value


def check_options(manifests: Mapping[str, Manifest], options: Mapping[str, Mapping[str, object]]) -> None:
    """Hold all options of a configuration against the plug-ins that are there.

    Raises:
        UsageError: a plug-in or an option is unknown, or a value has the wrong type.
    """
    for plugin, given in options.items():
        if plugin not in manifests:
            expected = f"one of {', '.join(sorted(manifests))}" if manifests else "a plug-in that is installed"
            raise UsageError(
                f"options for unknown plug-in {plugin!r}",
                where=f"[options.{plugin}]",
                expected=expected,
                advice=did_you_mean(plugin, manifests) or "`roslens plugins` lists those found",
            )
        resolve_options(manifests[plugin], given)
