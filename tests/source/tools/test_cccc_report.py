"""Reading what cccc wrote: recorded reports, and what is not one."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.tools.cccc import run_cccc
from roslens.source.tools.cccc_report import CcccError, CcccFile, CcccFunction, CcccModule, read_report

FIXTURES = Path(__file__).parents[2] / "fixtures" / "tool_output" / "cccc"
SOURCES = sorted(path.name for path in (FIXTURES / "values").iterdir())


def test_a_header():
    report = read_report(FIXTURES / "reports" / "arm.hpp")
    assert (report.loc, report.comment_lines) == (33, 3)
    assert report.modules == (
        CcccModule("Arm", line=38, cbo=3, noc=0, wmc=4, dit=1, mac=4),
        CcccModule("Device", line=12, cbo=3, noc=2, wmc=3, dit=0, mac=2),
        CcccModule("Joint", line=23, cbo=2, noc=0, wmc=3, dit=1, mac=2),
        CcccModule("string", line=0, cbo=1, noc=0, wmc=0, dit=0, mac=0),
        CcccModule("vector", line=0, cbo=1, noc=0, wmc=0, dit=0, mac=0),
    )
    assert [one.name for one in report.functions if one.complexity] == ["name()", "start()"]
    assert CcccFunction("Joint", "start()", 26, 2) in report.functions


def test_a_source_file():
    report = read_report(FIXTURES / "reports" / "arm.cpp")
    assert CcccModule("Arm", line=0, cbo=1, noc=0, wmc=4, dit=0, mac=0) in report.modules
    assert [(one.module, one.name, one.line, one.complexity) for one in report.functions if one.complexity] == [
        ("Arm", "reach(int)", 28, 10),
        ("Arm", "start()", 10, 4),
        ("anonymous", "main(int,char **)", 56, 2),
    ]


def test_a_function_is_where_it_is_defined():
    (function,) = read_report(FIXTURES / "reports" / "inline.hpp").functions
    assert function == CcccFunction("Counter", "next()", 11, 3)


def test_a_c_file_and_files_of_which_cccc_knows_little():
    legacy = read_report(FIXTURES / "reports" / "legacy.c")
    assert CcccFunction("anonymous", "checksum(const char *,int)", 4, 2) in legacy.functions
    assert read_report(FIXTURES / "reports" / "empty.hpp") == CcccFile(0, 0)
    assert read_report(FIXTURES / "reports" / "latin1.h") == CcccFile(5, 1)


@pytest.mark.real
@pytest.mark.parametrize("name", SOURCES)
def test_cccc_writes_what_was_recorded(name: str, tmp_path: Path):
    if shutil.which("cccc") is None:
        pytest.skip("cccc is not installed")
    found = read_report(run_cccc(FIXTURES / "values" / name, tmp_path / "run"))
    assert found == read_report(FIXTURES / "reports" / name)


SUMMARY = "<CCCC_Project><project_summary>{}<lines_of_comment value='3'/></project_summary></CCCC_Project>"
CLASS = (
    "<CCCC_Project><module_summary>{}<number_of_children value='0'/><weighted_methods_per_class_unity value='2'/>"
    "<depth_of_inheritance_tree value='1'/><weighted_methods_per_class_visibility value='1'/></module_summary>"
    "<procedural_detail><member_function><name>{}</name><extent><source_reference line='7'/></extent>"
    "<McCabes_cyclomatic_complexity value='4'/></member_function><member_function><name>nowhere()</name><extent/>"
    "<McCabes_cyclomatic_complexity value='9'/></member_function></procedural_detail></CCCC_Project>"
)
LINES = "<lines_of_code value='20'/>"
CBO = "<coupling_between_objects value='5'/>"


def written(folder: Path, summary: bytes | str, **modules: bytes | str) -> Path:
    for name, content in {"cccc": summary, **modules}.items():
        (folder / f"{name}.xml").write_bytes(content if isinstance(content, bytes) else content.encode("latin-1"))
    return folder


def test_names_in_any_encoding_and_control_characters(tmp_path: Path):
    report = read_report(written(tmp_path, SUMMARY.format(LINES), Foo=CLASS.format(CBO, "gr\xf6\x01sse(int)")))
    assert report.modules == (CcccModule("Foo", 0, cbo=5, noc=0, wmc=2, dit=1, mac=1),)
    assert report.functions == (CcccFunction("Foo", "gr\ufffd\ufffdsse(int)", 7, 4),)


@pytest.mark.parametrize(
    ("summary", "module", "message"),
    [
        ("", "", "its cccc.xml is not XML"),
        ("nonsense", "", "its cccc.xml is not XML"),
        ("<a/>", "", "its cccc.xml has no <project_summary> in <a>"),
        (SUMMARY.format(""), "", "its cccc.xml has no <lines_of_code> in <project_summary>"),
        (SUMMARY.format("<lines_of_code value='******'/>"), "", "its cccc.xml has '******' for <lines_of_code>"),
        (SUMMARY.format("<lines_of_code/>"), "", "its cccc.xml has '' for <lines_of_code>"),
        (SUMMARY.format(LINES), "<a>", "its Foo.xml is not XML"),
        (SUMMARY.format(LINES), "<a/>", "its Foo.xml has no <module_summary> in <a>"),
        (SUMMARY.format(LINES), CLASS.format("", "f()"), "its Foo.xml has no <coupling_between_objects>"),
        (SUMMARY.format(LINES), "<!DOCTYPE a [<!ENTITY b SYSTEM 'file:///etc/passwd'>]><a>&b;</a>", "has no"),
    ],
)
def test_what_is_no_report_says_which_file(tmp_path: Path, summary: str, module: str, message: str):
    with pytest.raises(CcccError) as caught:
        read_report(written(tmp_path, summary, **({"Foo": module} if module else {})))
    assert message in str(caught.value)


def test_no_report_at_all(tmp_path: Path):
    with pytest.raises(CcccError, match=r"it wrote no cccc\.xml"):
        read_report(tmp_path / "gone")


@given(st.binary(max_size=100))
def test_any_bytes_are_a_report_or_an_error(tmp_path_factory: pytest.TempPathFactory, content: bytes):
    folder = written(tmp_path_factory.mktemp("report"), SUMMARY.format(LINES), Foo=content)
    with pytest.raises(CcccError, match=r"Foo\.xml"):
        read_report(folder)
