import msgspec
import pytest

from roslens.cli.editor.editor_fixes import FixableFolder
from roslens.model.edit import edit_at
from roslens.model.finding import Finding, Severity
from roslens.model.source import Language, Role, SourceFile
from roslens.source.keys import content_hash
from roslens.source.settings import MacroSettings

CODE = b"int* a = NULL;\r\nint* b = NULL;\r\n"


def finding(what, text, path="a.cpp", *, gated=True):
    start = CODE.index(what)
    edit = msgspec.structs.replace(edit_at(CODE, start, start + len(what), text, path), made_for=content_hash(CODE))
    return Finding("cpp.rule", Severity.NOTE, "expected", path, gated=gated, edits=(edit,))


@pytest.fixture
def folder(tmp_path):
    files = {
        path: SourceFile(path, Language.CPP, role, len(CODE), content_hash(CODE))
        for path, role in (("a.cpp", Role.OWN), ("b.cpp", Role.OWN), ("c.cpp", Role.VENDORED))
    }
    for path in files:
        (tmp_path / path).write_bytes(CODE)
    return FixableFolder(tmp_path, files, MacroSettings())


def test_texts_have_the_line_ends_of_the_document(folder):
    fix = folder.fix_of(finding(b"int* b", "\nint* b"), "a.cpp", CODE)
    assert fix.title == "Fix cpp.rule: expected"
    assert [edit.text for edit in fix.edits["a.cpp"]] == ["\r\nint* b"]


def test_another_file_is_read(folder, tmp_path):
    assert folder.fix_of(finding(b"NULL", "nullptr", "b.cpp"), "a.cpp", CODE).edits.keys() == {"b.cpp"}
    (tmp_path / "b.cpp").write_bytes(b"other")
    assert folder.fix_of(finding(b"NULL", "nullptr", "b.cpp"), "a.cpp", CODE) is None
    (tmp_path / "b.cpp").unlink()
    assert folder.fix_of(finding(b"NULL", "nullptr", "b.cpp"), "a.cpp", CODE) is None


@pytest.mark.parametrize(
    ("one", "document"),
    [
        (finding(b"NULL", "nullptr", "c.cpp"), CODE),
        (finding(b"NULL", "nullptr", "unknown.cpp"), CODE),
        (finding(b"NULL", "nullptr"), CODE + b"\n"),
        (finding(b"NULL;", "("), CODE),
        (Finding("cpp.rule", Severity.NOTE, "expected", "a.cpp"), CODE),
    ],
)
def test_what_is_not_to_be_mended_has_no_action(folder, one, document):
    assert folder.fix_of(one, "a.cpp", document) is None


def test_all_are_those_of_the_document_that_count(folder):
    findings = [finding(b"NULL", "nullptr"), finding(b"int* b", "long* b"), finding(b"int", "x", "b.cpp")]
    fix = folder.fix_of_all([*findings, finding(b"int* a", "y", gated=False)], "a.cpp", CODE)
    assert [edit.text for edit in fix.edits["a.cpp"]] == ["nullptr", "long* b"]
    assert fix.edits.keys() == {"a.cpp"}
    assert folder.fix_of_all([], "a.cpp", CODE) is None
