"""Texts that UTF-8 cannot write, and numbers that JSON or SQLite cannot.

A file name is bytes; Python shows those that are no UTF-8 as lone surrogates, which neither SQLite nor JSON takes.
They are kept as a backslash, an ``x`` and the byte, so that one odd file name never costs a result.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Mapping
from typing import Any, TypeVar

import msgspec

T = TypeVar("T")

_LARGEST_INTEGER = 2**63 - 1
_SURROGATE = re.compile("[\ud800-\udfff]")


def encodable(value: T) -> T:
    """Return the value with every text in it made fit for UTF-8."""
    plain = _cleaned(msgspec.to_builtins(value))
    return msgspec.convert(plain, type(value))


def encodable_text(text: str) -> str:
    """Return the text with a backslash escape for each lone surrogate."""
    return _SURROGATE.sub(_escaped, text)


def storable_number(value: float | None) -> float | None:
    """Return the value as SQLite can hold it: an integer of more than 64 bits becomes the nearest float."""
    if value is None or abs(value) <= _LARGEST_INTEGER:
        return value
    try:
        return float(value)
    except OverflowError:
        return sys.float_info.max if value > 0 else -sys.float_info.max


def storable_values(values: Mapping[str, float]) -> dict[str, float]:
    """Return the values that are numbers, as JSON and SQLite can hold them."""
    kept = {key: storable_number(value) for key, value in values.items()}
    return {key: value for key, value in kept.items() if value is not None and math.isfinite(value)}


def _escaped(match: re.Match[str]) -> str:
    code = ord(match.group())
    return f"\\x{code - 0xDC00:02x}" if 0xDC80 <= code <= 0xDCFF else f"\\u{code:04x}"


def _cleaned(value: Any) -> Any:
    if isinstance(value, str):
        return encodable_text(value)
    if isinstance(value, dict):
        return {_cleaned(key): _cleaned(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_cleaned(item) for item in value]
    return value
