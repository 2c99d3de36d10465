"""What a window shows, in words."""

from __future__ import annotations

from roslens.live.window.traffic import longest_interval
from roslens.live.window.window import Window


def evidence_of(window: Window) -> str:
    """Return ``12 messages in 5.0 s, inside, largest gap 0.24 s``."""
    if not window.spacing:
        return "nothing observed yet"
    covered = min(window.horizon - window.begun, window.length)
    messages = "1 message" if window.count == 1 else f"{window.count} messages"
    text = f"{messages} in {max(covered, 0.0):.1f} s, {window.observer.value}"
    gap = longest_interval(window)
    if gap >= 0:
        text += f", largest gap {gap:.2f} s"
    if window.quiet > max(gap, window.patience):
        text += f", silent for {window.quiet:.1f} s"
        if window.quiet < window.doubted_s:
            text += f" (counts from {window.doubted_s:.1f} s on: a tap may lose messages itself)"
    return text
