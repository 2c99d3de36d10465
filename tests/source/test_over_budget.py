"""A file that is made to take for ever costs its budget, is named, and its package goes on without it."""

import time
from pathlib import Path

import pytest

import roslens.source.extract.workspace.workspace_programs as workspace_programs
import roslens.source.measure.analyse_package as analyse_package
from roslens.intake.bounded_file import MOST_SOURCE_BYTES
from roslens.intake.time_budget import OverBudgetError, time_budget
from roslens.model.source import Language, Location, Package, Role, SourceFile
from roslens.source.extract.workspace.workspace_programs import LowerTask, lower_files
from roslens.source.inventory import take_inventory
from roslens.source.measure.analyse_package import measure_task
from roslens.source.measure.package_task import PackageTask
from roslens.source.parsed_file import parse_file
from roslens.source.settings import CountingSettings, MacroSettings, WorkspaceSettings
from roslens.source.syntax.query.cpp_query import parse_tree
from roslens.source.workspace.find import find_workspace

ENDLESS = b"<!--" * 4000
"""Sixteen kilobytes whose recovery takes the parser twenty seconds."""


def file(path: str, role: Role = Role.OWN) -> SourceFile:
    return SourceFile(path, Language.CPP, role, 10, path)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "a.cpp").write_bytes(ENDLESS)
    (tmp_path / "b.cpp").write_bytes(b"int b() { return 1; }\n")
    return tmp_path


def test_the_parser_is_stopped_and_parses_the_next_text_from_its_start():
    begun = time.process_time()
    with pytest.raises(OverBudgetError), time_budget(0.05):
        parse_tree(ENDLESS)
    assert time.process_time() - begun < 2
    assert [child.type for child in parse_tree(b"int a;").root_node.children] == ["declaration"]


@pytest.mark.parametrize("role", [Role.OWN, Role.VENDORED])
def test_measuring_goes_on_without_it(folder: Path, role: Role, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(analyse_package, "SOURCE_FILE_S", 0.7)
    files = (file("a.cpp", role), file("b.cpp"))
    task = PackageTask(
        Package("p", "p", ".", Location("package.xml")), str(folder), files, {one.path: one.path for one in files},
        CountingSettings(), MacroSettings(),
    )  # fmt: skip
    measured = measure_task(task)
    (failure,) = measured.failures
    assert failure.location == Location("a.cpp")
    assert failure.partial is (role is not Role.OWN)
    assert "s of processor time" in failure.what
    assert "ignore" in failure.advice
    assert list(measured.analyses) == ["b.cpp"]


def test_so_do_programs(folder: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(workspace_programs, "SOURCE_FILE_S", 0.7)
    found = lower_files(LowerTask(0, str(folder), (file("a.cpp"), file("b.cpp")), MacroSettings()))
    assert [failure.location for failure in found.failures] == [Location("a.cpp")]
    assert list(found.changed) == ["b.cpp"]


@pytest.mark.parametrize("content", [b"{" * 200_000, b"!" * 200_000, b"A::" * 100_000, b"a+" * 100_000])
def test_a_tree_that_no_query_comes_to_the_end_of(content: bytes):
    with pytest.raises(OverBudgetError, match="60,000"):
        parse_file(content, Language.CPP, MacroSettings())


def test_long_chains_of_generated_code_are_no_such_tree():
    content = b"int f() { return " + b"a+" * 5000 + b"1; }"
    assert not parse_file(content, Language.CPP, MacroSettings()).facts().faults


def test_a_file_of_more_than_five_megabytes_is_named_and_not_read(tmp_path: Path):
    (tmp_path / "vendor").mkdir()
    (tmp_path / "package.xml").write_text("<package><name>arm</name></package>")
    for name in ("large.cpp", "vendor/large.cpp"):
        with (tmp_path / name).open("wb") as stream:
            stream.truncate(3 << 30)
    (tmp_path / "fits.cpp").write_bytes(b" " * MOST_SOURCE_BYTES)
    found = take_inventory(find_workspace([tmp_path], WorkspaceSettings()), WorkspaceSettings(), {})
    assert [failure.location for failure in found.failures] == [Location("large.cpp"), Location("vendor/large.cpp")]
    assert [failure.partial for failure in found.failures] == [False, True]
    assert "3,221,225,472 bytes; at most 5,000,000 are read" in found.failures[0].what
    assert "fits.cpp" in {one.path for one in found.files["arm"]}
