"""Which severity limits of metrics have where nobody names a model, and where somebody does."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from roslens.cli.main import main

MANIFEST = """<?xml version="1.0"?>
<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
<maintainer email="ada@arm.dev">Ada</maintainer><license>BSD</license></package>
"""
DECISIONS = "def moved(step):\n" + "".join(
    f"    if step == {number}:\n        return {number}\n" for number in range(60)
)
ASSERTED = "def checked(step):\n    assert (step, 'no step')\n"


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm/moved.py").write_text(DECISIONS)
    (tmp_path / "arm/checked.py").write_text(ASSERTED)
    return tmp_path


def checked(root: Path, capsys: pytest.CaptureFixture[str], *more: str) -> str:
    assert main(["check", str(root), "--no-store", "--fail-on", "never", "-q", *more]) == 0
    return capsys.readouterr().out


def extremes(root: Path, capsys: pytest.CaptureFixture[str], *more: str) -> list[str]:
    report = json.loads(checked(root, capsys, "--format", "json", *more))
    return [one["severity"] for one in report["findings"] if one["rule"].startswith("extreme.")]


def fix_first(root: Path, capsys: pytest.CaptureFixture[str], *more: str) -> str:
    text = checked(root, capsys, *more)
    assert "Fix first" in text
    return text.partition("Fix first")[2].partition("Findings:")[0]


def test_by_default_limits_are_notes_and_no_row_to_fix_first(arm, capsys):
    assert extremes(arm, capsys) == ["note"]
    rows = fix_first(arm, capsys)
    assert "python.assert_tuple" in rows
    assert "extreme." not in rows


def test_a_model_that_is_named_keeps_its_severity_and_comes_last(arm, capsys):
    assert extremes(arm, capsys, "--model", "extreme,ros:note") == ["warning"]
    rows = fix_first(arm, capsys, "--model", "extreme,ros:note")
    assert "python.assert_tuple" in rows.partition("extreme.")[0]
    assert "extreme." in rows
