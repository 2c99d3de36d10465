"""``python -m promises``: write ``docs/promises.md``."""

from __future__ import annotations

from promises.sentences import ROOT, Promise, promises

PAGE = ROOT / "docs" / "promises.md"
_HEAD = """\
# Promises, and the tests that show them

Each sentence of *Promises* in README.md, and each guarantee and known limitation in [SECURITY.md](../SECURITY.md),
with the tests that fail if it is not true. `PYTHONPATH=tests python -m promises` writes this page;
`tests/promises/test_promises.py` fails if a sentence has no test.
"""
_PARTS = {
    "README.md": "README: promises",
    "SECURITY.md": "SECURITY: guarantees",
    "SECURITY.md, known limitations": "SECURITY: known limitations",
}


def page() -> str:
    """Return the text of the page."""
    return _HEAD + "".join(_part(document, title) for document, title in _PARTS.items())


def _part(document: str, title: str) -> str:
    rows = "".join(_row(one) for one in promises() if one.document == document)
    return f"\n## {title}\n\n| sentence | shown by |\n| --- | --- |\n{rows}"


def _row(promise: Promise) -> str:
    tests = ", ".join(f"`{test}`" for test in promise.tests)
    return f"| {promise.text} | {tests} |\n"


if __name__ == "__main__":
    PAGE.write_text(page())
