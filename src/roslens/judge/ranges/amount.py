"""Amounts with units: ``25 Hz``, ``10 ms``, ``1.5 GiB``; and the ranges of them that references are written in.

Numbers are decimal and stay so until the end: ``30 ms`` is exactly what ``0.03 s`` is.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from decimal import Decimal

import msgspec

from roslens.judge.ranges.range import Range, plain
from roslens.plugins.nearest import did_you_mean

_D = Decimal
_BYTES = {
    "B": _D(1),
    **{f"{prefix}B": _D(1000) ** power for power, prefix in enumerate("kMGT", 1)},
    **{f"{prefix}iB": _D(1024) ** power for power, prefix in enumerate("KMGT", 1)},
}

UNITS: Mapping[str, Mapping[str, Decimal]] = {
    "Hz": {"Hz": _D(1), "mHz": _D("1e-3"), "kHz": _D(1000), "MHz": _D(10) ** 6, "/s": _D(1), "/min": _D(1) / 60},
    "s": {
        "s": _D(1),
        "ms": _D("1e-3"),
        "us": _D("1e-6"),
        "µs": _D("1e-6"),  # the micro sign
        "μs": _D("1e-6"),  # the Greek letter, which looks the same
        "ns": _D("1e-9"),
        "min": _D(60),
        "h": _D(3600),
        "d": _D(86400),
    },
    "B": _BYTES,
    "B/s": {
        **{f"{unit}/s": factor for unit, factor in _BYTES.items()},
        **{f"{prefix}bit/s": _D(1000) ** power / 8 for power, prefix in enumerate(("", "k", "M", "G"))},
    },
    "%": {"%": _D(1)},
    "degC": {"degC": _D(1), "°C": _D(1)},
    "": {},
}
"""Unit of a signal to the units it may be written in, each with its size in that unit."""

_SHOWN = {
    "s": ("us", "ms", "s"),
    "B": ("KiB", "MiB", "GiB", "TiB", "kB", "MB", "GB", "TB"),
    "B/s": ("KiB/s", "MiB/s", "kB/s", "MB/s", "GB/s"),
}
"""Units that amounts are shown in, the preferred ones last."""

FORMS = "`25..35 Hz`, `<= 20 ms`, `>= 5 Hz`, `30 Hz ± 10 %` or `p95 <= 30 ms`"

_NUMBER = r"[-+]?(?:\d+(?:\.\d+)?|\.\d+)(?:[eE][-+]?\d{1,3})?"
_AMOUNT = rf"({_NUMBER})\s*([^\s\d.±+<>=-][^\s±+<>=.]*)?"
_ONE = re.compile(rf"{_AMOUNT}\Z")
_BETWEEN = re.compile(rf"{_AMOUNT}\s*\.\.(?!\.)\s*{_AMOUNT}\Z")
_AROUND = re.compile(rf"{_AMOUNT}\s*(?:±|\+-|\+/-)\s*{_AMOUNT}\Z")
_BOUND = re.compile(rf"(<=|>=|≤|≥|at most\s|at least\s)\s*{_AMOUNT}\Z")
_PERCENTILE = re.compile(r"p(\d{1,3}(?:\.\d{1,6})?)(?:\s+|(?=[<>≤≥]))(.*)\Z", re.DOTALL)
_LONGEST = 200


class Limits(msgspec.Struct, frozen=True):
    """A range in the unit of its signal; ``percentile`` 0 is of the value itself, else of that share of 100."""

    range: Range
    percentile: float = 0.0


def parse_amount(text: str, unit: str, *, bare: bool = True) -> float:
    """Return an amount in ``unit``.

    Args:
        text: a number and a unit.
        unit: of the signal, a key of ``UNITS``.
        bare: whether a number without a unit is in ``unit``.

    Raises:
        ValueError: it is no amount, or its unit is of another dimension; the message names the right ones.
    """
    stripped = text.strip()
    found = _ONE.match(stripped) if len(stripped) <= _LONGEST else None
    if found is None:
        example = "a number" if not unit else f"a number and a unit, such as `10 {unit}`"
        raise ValueError(f"{text[:60]!r} is not an amount, expected {example}")
    if found[2] is None and not bare:
        raise ValueError(f"{stripped!r} has no unit, expected `{stripped} {unit}`")
    return float(_exact(found[1], found[2] or unit, unit))


def parse_limits(text: str, unit: str) -> Limits:
    """Read a range of amounts.

    The unit may stand at one end of a range alone; a number without any is in the unit of the signal. What has no
    unit may be a single number (``publishers: 1``).

    Args:
        text: the range as written.
        unit: of the signal, a key of ``UNITS``.

    Raises:
        ValueError: the text is no range of such amounts; the message states why and what is expected.
    """
    stripped = text.strip()
    if len(stripped) > _LONGEST:
        raise ValueError(f"{stripped[:60]!r}… is too long for a range, expected {FORMS}")
    percentile = 0.0
    if found := _PERCENTILE.match(stripped):
        percentile, stripped = float(found[1]), found[2].strip()
        if not 0 < percentile <= 100:
            raise ValueError(f"percentile {found[1]} in {text!r}, expected one above 0 and up to 100")
    return Limits(_range(stripped, text, unit), percentile)


def amount_text(value: float, unit: str) -> str:
    """Return an amount as people write it, ``20 ms`` rather than ``0.02 s``; it reads back as the same value."""
    exact = Decimal(repr(float(value)))
    texts = [f"{plain(value)} {unit}".rstrip()]
    for name in _SHOWN.get(unit, ()) if value and math.isfinite(value) else ():
        scaled = exact / UNITS[unit][name]
        if 1 <= abs(scaled) < 10**9 and scaled == round(scaled, 6):
            texts.insert(0, f"{plain(float(scaled))} {name}")
    return min(texts[: len(texts) - 1] or texts, key=lambda text: len(text.partition(" ")[0]))


def limits_text(limits: Limits, unit: str) -> str:
    """Return a range as ``parse_limits`` reads it back."""
    low, high = limits.range.minimum, limits.range.maximum
    if low is None and high is None:
        words = "any"
    elif low is None:
        words = f"<= {amount_text(high or 0.0, unit)}"
    elif high is None:
        words = f">= {amount_text(low, unit)}"
    else:
        least, most = amount_text(low, unit), amount_text(high, unit)
        same = least.partition(" ")[2] == most.partition(" ")[2]
        words = f"{least.partition(' ')[0] if same else least}..{most}"
    return f"p{plain(limits.percentile)} {words}" if limits.percentile else words


def _range(stripped: str, text: str, unit: str) -> Range:
    if stripped == "any":
        return Range()
    if found := _BOUND.match(stripped):
        bound = float(_exact(found[2], found[3] or unit, unit))
        return Range(maximum=bound) if found[1].strip() in {"<=", "≤", "at most"} else Range(minimum=bound)
    if found := _BETWEEN.match(stripped):
        low, high = found[2] or found[4] or unit, found[4] or found[2] or unit
        return Range(float(_exact(found[1], low, unit)), float(_exact(found[3], high, unit)))
    if found := _AROUND.match(stripped):
        return _around(text, found[1], found[2], found[3], found[4], unit)
    if found := _ONE.match(stripped):
        value = _exact(found[1], found[2] or unit, unit)
        if unit == "":
            return Range(float(value), float(value))
        raise ValueError(f"{text!r} is a single value, which nothing measured ever has; expected {FORMS}")
    if re.match(r"[<>]\s*[-+.\d]", stripped):
        raise ValueError(f"{text!r} leaves out the bound itself, expected `{stripped[0]}= {stripped[1:].strip()}`")
    raise ValueError(f"{text!r} is not a range, expected {FORMS}")


def _around(text: str, centre: str, unit1: str | None, width: str, unit2: str | None, unit: str) -> Range:
    if unit2 == "%" and unit == "%":
        raise ValueError(f"{text!r} may mean points or a share of the value; expected both ends, such as `70..90 %`")
    middle = _exact(centre, unit1 or (unit2 if unit2 != "%" and unit2 else unit), unit)
    half = abs(middle) * _number(width) / 100 if unit2 == "%" else _exact(width, unit2 or unit1 or unit, unit)
    if half < 0:
        raise ValueError(f"{text!r} has a negative width, expected one from 0 on")
    return Range(float(middle - half), float(middle + half))


def _exact(number: str, written: str, unit: str) -> Decimal:
    """Return an amount in ``unit``."""
    sizes = UNITS[unit]
    if written == unit:
        return _number(number)
    if written not in sizes:
        valid = f"one in {', '.join(sizes)}" if sizes else "a number without a unit"
        advice = did_you_mean(written, sizes)
        raise ValueError(f"{number} {written}: {written!r} is not its unit, expected {valid}{advice and f'. {advice}'}")
    return _number(number) * sizes[written]


def _number(text: str) -> Decimal:
    if not math.isfinite(float(text)):
        raise ValueError(f"{text} is too great, expected a finite number")
    return Decimal(text)
