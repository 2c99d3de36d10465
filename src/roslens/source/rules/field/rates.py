"""How often each rule reports in the field: findings per thousand lines of own code."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import msgspec

_PATH = Path(__file__).with_name("rates.toml")


class Rates(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What was counted in the field.

    Attributes:
        lines: of own code that was looked at.
        repositories: that were looked at.
        rules: by rule how many findings count, and in how many repositories.
    """

    lines: int
    repositories: int
    rules: Mapping[str, tuple[int, int]]


@cache
def read_rates() -> Rates:
    """Return the table of rules that are on by default.

    Raises:
        ValidationError: the file is no such table.
    """
    import tomli

    return msgspec.convert(tomli.loads(_PATH.read_text("utf-8")), Rates)


def spoken_rate(rule: str, rates: Rates) -> str:
    """Return in words how often a rule reports; empty where no repository has any finding of it."""
    if rule not in rates.rules:
        return ""
    findings, repositories = rates.rules[rule]
    rate = f"{1000 * findings / rates.lines:.2g}"
    return f"{rate} findings per 1,000 lines of own code, in {repositories} of {rates.repositories} repositories."
