import msgspec
import pytest

from roslens.model.edit import Edit, edit_at
from roslens.model.finding import Finding, Severity
from roslens.model.source import Language, Role, SourceFile
from roslens.source.fix.mended_files import mended
from roslens.source.keys import content_hash
from roslens.source.settings import MacroSettings

CODE = b"int* a = NULL;\nint* b = NULL;\n"


class Desk:
    """A folder with files, and findings in them whose edits replace a text."""

    def __init__(self, root):
        self.root = root
        self.files = {}

    def file(self, path, content=CODE, role=Role.OWN):
        place = self.root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
        self.files[path] = SourceFile(path, Language.CPP, role, len(content), content_hash(content))

    def finding(self, what, text, path="a.cpp", rule="cpp.null_pointer", content=CODE, fingerprint=""):
        start = content.index(what)
        edit = msgspec.structs.replace(
            edit_at(content, start, start + len(what), text, path), made_for=content_hash(content)
        )
        return Finding(
            rule, Severity.NOTE, "expected `nullptr`", path, 1, fingerprint=fingerprint or what.decode(), edits=(edit,)
        )

    def mended(self, *findings, again=lambda _: ()):
        return mended(findings, self.files, self.root, MacroSettings(), again)


@pytest.fixture
def desk(tmp_path):
    made = Desk(tmp_path)
    made.file("a.cpp")
    return made


def test_nothing_is_written(desk):
    result = desk.mended(desk.finding(b"NULL", "nullptr"))
    assert [(one.path, one.after) for one in result.files] == [("a.cpp", b"int* a = nullptr;\nint* b = NULL;\n")]
    assert len(result.fixed) == 1
    assert not result.left
    assert (desk.root / "a.cpp").read_bytes() == CODE


def test_what_overlaps_is_made_in_the_next_turn(desk):
    between = b"int* x = NULL;\nint* b = NULL;\n"

    def again(texts):
        if texts["a.cpp"] == between:
            yield desk.finding(b"x = NULL", "x = nullptr", content=between, fingerprint="second")

    result = desk.mended(
        desk.finding(b"int* a", "int* x", rule="cpp.name"),
        desk.finding(b"a = NULL", "a = nullptr", fingerprint="second"),
        again=again,
    )
    assert result.files[0].after == b"int* x = nullptr;\nint* b = NULL;\n"
    assert len(result.fixed) == 2
    assert not result.left


def test_an_edit_after_which_the_file_does_not_parse_is_not_made_and_the_others_stand(desk):
    broken = desk.finding(b"int* b = NULL;", "int* b = (;", rule="cpp.wrong")
    result = desk.mended(desk.finding(b"NULL", "nullptr"), broken)
    assert result.files[0].after == b"int* a = nullptr;\nint* b = NULL;\n"
    assert [one.finding for one in result.left] == [broken]
    (failure,) = result.failures
    assert "the fix of cpp.wrong would bring a place that does not parse" in failure.what
    assert failure.location.path == "a.cpp"
    assert not failure.partial


def test_two_edits_that_only_together_do_not_parse_are_both_left(desk):
    both = [desk.finding(b"int* a", "/* int* a", rule="a"), desk.finding(b"NULL;\nint* b", "3 */ int* b", rule="b")]
    result = desk.mended(*both)
    assert all(one.after.count(b"/*") == one.after.count(b"*/") for one in result.files)


def test_a_file_that_changed_is_left(desk):
    finding = desk.finding(b"NULL", "nullptr")
    (desk.root / "a.cpp").write_bytes(b"// new\n" + CODE)
    result = desk.mended(finding)
    assert not result.files
    assert "changed since it was looked at" in result.failures[0].what
    assert result.left[0].why == "its file changed since it was looked at"


@pytest.mark.parametrize("role", [Role.VENDORED, Role.GENERATED])
def test_what_others_wrote_is_left(desk, role):
    desk.file("b.cpp", role=role)
    result = desk.mended(desk.finding(b"NULL", "nullptr", "b.cpp"))
    assert not result.files
    assert not result.failures
    assert result.left[0].why == "its file is vendored or generated"


def test_a_link_out_of_the_workspace_is_left(tmp_path):
    desk = Desk(tmp_path / "ws")
    desk.file("a.cpp")
    (tmp_path / "outside.cpp").write_bytes(CODE)
    (desk.root / "a.cpp").unlink()
    (desk.root / "a.cpp").symlink_to("../outside.cpp")
    result = desk.mended(desk.finding(b"NULL", "nullptr"))
    assert not result.files
    assert result.left[0].why == "its file is a link that leads out of the workspace"


def test_a_finding_with_edits_in_two_files_is_made_in_both_or_in_none(desk):
    desk.file("b.cpp")
    one = desk.finding(b"NULL", "nullptr")
    two = msgspec.structs.replace(one, edits=(*one.edits, Edit("b.cpp", 0, 3, "(", made_for=content_hash(CODE))))
    assert not desk.mended(two).files
    assert desk.mended(two).left


def test_a_fix_that_mends_nothing_is_made_once(desk):
    after = b"int* a = nullptr;\nint* b = NULL;\n"
    result = desk.mended(
        desk.finding(b"NULL", "nullptr", fingerprint="same"),
        again=lambda _: [desk.finding(b"nullptr", "nullptr ", content=after, fingerprint="same")],
    )
    assert len(result.fixed) == 1


def test_a_file_that_is_gone_is_a_failure(desk):
    finding = desk.finding(b"NULL", "nullptr")
    (desk.root / "a.cpp").unlink()
    assert "cannot be read" in desk.mended(finding).failures[0].what
