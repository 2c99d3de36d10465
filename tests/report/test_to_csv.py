"""The tables: RFC 4180, safe in a spreadsheet, complete."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.entity import EntityKind
from roslens.model.finding import Finding, Severity
from roslens.model.result import WorkspaceResult
from roslens.model.tags import parse_tags
from roslens.report.run.to_csv import TABLES, write_findings, write_folder, write_table
from roslens.report.writing.control_characters import shown_controls
from roslens.report.writing.csv_table import written_cell


def table(view, name, tags=None):
    stream = io.StringIO()
    write_table(view, name, stream, tags)
    return list(csv.DictReader(io.StringIO(stream.getvalue(), newline="")))


def test_findings(view):
    stream = io.StringIO()
    write_findings(view, stream)
    assert stream.getvalue() == (
        "rule,severity,message,package,path,line,column,end_line,end_column,entity,tags,tool,fingerprint,gated,"
        "model,quantity,value,bound,consequence,certainty\r\n"
        'ros.cyclomatic_complexity,warning,"cyclomatic complexity 17, at most 15 allowed",drive,'
        "src/drive/src/drive.cpp,12,1,60,1,"
        "function:src/drive/src/drive.cpp#drive::Drive::update(const Twist &),complexity metrics ros,ros,"
        "0e6749020c371696,yes,ros,cyclomatic_complexity,17,15,may be wrong at run time,likely\r\n"
        'style.tabs,note,"a tab, ""quoted""",drive,src/drive/test/test_drive.cpp,3,1,3,1,'
        "file:src/drive/test/test_drive.cpp,style,style,ffffffffffffffff,no,,,,,hard to maintain,likely\r\n"
        "manifest.cycle,error,drive -> arm -> drive,,,0,0,0,0,package:drive,dependencies,workspace,"
        "eeeeeeeeeeeeeeee,yes,,,,,wrong at run time,proven\r\n"
    )


def test_packages(view):
    arm, drive = table(view, "packages")
    assert drive == {
        "id": "drive",
        "name": "drive",
        "path": "src/drive",
        "repository": "",
        "version": "1.2.3",
        "build_type": "catkin",
        "dependencies": "arm roscpp",
        "files": "3",
        "classes": "1",
        "functions": "1",
        "notes": "1",
        "warnings": "1",
        "errors": "0",
        "failures": "1",
        "cyclomatic_complexity": "8.75",
        "dependents": "0",
        "loc": "52",
        # Among the packages of the field that comes with roslens.
        "cyclomatic_complexity.percentile": "96.7",
        "dependents.percentile": "10",
        "loc.percentile": "30.9",
    }
    assert (arm["cyclomatic_complexity"], arm["loc"], arm["cyclomatic_complexity.percentile"]) == ("", "0", "")


def test_entities_have_a_column_for_every_quantity(view):
    rows = table(view, "entities")
    assert [row["kind"] for row in rows] == ["package", "package", "file", "class", "function"]
    function = rows[-1]
    assert (function["loc"], function["cyclomatic_complexity"], function["dependents"]) == ("31", "17", "")
    assert function["approximate"] == "yes"


def test_the_other_tables(view):
    assert next(row["path"] for row in table(view, "files")) == "src/arm/arm/__init__.py"
    assert [(row["tool"], row["line"], row["partial"]) for row in table(view, "failures")] == [
        ("syntax", "44", "yes"),
        ("workspace", "0", "no"),
    ]
    assert [row["id"] for row in table(view, "rules")] == ["ros.cyclomatic_complexity", "style.tabs", "manifest.cycle"]
    with pytest.raises(KeyError):
        table(view, "no such")


def test_tags_choose_findings_and_what_is_counted_of_them(view):
    tags = parse_tags("style")
    assert [row["rule"] for row in table(view, "findings", tags)] == ["style.tabs"]
    drive = table(view, "packages", tags)[1]
    assert (drive["notes"], drive["warnings"]) == ("1", "0")
    assert len(table(view, "entities", tags)) == 5


def test_a_folder_gets_every_table(view, tmp_path):
    folder = tmp_path / "deep" / "tables"
    write_folder(view, folder)
    write_folder(view, folder)
    assert sorted(file.name for file in folder.iterdir()) == sorted(f"{name}.csv" for name in TABLES)
    for name in TABLES:
        stream = io.StringIO()
        write_table(view, name, stream)
        assert (folder / f"{name}.csv").read_bytes() == stream.getvalue().encode()


def test_what_fails_leaves_nothing_half_written(view, tmp_path, monkeypatch):
    write_folder(view, tmp_path)
    before = {file.name: file.read_bytes() for file in tmp_path.iterdir()}

    def full(_view, _tags):
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(TABLES, "files", full)
    with pytest.raises(OSError, match="No space left"):
        write_folder(view, tmp_path)
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == before


@pytest.mark.parametrize("text", ["=1+1", "+cmd", "-2", "@SUM(A1)", "\tx"])
def test_a_formula_from_source_is_shown_as_text(view_of, sample, text):
    arm = sample.arm()
    finding = Finding(text, Severity.NOTE, text, text, entity=text, tags=(text,), tool=text)
    entity = type(arm.entities[0])(text, EntityKind.FUNCTION, text, text, values={"loc": -5})
    result = type(arm)(arm.package, (), (entity,), (finding,))
    view = view_of([("key", result)], WorkspaceResult(), sample.header())
    (row,) = table(view, "findings")
    for name in ("rule", "message", "path", "entity", "tags", "tool"):
        assert row[name] == "'" + text
    (row,) = table(view, "entities")
    assert (row["name"], row["loc"]) == ("'" + text, "-5")


@given(st.lists(st.text(st.characters(exclude_categories=["Cs"])), min_size=1))
def test_any_text_comes_back(texts):
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\r\n")
    writer.writerow([written_cell(text) for text in texts])
    (row,) = csv.reader(io.StringIO(stream.getvalue(), newline=""))
    expected = [shown_controls(text.removeprefix("'").replace("\0", "\N{REPLACEMENT CHARACTER}")) for text in texts]
    assert [text.removeprefix("'") for text in row] == expected
    assert not any(text.startswith(("=", "+", "-", "@", "\t", "\r")) for text in row)
