"""The plug-in cccc: through the framework, with a program that misbehaves, and against the data of the study."""

from __future__ import annotations

import csv
import io
import os
import shutil
import subprocess
import tarfile
from pathlib import Path

import pytest

from roslens.children.sandbox import sandbox_kind
from roslens.model.failure import Failure
from roslens.model.quantity import Measurement
from roslens.plugins.contract import check_plugin, look_at
from roslens.plugins.discovery import discover
from roslens.plugins.manifest import check_manifest
from roslens.plugins.member import Member
from roslens.plugins.outcome import Outcome
from roslens.source.tools.cccc import plugin, run_cccc
from roslens.source.tools.cccc_report import CcccError

pytestmark = pytest.mark.timed

FIXTURES = Path(__file__).parents[2] / "fixtures" / "tool_output" / "cccc"
INSTALLED = pytest.mark.skipif(shutil.which("cccc") is None, reason="cccc is not installed")


@pytest.fixture(scope="module")
def member(tmp_path_factory: pytest.TempPathFactory) -> Member:
    found = discover((), base=tmp_path_factory.mktemp("base"), builtin=("roslens.source.tools.cccc:plugin",), search=())
    (member,) = found.members
    return member


def values(outcome: Outcome) -> dict[tuple[str, str], float]:
    return {(one.entity, one.quantity.removeprefix("paper2016.")): one.value for one in outcome.measurements}


def fake_cccc(folder: Path, script: str) -> None:
    """Put a program called cccc on the search path that runs ``script`` with the output folder as ``$out``."""
    program = folder / "cccc"
    program.write_text(f'#!/bin/sh\nout="${{1#--outdir=}}"\n{script}\n')
    program.chmod(0o755)


@pytest.fixture
def misbehaving(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "path"
    folder.mkdir()
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")
    return folder


def test_the_manifest_is_one_the_framework_takes():
    assert check_manifest(plugin.manifest, ("analyse_package",), builtin=True) == ()
    assert plugin.manifest.needs == ("program:cccc",)


@pytest.mark.real
@INSTALLED
def test_the_contract(member: Member):
    assert check_plugin(member, FIXTURES) == ()


@pytest.mark.real
@INSTALLED
def test_a_folder_of_sources(member: Member):
    outcome = look_at(member, FIXTURES / "values")
    assert outcome.failures == ()
    found = values(outcome)
    assert found["package:values", "loc"] == 110
    assert found["package:values", "comment_lines"] == 7
    assert found["package:values", "cyclomatic_complexity"] == 24 / 7
    assert found["package:values", "wmc"] == pytest.approx(19 / 8)
    assert found["package:values", "rqv"] == 4
    assert found["file:arm.hpp", "comment_ratio"] == 9
    assert ("file:empty.hpp", "loc") not in found


@pytest.mark.parametrize(
    ("script", "message"),
    [
        ("exit 3", "it ended with exit code 3: no message"),
        ("echo first >&2; echo out of memory >&2; exit 1", "it ended with exit code 1: out of memory"),
        ("kill -SEGV $$", "it ended with signal 11: no message"),
        ("exec sleep 60", "it did not end within 1.25 s"),
        ("exit 0", "it wrote no cccc.xml"),
        ('mkdir -p "$out"; echo garbage > "$out/cccc.xml"', "its cccc.xml is not XML"),
    ],
)
def test_a_program_that_fails_is_a_failure_and_gives_no_values(
    member: Member, misbehaving: Path, tmp_path: Path, script: str, message: str
):
    fake_cccc(misbehaving, script)
    source = tmp_path / "a b.cpp"
    source.write_text("int main() { return 0; }\n")
    outcome = look_at(member, source, options={"time_limit_s": 0.5})
    (failure,) = outcome.failures
    assert failure.what.startswith(f"cccc has no report of 'a b.cpp': {message}")
    assert failure.expected == "an XML report"
    assert failure.partial
    assert outcome.measurements == ()


def test_one_file_that_fails_leaves_the_others_and_withholds_the_package(
    member: Member, misbehaving: Path, tmp_path: Path
):
    # In its sandbox the program reads the one file, and what it is made of.
    recorded = shutil.copytree(FIXTURES / "reports" / "arm.hpp", misbehaving / "recorded")
    fake_cccc(misbehaving, f'case "$2" in *.c) exit 9;; esac; mkdir -p "$out"; cp "{recorded}"/*.xml "$out"')
    package = tmp_path / "package"
    package.mkdir()
    for name in ("a.hpp", "b.c", "c.cpp"):
        (package / name).write_text("int a;\n")
    outcome = look_at(member, package)
    assert [_quoted(failure) for failure in outcome.failures] == ["b.c"]
    assert {one.entity for one in outcome.measurements} == {"file:a.hpp", "file:c.cpp"}
    assert Measurement("file:a.hpp", "paper2016.loc", 33.0) in outcome.measurements


def _quoted(failure: Failure) -> str:
    return failure.what.split("'")[1]


def test_a_program_that_cannot_be_started(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    (tmp_path / "a.c").write_text("int a;\n")
    with pytest.raises(CcccError, match="it cannot be started: No such file or directory"):
        run_cccc(tmp_path / "a.c", tmp_path / "run")


@pytest.mark.skipif(not sandbox_kind(), reason="no sandbox here")
def test_it_reads_one_file_and_writes_its_scratch(misbehaving: Path, tmp_path: Path):
    (tmp_path / "other.c").write_text("secret\n")
    (tmp_path / "a.c").write_text("int a;\n")
    fake_cccc(misbehaving, f'cat "$2" || exit 4; touch made || exit 5; cat {tmp_path}/other.c && exit 6; exit 7')
    with pytest.raises(CcccError, match="exit code 7"):
        run_cccc(tmp_path / "a.c", tmp_path / "run")
    fake_cccc(misbehaving, f"touch {tmp_path}/made && exit 6; exit 7")
    with pytest.raises(CcccError, match="exit code 7"):
        run_cccc(tmp_path / "a.c", tmp_path / "again")
    assert not (tmp_path / "made").exists()


def test_the_limit_is_of_a_processor_whatever_else_the_machine_does(
    misbehaving: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("roslens.source.tools.cccc.PATIENCE", 200)
    fake_cccc(misbehaving, "while :; do :; done")
    (tmp_path / "a.c").write_text("int a;\n")
    with pytest.raises(CcccError, match="it did not end within 1 s of a processor"):
        run_cccc(tmp_path / "a.c", tmp_path / "run", time_limit_s=1)


def test_files_that_the_study_left_out_are_not_looked_at(member: Member, misbehaving: Path, tmp_path: Path):
    fake_cccc(misbehaving, "exit 1")
    for name in ("doc/a.cpp", "cmake/b.h", "c.py", "d.cxx"):
        (tmp_path / "package" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "package" / name).write_text("int a;\n")
    assert look_at(member, tmp_path / "package") == Outcome()


def _published() -> list[dict[str, str]]:
    with (FIXTURES / "study.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def _checkout(clone: Path, commits: str, folder: Path) -> Path:
    """Unpack the commit of the branch ``indigo`` that has so many ancestors (itself included)."""

    def git(*arguments: str) -> bytes:
        return subprocess.run(["git", "-C", str(clone), *arguments], capture_output=True, check=True).stdout

    branch = "origin/indigo" if b"origin/indigo\n" in git("branch", "-r", "--format=%(refname:short)") else "indigo"
    for commit in git("rev-list", branch).decode().split():
        if git("rev-list", "--count", commit).decode().strip() == commits:
            with tarfile.open(fileobj=io.BytesIO(git("archive", commit))) as archive:
                archive.extractall(folder, filter="data")
            return folder
    raise AssertionError(f"{clone} has no commit number {commits} on {branch}")


@pytest.mark.corpora
@pytest.mark.real
@INSTALLED
@pytest.mark.parametrize(("repository", "packages"), [("kobuki", 7), ("turtlebot_apps", 6)])
def test_every_figure_of_the_study(member: Member, tmp_path: Path, repository: str, packages: int):
    clone = Path(os.environ.get("ROSLENS_CORPORA", ""), repository)
    if not os.environ.get("ROSLENS_CORPORA") or not clone.is_dir():
        pytest.skip(f"ROSLENS_CORPORA names no folder with a clone of {repository}")
    rows = [row for row in _published() if row["Repository"] == repository]
    assert len(rows) == packages
    outcome = look_at(member, _checkout(clone, rows[0]["Commits"], tmp_path / repository))
    assert outcome.failures == ()
    found = values(outcome)
    printed = {
        "Cpp LoC": lambda get: f"{get('loc'):.0f}",
        "Cpp LoCom": lambda get: f"{get('comment_lines'):.0f}",
        "Com Ratio": lambda get: f"{get('comment_ratio') / 100:.2f}",
        "CC": lambda get: f"{get('cyclomatic_complexity'):.2f}",
        "CBO": lambda get: f"{get('cbo'):.12g}",
        "WMC": lambda get: f"{get('wmc'):.12g}",
        "MAC": lambda get: f"{get('mac'):.12g}",
        "NoC": lambda get: f"{get('noc'):.12g}",
        "DIT": lambda get: f"{get('dit'):.12g}",
        "Maintainability": lambda get: f"{get('maintainability_index'):.12g}",
        "Metrics Violations": lambda get: f"{get('rqv'):.0f}",
    }
    for row in rows:
        ours = {
            column: write(lambda key, package=row["Package"]: found[f"package:{package}", key])
            for column, write in printed.items()
        }
        theirs = {column: row[column].removesuffix(".0") for column in printed}
        assert ours == theirs, row["Package"]
