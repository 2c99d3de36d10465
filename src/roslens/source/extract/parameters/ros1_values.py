"""What roslaunch makes of the text of a value: the conversions of ``<param>`` and of files of parameters.

``<param>`` follows roslaunch, loader.py, convert_value: a number with a dot is a double, ``1e5`` is text. Files of
parameters follow PyYAML, which reads YAML 1.1: ``1e5`` is text there too, ``017`` and ``1_000`` are integers; rosparam
adds ``deg(…)`` and ``rad(…)``.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

from roslens.source.extract.symbolic.python_expression import Plain, UnknownError, evaluate

AUTO = "auto"
_KINDS = {"int": "int", "double": "double", "str": "string", "string": "string", "bool": "bool", "boolean": "bool"}
_TAGS = {"bool": "bool", "int": "int", "float": "double", "str": "string"}
_OF_YAML = "tag:yaml.org,2002:"


def converted(text: str) -> Plain:
    """Return a value as roslaunch converts it where no type is given: int, float, bool, else text."""
    try:
        if "." in text:
            return float(text)
        if "_" not in text:
            return int(text)
    except ValueError:
        pass
    return {"true": True, "false": False}.get(text.lower(), text)


def type_of_value(text: str, kind: str) -> str:
    """Return the type of a ``<param>`` by its value and its ``type``; empty where that is none of one value.

    Raises:
        ValueError: the value is not of the type that is given.
    """
    if kind != AUTO:
        if kind not in _KINDS:
            raise ValueError(f"{kind!r} is not a type; expected int, double, str, bool, yaml or auto")
        if not _fits(text.strip(), _KINDS[kind]):
            raise ValueError(f"{text!r} is not of the type {kind}")
        return _KINDS[kind]
    match converted(text):
        case bool():
            return "bool"
        case int():
            return _KINDS["int"]
        case float():
            return _KINDS["double"]
    return _KINDS["str"]


def _fits(text: str, kind: str) -> bool:
    if kind == "bool":
        return text.lower() in ("true", "1", "false", "0")
    try:
        float(text) if kind == "double" else int(text) if kind == "int" else text
    except ValueError:
        return False
    return True


@lru_cache(maxsize=4096)
def type_in_yaml(text: str) -> str:
    """Return the type that rosparam gives a plain text; empty of what is none of its types, as ``null``."""
    if angle(text) is not None:
        return "double"
    return _TAGS.get(_tag(text).removeprefix(_OF_YAML), "")


def angle(text: str) -> float | None:
    """Return what ``deg(…)`` or ``rad(…)`` comes to in radians; None where it is no such text."""
    if text[:4] not in ("deg(", "rad(") or not text.endswith(")"):
        return None
    try:
        value = float(text[4:-1]) * math.pi / 180 if text[0] == "d" else evaluate(text[4:-1])
    except (UnknownError, ValueError):
        return None
    match value:
        case int() | float():
            return float(value)
    return None


def _tag(text: str) -> str:
    import yaml

    resolvers: dict[str | None, list[Any]] = yaml.SafeLoader.yaml_implicit_resolvers
    for tag, form in (*resolvers.get(text[:1], ()), *resolvers.get(None, ())):
        if form.match(text):
            return str(tag)
    return f"{_OF_YAML}str"
