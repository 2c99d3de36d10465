"""What packages make, worked out by hand; a plain one is held against cmake itself."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.extract.builds.targets import build_of, targets_of
from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.facts.node_facts import Generated, Sure, TargetKind

ROOT = Path(__file__).parents[3] / "fixtures" / "extract" / "cmake"
EXAMPLES = Path(__file__).parents[4] / "examples" / "workspace"


class Written:
    def __init__(self, files):
        self.files = files

    def package(self, name):
        return name if f"{name}/package.xml" in self.files else None

    def content(self, path):
        return self.files.get(path)


def build(cmake="", *paths, kind="ament_cmake", **files):
    found = {"pkg/CMakeLists.txt": f"project(pkg)\n{cmake}".encode()} if cmake else {}
    found |= {f"pkg/{path}": b"" for path in paths}
    found |= {path: text.encode() for path, text in files.pop("files", {}).items()}
    return build_of("pkg", "pkg", kind, Written(found), [path for path in found if path.startswith("pkg/")])


def of(found, kind):
    return {one.name: one for one in found.targets if one.kind is kind}


def reasons(found):
    return [(one.text, one.reason) for one in found.unresolved]


def test_an_executable_has_the_sources_of_its_libraries():
    found = build(
        "add_library(core STATIC core.cpp)\nadd_library(pkg::core ALIAS core)\nadd_library(objects OBJECT o.cpp)\n"
        "add_library(mid mid $<TARGET_OBJECTS:objects>)\ntarget_link_libraries(mid PUBLIC pkg::core other::x -lm)\n"
        "add_executable(node main.cpp)\ntarget_link_libraries(node PRIVATE mid)\ntarget_link_libraries(core mid)\n"
        "target_sources(node PRIVATE more.cpp)\n"
        "install(TARGETS node core DESTINATION lib/${PROJECT_NAME})\ninstall(TARGETS mid LIBRARY DESTINATION lib)",
        "core.cpp", "o.cpp", "mid.cpp", "main.cpp", "more.cpp",
    )  # fmt: skip
    node = of(found, TargetKind.EXECUTABLE)["node"]
    assert node.sources == ("pkg/main.cpp", "pkg/more.cpp", "pkg/mid.cpp", "pkg/core.cpp", "pkg/o.cpp")
    assert (node.installed, node.evidence.line, node.evidence.sure) == (True, 7, Sure.CERTAIN)
    assert set(of(found, TargetKind.LIBRARY)) == {"core", "objects", "mid"}
    assert not found.unresolved


@pytest.mark.parametrize(
    ("install", "installed"),
    [
        ("DESTINATION lib/${PROJECT_NAME}", True),
        ("RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION} LIBRARY DESTINATION lib", True),
        ("RUNTIME DESTINATION ${CMAKE_INSTALL_PREFIX}/lib/pkg", True),
        ("ARCHIVE DESTINATION lib RUNTIME DESTINATION bin", False),
        ("DESTINATION lib/other", False),
        ("", False),
    ],
)
def test_what_run_finds(install, installed):
    found = build(f"add_executable(node a.cpp)\ninstall(TARGETS node {install})", "a.cpp")
    assert of(found, TargetKind.EXECUTABLE)["node"].installed is installed


def test_components():
    found = build(
        "add_library(parts SHARED a.cpp b.cpp)\n"
        'rclcpp_components_register_node(parts PLUGIN "ns::A" EXECUTABLE a_node)\n'
        'rclcpp_components_register_nodes(parts "ns::B" "ns::C")\n'
        'rclcpp_components_register_nodes(gone "ns::D")',
        "a.cpp", "b.cpp",
    )  # fmt: skip
    components = of(found, TargetKind.COMPONENT)
    assert sorted(components) == ["ns::A", "ns::B", "ns::C", "ns::D"]
    assert components["ns::B"].library == "parts"
    assert components["ns::B"].sources == ("pkg/a.cpp", "pkg/b.cpp")
    program = of(found, TargetKind.EXECUTABLE)["a_node"]
    assert (program.entry, program.sources, program.installed) == ("ns::A", ("pkg/a.cpp", "pkg/b.cpp"), True)
    assert reasons(found) == [("gone", "the library of a component is not built by the package")]


def test_the_plural_registers_what_stands_behind_a_word_of_the_singular():
    found = build(
        'add_library(parts SHARED a.cpp)\nrclcpp_components_register_nodes(parts PLUGIN "ns::A" EXECUTABLE a_node)',
        "a.cpp",
    )
    assert list(of(found, TargetKind.COMPONENT)) == ["ns::A"]
    assert "a_node" not in of(found, TargetKind.EXECUTABLE), "it makes no program"


def test_what_another_build_type_makes_is_unknown():
    listing = ["pkg/package.xml", "pkg/Cargo.toml", "pkg/src/main.rs"]
    assert targets_of("pkg", "pkg", "cmake", Written({}), listing) == ((), ())
    targets, unresolved = targets_of("pkg", "pkg", "ament_cargo", Written({}), listing)
    assert targets == ()
    assert [(one.evidence.path, one.reason) for one in unresolved] == [
        ("pkg/package.xml", "nothing is known of what the build type ament_cargo makes")
    ]


def test_tests_are_not_installed():
    found = build(
        "if(BUILD_TESTING)\nament_add_gtest(t t.cpp TIMEOUT 30 ENV A=b.cpp)\nendif()\n"
        "add_rostest_gtest(r r.test r.cpp)\ncatkin_add_gmock(m m.cpp)",
        "t.cpp", "r.cpp", "m.cpp",
    )  # fmt: skip
    tests = of(found, TargetKind.EXECUTABLE)
    assert {name: (one.sources[0], one.installed) for name, one in tests.items()} == {
        "t": ("pkg/t.cpp", False), "r": ("pkg/r.cpp", False), "m": ("pkg/m.cpp", False)
    }  # fmt: skip
    assert tests["t"].conditions == ("BUILD_TESTING",)


def test_conditions():
    found = build(
        "if(WIN32)\nadd_executable(w a.cpp)\n"
        "elseif(X_FOUND)\nadd_executable(x a.cpp)\nelse()\nadd_executable(y a.cpp)\n"
        "endif()\nif(Y_FOUND)\nadd_executable(z a.cpp)\nelse()\nadd_executable(z a.cpp)\nendif()",
        "a.cpp",
    )
    assert {name: one.conditions for name, one in of(found, TargetKind.EXECUTABLE).items()} == {
        "x": ("X_FOUND",), "y": ("NOT (X_FOUND)",), "z": ()
    }  # fmt: skip


def test_sources_that_depend_on_a_condition_are_likely():
    found = build(
        "set(S a.cpp)\n"
        "if(X_FOUND)\nlist(APPEND S b.cpp)\nelse()\nlist(APPEND S c.cpp)\nendif()\nadd_executable(n ${S})",
        "a.cpp", "b.cpp", "c.cpp",
    )  # fmt: skip
    node = of(found, TargetKind.EXECUTABLE)["n"]
    assert node.sources == ("pkg/a.cpp", "pkg/b.cpp", "pkg/c.cpp")
    assert node.evidence.sure is Sure.LIKELY


def test_what_cannot_be_told_is_said():
    found = build(
        "add_executable(n a.cpp gone.cpp ${X_LIBRARIES} "
        "${CMAKE_CURRENT_BINARY_DIR}/made.cpp $<$<CONFIG:Debug>:d.cpp>)\n"
        "add_executable(${UNKNOWN_VERSION} a.cpp)\nmystery(a.cpp)",
        "a.cpp",
    )
    assert reasons(found) == [
        ("add_executable({UNKNOWN_VERSION of the build environment})",
         "its name is unknown: UNKNOWN_VERSION of the build environment"),
        ("mystery()", "the command is not defined in the workspace"),
        ("gone.cpp", "a source is not among the files of the package"),
        ("{X_LIBRARIES of the build environment}", "a source is unknown: X_LIBRARIES of the build environment"),
        ("pkg/made.cpp", "a source is generated by the build"),
        ("$<$<CONFIG:Debug>:d.cpp>", "a source depends on a generator expression"),
    ]  # fmt: skip
    assert of(found, TargetKind.EXECUTABLE)["n"].evidence.sure is Sure.LIKELY


def test_automatic_packages():
    found = build(
        "ament_auto_add_library(core SHARED DIRECTORY src/core)\nament_auto_add_executable(node src/main.cpp)\n"
        "ament_auto_package(INSTALL_TO_SHARE launch)",
        "src/core/a.cpp", "src/core/deep/b.cc", "src/main.cpp", "launch/x.launch.py",
    )  # fmt: skip
    node = of(found, TargetKind.EXECUTABLE)["node"]
    assert node.sources == ("pkg/src/main.cpp", "pkg/src/core/a.cpp", "pkg/src/core/deep/b.cc")
    assert node.installed
    assert found.installed == (("pkg/launch", "share/pkg/launch"),)


def test_scripts_and_folders():
    found = build(
        "install(PROGRAMS scripts/a.py scripts/gone DESTINATION lib/${PROJECT_NAME})\n"
        "install(PROGRAMS scripts/b.sh DESTINATION lib/${PROJECT_NAME} RENAME bee)\n"
        "catkin_install_python(PROGRAMS scripts/c DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})\n"
        'install(DIRECTORY nodes/ DESTINATION lib/${PROJECT_NAME} FILES_MATCHING PATTERN "*.py")\n'
        "install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME})\n"
        "install(FILES p.xml DESTINATION share/pkg)",
        "scripts/a.py", "scripts/b.sh", "scripts/c", "nodes/d.py", "nodes/e.txt",
        "launch/l.launch", "config/c.yaml", "p.xml",
    )  # fmt: skip
    assert {name: (one.sources[0], one.installed) for name, one in of(found, TargetKind.SCRIPT).items()} == {
        "a.py": ("pkg/scripts/a.py", True), "bee": ("pkg/scripts/b.sh", True), "c": ("pkg/scripts/c", False),
        "d.py": ("pkg/nodes/d.py", True),
    }  # fmt: skip
    assert ("pkg/launch", "share/pkg/launch") in found.installed
    assert ("pkg/p.xml", "share/pkg/p.xml") in found.installed
    assert reasons(found) == [("scripts/gone", "a program is not among the files of the package")]


def test_interfaces():
    files = ("msg/A.msg", "msg/B.msg", "srv/C.srv", "action/D.action")
    found = build(
        'set(M msg/A.msg)\nrosidl_generate_interfaces(${PROJECT_NAME} ${M} "srv:C.srv" DEPENDENCIES std_msgs)', *files
    )
    assert found.interfaces == ("pkg/msg/A.msg", "pkg/srv/C.srv")
    found = build(
        "add_message_files(FILES A.msg)\nadd_service_files()\nadd_action_files(DIRECTORY action FILES D.action)", *files
    )
    assert found.interfaces == ("pkg/msg/A.msg", "pkg/srv/C.srv", "pkg/action/D.action")


def test_plug_ins_and_nodelets():
    found = build(
        "add_library(${PROJECT_NAME}_plugins MODULE a.cpp)\nadd_library(lets b.cpp)\n"
        "set_target_properties(lets PROPERTIES OUTPUT_NAME my_lets)\n"
        "pluginlib_export_plugin_description_file(nav2_core plugins.xml)",
        "a.cpp", "b.cpp",
        files={
            "pkg/plugins.xml": '<class_libraries><library path="pkg_plugins">'
            '<class type="n::A" base_class_type="n::Base"/>'
            '</library><library path="gone">'
            '<class name="g" type="n::G" base_class_type="n::Base"/></library></class_libraries>',
            "pkg/lets.xml": '<library path="lib/libmy_lets"><class name="pkg/Let" type="n::Let" '
            'base_class_type="nodelet::Nodelet"/></library>',
            "pkg/package.xml": '<package><export><nodelet plugin="${prefix}/lets.xml"/><x plugin="${prefix}/no.xml"/>'
            "<build_type>catkin</build_type></export></package>",
        },
    )  # fmt: skip
    plugins, nodelets = of(found, TargetKind.PLUGIN), of(found, TargetKind.NODELET)
    assert (plugins["n::A"].library, plugins["n::A"].sources) == ("pkg_plugins", ("pkg/a.cpp",))
    assert (nodelets["pkg/Let"].entry, nodelets["pkg/Let"].library) == ("n::Let", "lets")
    assert nodelets["pkg/Let"].sources == ("pkg/b.cpp",)
    assert reasons(found) == [
        ("pkg/no.xml", "a description is not among the files of the package"),
        ("gone", "the library of a plug-in is not built by the package"),
    ]


def test_plug_ins_in_python():
    found = build(
        files={
            "pkg/plugin.xml": '<library path="src"><class name="View" type="rqt_x.view.View" '
            'base_class_type="rqt_gui_py::Plugin"/></library>',
            "pkg/package.xml": '<package><export><rqt_gui plugin="${prefix}/plugin.xml"/></export></package>',
            "pkg/src/rqt_x/view.py": "",
        },
    )
    assert of(found, TargetKind.PLUGIN)["View"].sources == ("pkg/src/rqt_x/view.py",)


SETUP = "from setuptools import setup\nsetup(name='pkg', entry_points={'console_scripts': ['talk = pkg.talk:main']})\n"


@pytest.mark.parametrize(
    ("config", "installed"),
    [("[develop]\nscript_dir=$base/lib/pkg\n[install]\ninstall_scripts=$base/lib/pkg\n", True), ("", False)],
)
def test_programs_in_python(config, installed):
    found = build(kind="ament_python", files={"pkg/setup.py": SETUP, "pkg/setup.cfg": config, "pkg/pkg/talk.py": ""})
    talk = of(found, TargetKind.SCRIPT)["talk"]
    assert (talk.entry, talk.sources, talk.installed) == ("pkg.talk:main", ("pkg/pkg/talk.py",), installed)
    assert (talk.evidence.path, talk.evidence.line) == ("pkg/setup.py", 2)


def test_a_package_that_is_hostile_ends():
    for text in (
        "if(1)\ninclude(CMakeLists.txt)\nendif()\n",
        "set(A ${A}xxxx${A}y)\n" * 30_000,
        "foreach(i RANGE 999)\nforeach(j RANGE 999)\nx()\n" + "endforeach()\n" * 2 + "",
    ):
        assert build(text + "\nadd_executable(n a.cpp)", "a.cpp").unresolved


def test_a_package_without_anything():
    assert targets_of("pkg", "pkg", "catkin", Written({}), []) == ((), ())


def test_the_example_workspace():
    names = {"rover_base": "ament_cmake", "rover_navigation": "ament_cmake"}
    files = FolderFiles(EXAMPLES / "src/rover", {name: name for name in names})
    programs = {}
    for name, kind in names.items():
        root = EXAMPLES / "src/rover"
        listing = [path.relative_to(root).as_posix() for path in sorted((root / name).rglob("*")) if path.is_file()]
        targets, unresolved = targets_of(name, name, kind, files, listing)
        assert not unresolved
        programs |= {one.name: one for one in targets if one.kind is TargetKind.EXECUTABLE and one.installed}
    assert sorted(programs) == ["base_node", "follower_node"]
    assert "rover_base/third_party/crc8/crc8.c" in programs["base_node"].sources


PLAIN = ROOT / "plain"


def plain():
    listing = [path.relative_to(ROOT).as_posix() for path in sorted(PLAIN.rglob("*")) if path.is_file()]
    return build_of("plain", "plain", "cmake", FolderFiles(ROOT, {"plain": "plain"}), listing)


def test_a_plain_package():
    found = plain()
    assert not found.unresolved
    assert {one.name: one.sources for one in found.targets if one.kind is TargetKind.LIBRARY} == {
        "shapes": ("plain/shapes/circle.c", "plain/shapes/square.c"),
        "parts": ("plain/parts.c",),
        "made_one": ("plain/one.c", "plain/shapes/circle.c", "plain/shapes/square.c"),
        "made_two": ("plain/two.c", "plain/shapes/circle.c", "plain/shapes/square.c"),
    }


@pytest.mark.real
@pytest.mark.skipif(shutil.which("cmake") is None or shutil.which("cc") is None, reason="no cmake or compiler")
def test_a_plain_package_is_what_cmake_makes(tmp_path):
    query = tmp_path / ".cmake/api/v1/query/codemodel-v2"
    query.parent.mkdir(parents=True)
    query.touch()
    subprocess.run(["cmake", "-S", PLAIN, "-B", tmp_path], check=True, capture_output=True)
    made = {}
    for path in (tmp_path / ".cmake/api/v1/reply").glob("target-*.json"):
        target = json.loads(path.read_bytes())
        if target["type"] != "UTILITY":
            made[target["name"]] = {
                f"plain/{one['path']}" for one in target["sources"] if not one["path"].endswith(".o")
            }
    found = {one.name: set(one.sources) for one in plain().targets}
    assert set(found) == set(made)
    assert all(made[name] <= found[name] for name in made)
    # What we have besides are the sources of linked libraries.
    every = set().union(*made.values())
    assert all(found[name] <= every for name in found)


REAL = [path.read_bytes() for path in sorted([*EXAMPLES.rglob("CMakeLists.txt"), PLAIN / "CMakeLists.txt"])]
PIECES = ["", '"', "(", ")", "${", "}", "[[", "#", ";", "\\", "$<", "if(X_FOUND)\n", "endif()\n", "else()\n",
          "return()\n",
          "foreach(i RANGE 99)\n",
          "function(f)\n", "endfunction()\n", "${ARGN}", "set()\n", "install(TARGETS)\n", "add_library()\n",
          "include(CMakeLists.txt)\n",
          "add_subdirectory(.)\n", "string()\n", "list(GET A 1)\n", "add_rostest_gtest(a)\n",
          "set_property(TARGET x PROPERTY)\n"]  # fmt: skip


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from(REAL),
    st.lists(st.tuples(st.integers(0, 2000), st.integers(0, 30), st.sampled_from(PIECES)), max_size=6),
)
def test_mutated_packages_never_fail(content, edits):
    for at, gone, piece in edits:
        content = content[:at] + piece.encode() + content[at + gone :]
    files = {"pkg/CMakeLists.txt": content, "pkg/src/a.cpp": b""}
    build_of("pkg", "pkg", "catkin", Written(files), list(files))


def test_files_of_parameters_of_which_code_is_generated():
    found = build(
        "set(NAME demo_parameters)\ngenerate_parameter_library(${NAME} src/demo.yaml include/checks.hpp)\n"
        "generate_parameter_module(other pkg/other.yaml)\ngenerate_parameter_library(gone src/gone.yaml)",
        "src/demo.yaml", "pkg/other.yaml",
    )  # fmt: skip
    assert found.parameters == (
        Generated("demo_parameters", "pkg/src/demo.yaml"),
        Generated("other", "pkg/pkg/other.yaml", python=True),
    )
    assert reasons(found) == [("src/gone.yaml", "a file of parameters is not among the files of the package")]


def test_files_of_parameters_of_a_python_package():
    setup = "name = 'pkg'\nif True:\n    generate_parameter_module('demo', name + '/demo.yaml')\nsetup(name=name)\n"
    found = build("", "pkg/demo.yaml", kind="ament_python", files={"pkg/setup.py": setup})
    assert found.parameters == (Generated("demo", "pkg/pkg/demo.yaml", python=True),)
