"""Which packages and files a walk finds."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from roslens.intake.bounded_file import read_bounded
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.source import OUTSIDE_PACKAGES, Package
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.find import Workspace, find_workspace, root_of
from roslens.source.workspace.manifest import read_manifest

Tree = Callable[[Mapping[str, str | bytes]], Path]

SETTINGS = WorkspaceSettings(environment={"ROS_VERSION": "2"})


def find(*paths: Path, settings: WorkspaceSettings = SETTINGS) -> Workspace:
    return find_workspace(paths, settings)


def layout(workspace: Workspace) -> dict[str, list[str]]:
    """Package ids to the paths of their files; what went wrong is not expected."""
    assert [str(failure) for failure in workspace.failures] == []
    return {found.package.id: [file.path for file in found.files] for found in workspace.packages}


def test_packages_and_their_files(tree: Tree) -> None:
    root = tree(
        {
            "src/b/package.xml": "package:b",
            "src/b/src/main.cpp": "int main() {}",
            "src/b/README.md": "",
            "src/a/package.xml": "package:a",
            "src/a/a/__init__.py": "",
        }
    )
    workspace = find(root)
    assert workspace.root == str(root.resolve())
    assert layout(workspace) == {
        "a": ["src/a/a/__init__.py", "src/a/package.xml"],
        "b": ["src/b/README.md", "src/b/package.xml", "src/b/src/main.cpp"],
    }
    assert [found.package.path for found in workspace.packages] == ["src/a", "src/b"]
    assert [found.folder for found in workspace.packages] == [f"{workspace.root}/src/a", f"{workspace.root}/src/b"]


def test_files_have_size_time_and_inode(tree: Tree) -> None:
    root = tree({"package.xml": "package:a", "a.py": "pass\n"})
    os.utime(root / "a.py", ns=(5, 1_234_567_890_123_456_789))
    file = find(root).packages[0].files[0]
    assert (file.path, file.size, file.mtime_ns) == ("a.py", 5, 1_234_567_890_123_456_789)
    assert file.inode == (root / "a.py").stat().st_ino


def test_a_package_folder_is_its_own_root(tree: Tree) -> None:
    root = tree({"src/a/package.xml": "package:a", "src/a/a.py": "", "src/b/package.xml": "package:b"})
    workspace = find(root / "src" / "a")
    assert layout(workspace) == {"a": ["a.py", "package.xml"]}
    assert workspace.packages[0].package.path == "."
    assert workspace.packages[0].package.manifest.path == "package.xml"
    assert find(root / "src/a/package.xml") == workspace


def test_several_paths_meet_in_their_parent_and_nothing_else_is_walked(tree: Tree) -> None:
    root = tree({f"src/{name}/package.xml": f"package:{name}" for name in "abc"})
    workspace = find(root / "src/c", root / "src/a", root / "src/a")
    assert workspace.root == str((root / "src").resolve())
    assert layout(workspace) == {"a": ["a/package.xml"], "c": ["c/package.xml"]}


def test_a_path_inside_another_adds_nothing(tree: Tree) -> None:
    root = tree({"a/package.xml": "package:a", "ab/package.xml": "package:ab"})
    assert find(root, root / "a") == find(root)
    assert list(layout(find(root / "a", root / "ab"))) == ["a", "ab"]


def test_the_root_is_known_without_a_walk(tree: Tree, monkeypatch: pytest.MonkeyPatch) -> None:
    root = tree({"a/package.xml": "package:a", "b/c/x.py": ""})
    assert root_of([root / "a"]) == (root / "a").resolve()
    assert root_of([root / "a", root / "b/c"]) == root.resolve()
    monkeypatch.chdir(root / "b")
    assert root_of([]) == (root / "b").resolve()


def test_a_path_that_does_not_exist_is_an_error(tree: Tree) -> None:
    root = tree({"a/package.xml": "package:a", "a/a.py": ""})
    with pytest.raises(UsageError, match="does not exist"):
        find(root / "nothing")
    with pytest.raises(UsageError, match="is not a folder"):
        find(root / "a/a.py")
    with pytest.raises(UsageError, match="does not exist"):
        find(root / "a/\0")


@pytest.mark.parametrize("marker", ["CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"])
def test_markers_hide_a_folder_and_all_below(tree: Tree, marker: str) -> None:
    root = tree(
        {
            "a/package.xml": "package:a",
            "a/seen.py": "",
            f"a/old/{marker}": "",
            "a/old/hidden.py": "",
            f"b/{marker}": "",
            "b/package.xml": "package:b",
            "b/c/package.xml": "package:c",
        }
    )
    assert layout(find(root)) == {"a": ["a/package.xml", "a/seen.py"]}


def test_outputs_are_not_walked(tree: Tree) -> None:
    root = tree(
        {
            "src/a/package.xml": "package:a",
            "build/a/package.xml": "package:a",
            "install/a/share/a/package.xml": "package:a",
            "devel/share/a/package.xml": "package:a",
            "log/build.py": "",
            "build_isolated/a/package.xml": "package:a",
            "out/CMakeCache.txt": "",
            "out/a.cpp": "",
            "src/a/.git/hook.py": "",
            "src/a/__pycache__/a.py": "",
            "src/a/a.egg-info/b.py": "",
            ".hidden/package.xml": "package:hidden",
        }
    )
    assert layout(find(root)) == {"a": ["src/a/package.xml"]}


def test_source_folders_named_like_outputs_are_walked_inside_packages(tree: Tree) -> None:
    root = tree(
        {
            "a/package.xml": "package:a",
            "a/log/log.cpp": "",
            "a/src/build/builder.py": "",
            "a/install/setup_tool.py": "",
            "log/package.xml": "package:log",
            "log/log.py": "",
        }
    )
    assert layout(find(root)) == {
        "a": ["a/install/setup_tool.py", "a/log/log.cpp", "a/package.xml", "a/src/build/builder.py"],
        "log": ["log/log.py", "log/package.xml"],
    }


@pytest.mark.parametrize(
    "sign", ["build/CMakeCache.txt", "build/CMakeFiles/x", "install/setup.bash", "devel/.catkin", "log/latest_build/x"]
)
def test_outputs_inside_packages_are_not_walked(tree: Tree, sign: str) -> None:
    root = tree({"package.xml": "package:a", sign: "", f"{sign.split('/')[0]}/copy.cpp": ""})
    assert layout(find(root)) == {"a": ["package.xml"]}


def test_what_setup_py_built_is_not_walked(tree: Tree) -> None:
    root = tree({"package.xml": "package:a", "setup.py": "", "build/lib/a/a.py": "", "build/bdist.linux/x": ""})
    assert layout(find(root)) == {"a": ["package.xml", "setup.py"]}


def test_a_build_in_the_source_folder_hides_nothing(tree: Tree) -> None:
    root = tree({"package.xml": "package:a", "CMakeLists.txt": "", "CMakeCache.txt": "", "sub/a.cpp": ""})
    assert "sub/a.cpp" in layout(find(root))["a"]


def test_a_given_folder_is_walked_whatever_its_name(tree: Tree) -> None:
    root = tree({"build/a/package.xml": "package:a"})
    assert layout(find(root / "build")) == {"a": ["a/package.xml"]}


def test_packages_inside_packages_keep_their_files(tree: Tree) -> None:
    root = tree(
        {
            "package.xml": "package:outer",
            "outer.py": "",
            "plugins/inner/package.xml": "package:inner",
            "plugins/inner/inner.py": "",
            "plugins/plugin.py": "",
            "src/ws/src/deep/package.xml": "package:deep",
        }
    )
    assert layout(find(root)) == {
        "outer": ["outer.py", "package.xml", "plugins/plugin.py"],
        "inner": ["plugins/inner/inner.py", "plugins/inner/package.xml"],
        "deep": ["src/ws/src/deep/package.xml"],
    }


def test_source_outside_packages_is_not_lost(tree: Tree) -> None:
    root = tree(
        {
            "a/package.xml": "package:a",
            "tools/tool.py": "",
            "CMakeLists.txt": "",
            "README.md": "",
            "launch/all.py": "",
            "docker-compose.yml": "",
        }
    )
    workspace = find(root)
    assert layout(workspace) == {
        OUTSIDE_PACKAGES: ["CMakeLists.txt", "launch/all.py", "tools/tool.py"],
        "a": ["a/package.xml"],
    }
    outside = workspace.packages[0].package
    assert (outside.path, outside.build_type, outside.version) == (".", "", "")


def test_documents_alone_outside_packages_make_no_package(tree: Tree) -> None:
    root = tree({"a/package.xml": "package:a", "CMakeLists.txt": "", "README.md": "", "doc/conf.yaml": ""})
    assert list(layout(find(root))) == ["a"]


def failure(workspace: Workspace) -> Failure:
    assert len(workspace.failures) == 1
    return workspace.failures[0]


def test_an_empty_workspace_is_told(tree: Tree) -> None:
    root = tree({"README.md": ""})
    workspace = find(root)
    assert workspace.packages == ()
    assert failure(workspace).what == f'no package and no source file below "{root.resolve()}"'
    assert failure(workspace).advice == "Give the folder of a package or of a workspace."


def test_an_empty_folder_in_a_package_names_the_package(tree: Tree) -> None:
    root = tree({"a/package.xml": "package:a", "a/doc/README.md": ""})
    assert failure(find(root / "a/doc")).advice == f'Give "{root.resolve()}/a", the package around it.'


def test_a_marker_that_hides_everything_is_named(tree: Tree) -> None:
    root = tree({"package.xml": "package:a", "COLCON_IGNORE": ""})
    assert failure(find(root)).advice == 'Remove "COLCON_IGNORE", which hides ".", or give another folder.'


def test_doubled_names_get_their_path(tree: Tree) -> None:
    root = tree({"x/a/package.xml": "package:a", "y/a/package.xml": "package:a", "b/package.xml": "package:b"})
    workspace = find(root)
    assert [found.package.id for found in workspace.packages] == ["b", "a@x/a", "a@y/a"]
    assert [found.package.name for found in workspace.packages] == ["b", "a", "a"]
    reported = failure(workspace)
    assert reported.what == '2 packages have the name "a", in "x/a", "y/a"'
    assert (str(reported.location), reported.package, reported.partial) == ("y/a/package.xml:2:3", "a@y/a", True)


def test_failures_of_doubled_packages_name_their_id(tree: Tree) -> None:
    root = tree({"x/a/package.xml": "package:a", "y/a/package.xml": "<package><name>a</name>"})
    workspace = find(root)
    assert {one.package for one in workspace.failures} == {"a@y/a"}


def test_a_broken_manifest_leaves_the_rest(tree: Tree) -> None:
    root = tree({"a/package.xml": "<package", "a/a.py": "", "b/package.xml": "package:b"})
    workspace = find(root)
    assert [found.package.id for found in workspace.packages] == ["a", "b"]
    assert [file.path for file in workspace.packages[0].files] == ["a/a.py", "a/package.xml"]
    assert failure(workspace).package == "a"
    assert str(failure(workspace).location) == "a/package.xml:1:1"


def test_a_nameless_package_at_the_root_is_named_by_its_folder(tree: Tree) -> None:
    root = tree({"package.xml": "<package/>"})
    workspace = find(root)
    assert (workspace.packages[0].package.id, workspace.packages[0].package.path) == ("ws", ".")
    assert {one.package for one in workspace.failures} == {"ws"}


def test_repositories(tree: Tree) -> None:
    root = tree(
        {
            "src/nav/.git/HEAD": "",
            "src/nav/planner/package.xml": "package:planner",
            "src/nav/deps/sub/.git": "gitdir: elsewhere",
            "src/nav/deps/sub/lib/package.xml": "package:lib",
            "src/plain/a/package.xml": "package:a",
            "src/alone/package.xml": "package:alone",
        }
    )
    found = {one.package.id: one.package.repository for one in find(root).packages}
    assert found == {"planner": "nav", "lib": "sub", "a": "plain", "alone": ""}
    inside = find(root / "src/nav/planner", root / "src/nav/deps")
    assert {one.package.id: one.package.repository for one in inside.packages} == {"planner": "nav", "lib": "sub"}
    assert find(root / "src/nav").packages[1].package.repository == "nav"


def test_links_are_followed_once(tree: Tree) -> None:
    root = tree(
        {
            "src/a/package.xml": "package:a",
            "src/a/a.py": "",
            "src/a/loop": "link:.",
            "src/a/up": "link:../..",
            "src/a/top": "link:/",
            "src/a/twin.py": "link:a.py",
            "src/a/self": "link:self",
            "src/again": "link:a",
            "src/outside": "link:../../elsewhere",
            "../elsewhere/package.xml": "package:elsewhere",
            "../elsewhere/e.py": "",
            "../elsewhere/back": "link:../ws/src",
            "../elsewhere/around": "link:..",
        }
    )
    workspace = find(root)
    assert layout(workspace) == {
        "a": ["src/a/a.py", "src/a/package.xml"],
        "elsewhere": ["src/outside/e.py", "src/outside/package.xml"],
    }
    assert workspace.packages[1].folder == str((root / "../elsewhere").resolve())


@pytest.mark.parametrize("target", ["a" * 300, "/".join(["b" * 200] * 15), "link"])
def test_a_link_to_a_name_that_cannot_be_hides_nothing_else(tree: Tree, target: str) -> None:
    root = tree({"src/a/package.xml": "package:a", "src/a/link": f"link:{target}", "src/a/z.cpp": f"link:{target}"})
    workspace = find(root)
    assert [file.path for package in workspace.packages for file in package.files] == ["src/a/package.xml"]
    assert str(failure(workspace).location) == "src/a/z.cpp"
    assert "leads nowhere" in failure(workspace).what


def test_two_links_to_one_folder_give_it_once(tree: Tree) -> None:
    root = tree({"b": "link:../elsewhere", "a": "link:../elsewhere", "../elsewhere/package.xml": "package:e"})
    assert layout(find(root)) == {"e": ["a/package.xml"]}


def test_a_linked_manifest_makes_a_package(tree: Tree) -> None:
    root = tree({"a/package.xml": "link:package_ros2.xml", "a/package_ros2.xml": "package:a", "a/a.py": ""})
    assert layout(find(root)) == {"a": ["a/a.py", "a/package.xml", "a/package_ros2.xml"]}


def test_a_link_to_source_that_leads_nowhere_is_told(tree: Tree) -> None:
    root = tree({"package.xml": "package:a", "gone.cpp": "link:nowhere.cpp", "mesh.dae": "link:nowhere.dae"})
    workspace = find(root)
    assert str(failure(workspace).location) == "gone.cpp"
    assert failure(workspace).what.startswith('the link to "nowhere.cpp" leads nowhere')


def test_names_that_are_not_utf_8_are_told(tree: Tree) -> None:
    root = tree({"package.xml": "package:a"})
    (Path(os.fsdecode(os.fsencode(root) + b"/\xe4.py"))).write_text("")
    (root / "ä.py").write_text("")
    workspace = find(root)
    assert [file.path for file in workspace.packages[0].files] == ["package.xml", "ä.py"]
    assert failure(workspace).what == 'the name "\\xe4.py" is not UTF-8'


def test_pipes_and_devices_are_left_alone_and_told_where_they_are_named_like_source(tree: Tree) -> None:
    root = tree({"package.xml": "package:a"})
    os.mkfifo(root / "src.cpp")
    os.mkfifo(root / "control")
    (root / "zero.cpp").symlink_to("/dev/zero")
    found = find(root)
    assert [file.path for file in found.packages[0].files] == ["package.xml"]
    reported = [(failure.location.path, failure.what) for failure in found.failures if failure.location]
    assert reported == [(path, "it is a pipe, a socket or a device") for path in ("src.cpp", "zero.cpp")]


def test_a_folder_that_cannot_be_read_is_told(tree: Tree, monkeypatch: pytest.MonkeyPatch) -> None:
    root = tree({"a/package.xml": "package:a", "a/secret/x.py": "", "b/package.xml": "package:b"})
    scan = os.scandir

    def refusing(path: str) -> object:
        if str(path).endswith("secret"):
            raise PermissionError(13, "Permission denied")
        return scan(path)

    monkeypatch.setattr(os, "scandir", refusing)
    workspace = find(root)
    assert [found.package.id for found in workspace.packages] == ["a", "b"]
    assert str(failure(workspace)).startswith("a/secret: the folder cannot be read, Permission denied; expected")


def test_a_manifest_that_cannot_be_read_is_told(tree: Tree, monkeypatch: pytest.MonkeyPatch) -> None:
    root = tree({"a/package.xml": "package:real_name", "b/package.xml": "package:b"})

    def refusing(path: str, most_bytes: int) -> bytes:
        if Path(path).parent.name == "a":
            raise PermissionError(13, "Permission denied")
        return read_bounded(path, most_bytes)

    monkeypatch.setattr("roslens.source.workspace.find.read_bounded", refusing)
    workspace = find(root)
    assert [found.package.id for found in workspace.packages] == ["a", "b"]
    assert failure(workspace).what == "the manifest cannot be read, Permission denied"


def test_ignored_paths_are_left_out(tree: Tree) -> None:
    root = tree(
        {
            "a/package.xml": "package:a",
            "a/keep.py": "",
            "a/skip.py": "",
            "a/deep/er/data.py": "",
            "b/package.xml": "package:b",
        }
    )
    settings = WorkspaceSettings(ignore=("b", "**/skip.*", "a/deep/**"))
    assert layout(find(root, settings=settings)) == {"a": ["a/keep.py", "a/package.xml"]}


def test_the_reader_can_be_exchanged(tree: Tree) -> None:
    root = tree({"a/package.xml": "package:a"})
    seen: list[tuple[bytes, str, Mapping[str, str]]] = []

    def reader(content: bytes, path: str, environment: Mapping[str, str]) -> tuple[Package | None, tuple[Failure, ...]]:
        seen.append((content, path, environment))
        return read_manifest(content, path, environment)

    assert find_workspace([root], SETTINGS, read=reader) == find(root)
    assert seen == [((root / "a/package.xml").read_bytes(), "a/package.xml", {"ROS_VERSION": "2"})]


def test_nothing_but_manifests_is_opened(tree: Tree, monkeypatch: pytest.MonkeyPatch) -> None:
    root = tree({"a/package.xml": "package:a", "a/a.py": "", "tools/t.py": ""})
    paths: list[str] = []

    def watching(path: str, most_bytes: int) -> bytes:
        paths.append(Path(path).name)
        return read_bounded(path, most_bytes)

    monkeypatch.setattr("roslens.source.workspace.find.read_bounded", watching)
    monkeypatch.setattr(Path, "open", lambda path, *_: pytest.fail(f"opened {path}"))
    find(root)
    assert paths == ["package.xml"]


def test_two_walks_are_equal(tree: Tree) -> None:
    root = tree({f"{name}/package.xml": f"package:{name}" for name in "dbca"} | {"x/l": "link:../a", "y.py": ""})
    assert find(root) == find(root)
