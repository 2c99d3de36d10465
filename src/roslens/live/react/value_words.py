"""A value as people read it in the text of an action."""

from __future__ import annotations

from roslens.judge.ranges.amount import amount_text
from roslens.live.window.signals import BY_KEY


def value_words(value: float | None, quantity: str) -> str:
    """Return a value with its unit, three digits of it; empty for none."""
    if value is None or value - value != 0:
        return ""
    signal = BY_KEY.get(quantity)
    rounded = float(f"{value:.3g}")
    return amount_text(rounded, signal.unit) if signal is not None else f"{rounded:g}"
