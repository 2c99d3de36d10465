"""What of a finding stays the same where its file moves."""

from __future__ import annotations

import re

from roslens.model.finding import Finding

_NUMBER = re.compile(r"\d[\d.,]*")

Key = tuple[str, str, str, int, int, str]
"""Identifies findings within one run."""


def key_of_finding(finding: Finding) -> Key:
    """Return what distinguishes a finding from every other of its run, except duplicates."""
    return (finding.fingerprint, finding.rule, finding.path, finding.line, finding.column, finding.message)


def within_file(entity: str) -> str:
    """Return what of an entity's id does not depend on where its file is: ``function:drive::Drive::update()``.

    For a file it is its kind alone; a package has no file.
    """
    kind, _, name = entity.partition(":")
    if kind == "package":
        return entity
    _, separator, inside = name.partition("#")
    return f"{kind}:{inside}" if separator else kind


def said(message: str, path: str) -> str:
    """Return a message without numbers and the path of its file."""
    return _NUMBER.sub("0", message.replace(path, "") if path else message)
