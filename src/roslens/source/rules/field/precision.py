"""How many findings of each rule were true when a sample was read: ``docs/accuracy_of_rules.md``."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

LEAST = 0.9
"""Share of findings that are true at least where a rule warns."""

_PATH = Path(__file__).with_name("precision.toml")


@cache
def read_samples() -> Mapping[str, tuple[int, int]]:
    """Return, by rule, how many findings were true and how many were read, in code that nothing was tuned to."""
    import tomli

    return {rule: (true, read) for rule, (true, read) in tomli.loads(_PATH.read_text("utf-8")).items()}


def precision_of(rule: str) -> float:
    """Return the share of findings that were true; 0 where nobody read any."""
    true, read = read_samples().get(rule, (0, 0))
    return true / read if read else 0.0


def is_confirmed(rule: str) -> bool:
    """Return whether enough findings were true in code that the rule was not written for."""
    return precision_of(rule) >= LEAST
