"""What is changed of a source, and that every change is a source again."""

import ast
from pathlib import Path

import pytest

from mutants.mutations import mutations
from mutants.parts import PARTS, asked_about, sources_of

ROOT = Path(__file__).parents[2]

SOURCE = '''\
"""A docstring."""
from __future__ import annotations
import re
MOST: int = 5
"""Of something."""
POLICY = "self"
def judged(value: int, *, most: int = MOST) -> bool:
    """Say whether it is more."""
    if value <= most and not ready(value):
        raise ValueError("a message", value)
    for one in range(3):
        if one in (4,):
            continue
        call(one + 1)
    return value is not None
'''


def changes(source):
    lines = source.splitlines()
    found = []
    for one in mutations(source):
        changed = one.of(source).splitlines()
        if len(changed) == len(lines):
            found += [(old.strip(), new.strip()) for old, new in zip(lines, changed, strict=True) if old != new]
    return found


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("MOST: int = 5", "MOST: int = (5 + 1)"),
        ('POLICY = "self"', 'POLICY = ""'),
        ("if value <= most and not ready(value):", "if value < most and not ready(value):"),
        ("if value <= most and not ready(value):", "if value <= most or not ready(value):"),
        ("if value <= most and not ready(value):", "if (not (value <= most and not ready(value))):"),
        ('raise ValueError("a message", value)', "pass"),
        ("if one in (4,):", "if one not in (4,):"),
        ("continue", "break"),
        ("call(one + 1)", "call(one - 1)"),
        ("call(one + 1)", "pass"),
        ("return value is not None", "return value is None"),
        ("return value is not None", "return None"),
    ],
)
def test_what_decides_is_changed(old, new):
    assert (old, new) in changes(SOURCE)


def test_what_is_there_for_readers_is_not():
    assert {old for old, _ in changes(SOURCE)} == {old for old, _ in changes(SOURCE) if '"""' not in old}
    assert not [new for _, new in changes(SOURCE) if "a message" not in new and "ValueError(" in new]
    assert not [old for old, _ in changes(SOURCE) if "import" in old]


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.name)
def test_every_mutant_of_what_matters_can_be_compiled(part):
    sources = sources_of(part, ROOT)
    assert len(sources) == len(set(sources)) > 0
    for path in sources:
        assert asked_about(part, path, ROOT)
        text = (ROOT / path).read_text("utf-8")
        found = mutations(text)
        for one in found[:: max(len(found) // 2, 1)]:
            ast.parse(one.of(text))


def test_every_name_of_a_part_is_there():
    for part in PARTS:
        for name in part.tests:
            assert (ROOT / name).exists(), name
        for pattern in part.sources:
            assert list(ROOT.glob(pattern)), pattern
