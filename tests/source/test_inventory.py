from pathlib import Path

import msgspec
import pytest

from roslens.intake.bounded_file import TooLargeError
from roslens.model.source import Language, Role
from roslens.source.inventory import take_inventory
from roslens.source.keys import content_hash
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.find import Workspace, find_workspace

MANIFEST = (
    "<package format='2'><name>{}</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@b.c'>a</maintainer><license>BSD</license></package>"
)


def workspace(root: Path, **files: str) -> Workspace:
    for key, text in {"package__xml": MANIFEST.format("arm"), **files}.items():
        path = root / "arm" / key.replace("__", ".")
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    return find_workspace([root], WorkspaceSettings())


def test_files_have_language_role_and_hash(tmp_path: Path):
    found = take_inventory(workspace(tmp_path, a__cpp="int a;", test_b__py="x = 1"), WorkspaceSettings(), {})
    files = {file.path: file for file in found.files["arm"]}
    assert files["arm/a.cpp"].language is Language.CPP
    assert files["arm/a.cpp"].content_hash == content_hash(b"int a;")
    assert files["arm/test_b.py"].role is Role.TEST


def test_what_is_known_is_not_opened(tmp_path: Path):
    seen = workspace(tmp_path, a__cpp="int a;")
    first = take_inventory(seen, WorkspaceSettings(), {})
    (tmp_path / "arm" / "a.cpp").chmod(0)
    lied = {
        path: msgspec.structs.replace(stat, content_hash="told by the cache") for path, stat in first.learned.items()
    }
    second = take_inventory(seen, WorkspaceSettings(), lied)
    assert second.learned == {}
    assert {file.content_hash for file in second.files["arm"]} == {"told by the cache"}


@pytest.mark.parametrize("field", ["size", "mtime_ns", "inode"])
def test_whatever_of_a_file_differs_it_is_opened_again(tmp_path: Path, field: str):
    seen = workspace(tmp_path, a__cpp="int a;")
    known = take_inventory(seen, WorkspaceSettings(), {}).learned
    other = msgspec.structs.replace(known["arm/a.cpp"], **{field: 7}, content_hash="of another file")
    again = take_inventory(seen, WorkspaceSettings(), {**known, "arm/a.cpp": other})
    assert set(again.learned) == {"arm/a.cpp"}
    assert {file.content_hash for file in again.files["arm"]} >= {content_hash(b"int a;")}


def test_other_settings_look_again(tmp_path: Path):
    seen = workspace(tmp_path, a__cpp="int a;")
    first = take_inventory(seen, WorkspaceSettings(), {})
    second = take_inventory(seen, WorkspaceSettings(vendored=("arm/**",)), first.learned)
    assert {file.role for file in second.files["arm"] if file.path.endswith(".cpp")} == {Role.VENDORED}


def test_roles_that_another_version_told_are_told_again(tmp_path: Path, monkeypatch):
    seen = workspace(tmp_path, a__cpp="int a;")
    first = take_inventory(seen, WorkspaceSettings(), {})
    assert take_inventory(seen, WorkspaceSettings(), first.learned).learned == {}
    monkeypatch.setattr("roslens.source.inventory.analyser_version", lambda: "of tomorrow")
    assert "arm/a.cpp" in take_inventory(seen, WorkspaceSettings(), first.learned).learned


TINYXML = "// Original code by Lee Thomason (www.grinninglizard.com)\nint a;\n"


def roles(found) -> dict[str, Role]:
    return {file.path: file.role for file in found.files["arm"] if file.path.endswith(".cpp")}


def test_a_copied_file_without_a_folder_of_its_own_is_of_others(tmp_path: Path):
    seen = workspace(tmp_path, a__cpp="int a;", b__cpp="int b;", xml__cpp=TINYXML)
    settings = WorkspaceSettings()
    assert roles(take_inventory(seen, settings, {})) == {
        "arm/a.cpp": Role.OWN,
        "arm/b.cpp": Role.OWN,
        "arm/xml.cpp": Role.VENDORED,
    }
    ours = WorkspaceSettings(own=("arm/xml.cpp",))
    assert roles(take_inventory(seen, ours, {}))["arm/xml.cpp"] is Role.OWN


def test_the_home_of_a_library_has_no_copies_of_it(tmp_path: Path):
    seen = workspace(tmp_path, a__cpp="int a;", b__cpp=TINYXML, xml__cpp=TINYXML)
    assert set(roles(take_inventory(seen, WorkspaceSettings(), {})).values()) == {Role.OWN}


def test_a_package_with_copies_of_several_libraries_is_the_home_of_none(tmp_path: Path):
    miniz = "// miniz.c - public domain deflate\nint b;\n"
    seen = workspace(tmp_path, a__cpp="int a;", b__cpp=TINYXML, c__cpp=miniz)
    assert roles(take_inventory(seen, WorkspaceSettings(), {})) == {
        "arm/a.cpp": Role.OWN,
        "arm/b.cpp": Role.VENDORED,
        "arm/c.cpp": Role.VENDORED,
    }


def test_a_header_is_c_only_among_c(tmp_path: Path):
    found = take_inventory(workspace(tmp_path, a__c="int a;", a__h="int a;"), WorkspaceSettings(), {})
    assert {file.language for file in found.files["arm"] if file.path.endswith(".h")} == {Language.C}
    found = take_inventory(workspace(tmp_path, b__cpp="int b;"), WorkspaceSettings(), {})
    assert {file.language for file in found.files["arm"] if file.path.endswith(".h")} == {Language.CPP}


def test_a_file_that_went_away_meanwhile_is_a_failure(tmp_path: Path):
    seen = workspace(tmp_path, a__cpp="int a;", b__cpp="int b;")
    (tmp_path / "arm" / "a.cpp").unlink()
    found = take_inventory(seen, WorkspaceSettings(), {})
    (failure,) = found.failures
    assert failure.tool == "read"
    assert failure.location is not None
    assert failure.location.path == "arm/a.cpp"
    assert failure.package == "arm"
    assert "arm/b.cpp" in msgspec.json.encode(found.files).decode()


def test_folders_of_others_are_vendored_but_for_what_the_user_calls_own(tmp_path):
    for path in ("src/a.cpp", "src/b.cpp", "lib/x/LICENSE", "lib/x/x.cpp", "lib/x/test/y.cpp", "lib/date-3.0.4/d.h"):
        file = tmp_path / "p" / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    (tmp_path / "p" / "package.xml").write_text("<package><name>p</name></package>")

    def roles(settings):
        inventory = take_inventory(find_workspace([tmp_path], settings), settings, {})
        return {file.path: file.role for files in inventory.files.values() for file in files if "lib" in file.path}

    assert set(roles(WorkspaceSettings()).values()) == {Role.VENDORED}
    assert roles(WorkspaceSettings(own=("**/x.cpp",)))["p/lib/x/x.cpp"] is Role.OWN


def test_a_file_that_is_too_large_leaves_out_nothing_judged_where_it_is_a_test(tmp_path: Path, monkeypatch):
    def large(path, most=5):
        raise TooLargeError(path, most + 1, most)

    seen = workspace(tmp_path, a__cpp="int a;", test_b__py="x = 1")
    monkeypatch.setattr("roslens.source.inventory.read_bounded", large)
    found = {one.location.path: one for one in take_inventory(seen, WorkspaceSettings(), {}).failures}
    assert {path: one.partial for path, one in found.items() if path.endswith((".cpp", ".py"))} == {
        "arm/a.cpp": False,
        "arm/test_b.py": True,
    }
    assert {one.tool for one in found.values()} == {"syntax"}
