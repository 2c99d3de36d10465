"""What plug-ins said is not asked again when the run that asked came to no end."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from roslens.cli.main import main
from roslens.model.errors import StoreError
from roslens.model.failure import Failure
from roslens.model.quantity import Measurement
from roslens.plugins.outcome import Outcome
from roslens.source.kept_outcomes import KeptOutcomes
from roslens.source.measure.analyse_package import MeasuredPackage
from roslens.store.cache import Cache
from roslens.store.writing.write import RunWriter

MANIFEST = (
    '<package format="2"><name>{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>BSD</license></package>\n'
)
RECORDED = Path(__file__).parents[1] / "fixtures" / "tool_output" / "cccc" / "reports" / "arm.hpp"
SAID = Outcome(measurements=(Measurement("file:a.cpp", "paper2016.loc", 3.0),))


def measured(package: str, *, lost: bool = False) -> MeasuredPackage:
    return MeasuredPackage(package, (), (), {}, {}, lost=lost)


class Asked:
    """Plug-ins that say the same of every package, and count how often they are asked."""

    def __init__(self, said: Outcome = SAID) -> None:
        self.said = said
        self.times = 0

    def __call__(self, one: MeasuredPackage) -> Outcome:
        self.times += 1
        return self.said


@pytest.mark.parametrize(
    ("said", "times"),
    [
        (SAID, 1),
        (Outcome(SAID.findings, SAID.measurements, (Failure("cccc", "it crashed"),)), 2),
    ],
    ids=["said", "failed"],
)
def test_they_are_asked_again_only_where_something_failed(tmp_path: Path, said: Outcome, times: int):
    asked = Asked(said)
    for _ in range(2):
        with Cache.open(tmp_path / "cache.sqlite") as cache:
            assert KeptOutcomes(cache, {"arm": "k"}).of(measured("arm"), asked) == said
    assert asked.times == times


def test_another_key_and_a_package_that_was_not_measured_are_asked_about(tmp_path: Path):
    asked = Asked()
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        KeptOutcomes(cache, {"arm": "k"}).of(measured("arm", lost=True), asked)
        KeptOutcomes(cache, {"arm": "k"}).of(measured("arm"), asked)
        KeptOutcomes(cache, {"arm": "another"}).of(measured("arm"), asked)
    assert asked.times == 3


def test_a_check_that_came_to_no_end_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    workspace, programs = tmp_path / "ws", tmp_path / "bin"
    for name in ("arm", "base"):
        (workspace / name).mkdir(parents=True)
        (workspace / name / "package.xml").write_text(MANIFEST.format(name))
        (workspace / name / f"{name}.hpp").write_text("int a;\n")
    # In a sandbox it reads what lies beside it and nothing else.
    shutil.copytree(RECORDED, programs / "recorded")
    (programs / "cccc").write_text(
        f'#!/bin/sh\nout="${{1#--outdir=}}"\nmkdir -p "$out"; cp "{programs}"/recorded/*.xml "$out"\n'
    )
    (programs / "cccc").chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")
    words = ["check", str(workspace), "--model", "paper2016", "--tools", "none", "--fail-on", "never", "-q"]

    def broken(*_: object) -> int:
        raise StoreError("the disk is full", where="store")

    with monkeypatch.context() as context:
        context.setattr(RunWriter, "complete", broken)
        assert main(words) == 2
    # Who asks it again gets nothing but a failure, of which the exit code would be 3.
    shutil.rmtree(programs / "recorded")
    assert main(words) == 0
    shutil.rmtree(workspace / ".roslens")
    assert main(words) == 3
