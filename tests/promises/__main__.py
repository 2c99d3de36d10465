"""``python -m promises``: write ``docs/promises.md``."""

from __future__ import annotations

from promises.sentences import GUARANTEES, PARTS, ROOT, Promise, promises

PAGE = ROOT / "docs" / "promises.md"
_HEAD = """\
# Promises, and the tests that show them

Each sentence of *Promises* in README.md, and of [SECURITY.md](../SECURITY.md), with the tests that fail if it is not
true. `PYTHONPATH=tests python -m promises` writes this page; `tests/promises/test_promises.py` fails if a sentence has
no test, or if one is no longer there. Sentences that claim nothing of roslens name the reason instead.
"""


def page() -> str:
    """Return the text of the page."""
    return _HEAD + "".join(map(_part, PARTS))


def _part(part: str) -> str:
    columns = ["sentence", "limit", "shown by"] if part == GUARANTEES else ["sentence", "shown by"]
    rows = "".join(_row(one) for one in promises() if one.part == part)
    return f"\n## {part}\n\n| {' | '.join(columns)} |\n|{' --- |' * len(columns)}\n{rows}"


def _row(promise: Promise) -> str:
    shown = ", ".join(f"`{test}`" for test in promise.tests) or f"*no claim:* {promise.no_claim}"
    cells = [promise.text, promise.limit, shown] if promise.part == GUARANTEES else [promise.text, shown]
    return f"| {' | '.join(cells)} |\n"


if __name__ == "__main__":
    PAGE.write_text(page())
