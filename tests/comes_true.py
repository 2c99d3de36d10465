"""Waits for what a page comes to. Playwright itself evaluates a text again and again, which a strict policy refuses."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Page

_WAIT = """async () => {
  const end = performance.now() + 60_000;
  while (!(%s)) {
    if (performance.now() > end) throw new Error("not true within 60 s");
    await new Promise(requestAnimationFrame);
  }
}"""


def comes_true(page: Page, condition: str) -> None:
    """Wait until an expression of JavaScript is true on a page.

    Raises:
        playwright.sync_api.Error: it is not true within a minute
    """
    page.evaluate(_WAIT % condition)
