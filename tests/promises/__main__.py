"""``python -m promises``: write ``docs/promises.md``."""

from __future__ import annotations

from promises.sentences import ROOT, Promise, promises

PAGE = ROOT / "docs" / "promises.md"
_HEAD = """\
# Promises, and the tests that show them

Each sentence of *Promises* in README.md, with the tests that fail if it is not true; each guarantee in
[SECURITY.md](../SECURITY.md) names its own. `PYTHONPATH=tests python -m promises` writes this page;
`tests/promises/test_promises.py` fails if a sentence of either has no test.

| promise | shown by |
| --- | --- |
"""


def page() -> str:
    """Return the text of the page."""
    return _HEAD + "".join(_row(one) for one in promises() if one.document == "README.md")


def _row(promise: Promise) -> str:
    tests = ", ".join(f"`{test}`" for test in promise.tests)
    return f"| {promise.text} | {tests} |\n"


if __name__ == "__main__":
    PAGE.write_text(page())
