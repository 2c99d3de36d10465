"""A package that could not be measured, as its worker was lost, is measured by the next run."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from roslens.cli.main import main
from roslens.source.measure import measured_packages

MANIFEST = (
    '<package format="2"><name>{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>BSD</license></package>\n'
)


def test_it_is_tried_again_and_the_others_are_not(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    for name in ("arm", "base"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(MANIFEST.format(name))
        (tmp_path / name / "a.py").write_text("x = 1\n")
    report = tmp_path / "run.json"
    words = ["check", str(tmp_path), "--jobs", "1", "--fail-on", "never", "-q", "--format", "json", "-o", str(report)]
    measure, asked = measured_packages.measured_packages, []

    def losing(executor, tasks, *more):
        for task, result in measure(executor, tasks, *more):
            asked.append(task.package.id)
            yield task, RuntimeError("its worker died twice") if task.package.id == lost else result

    monkeypatch.setattr(measured_packages, "measured_packages", losing)
    for lost, code, packages in (("arm", 3, ["arm", "base"]), ("", 0, ["arm"]), ("", 0, [])):
        asked.clear()
        assert main(words) == code
        assert sorted(asked) == packages
        assert len(json.loads(report.read_text())["failures"]) == bool(lost)
