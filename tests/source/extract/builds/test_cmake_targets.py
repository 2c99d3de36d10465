"""What commands that make targets are given; what comes of it is in test_targets."""

from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_commands import COMMANDS, IGNORED
from roslens.source.extract.builds.cmake_evaluation import Evaluation
from roslens.source.extract.builds.cmake_syntax import parse_cmake
from roslens.source.extract.builds.cmake_targets import Collected


class Nothing:
    def package(self, name):
        return None

    def content(self, path):
        return None


def collected(text, *listing):
    found = Collected()
    run = Evaluation("pkg", Nothing(), listing, {**COMMANDS, **found.handlers()}, IGNORED, BLOCKS)
    run.run_file("pkg/CMakeLists.txt", parse_cmake(text.encode()))
    return found


def texts(items):
    return [one.text for one in items]


def test_keywords_are_no_sources():
    found = collected(
        "add_library(a SHARED EXCLUDE_FROM_ALL x.cpp)\nadd_executable(b WIN32 y.cpp)\nadd_library(c::c ALIAS a)\n"
        "add_library(d SHARED IMPORTED)\nadd_executable()\ntarget_sources(c::c PUBLIC z.cpp)\n"
        "target_link_libraries(b PUBLIC a debug m LINK_PRIVATE n)"
    )
    assert texts(found.made["a"][0].sources) == ["x.cpp", "z.cpp"]
    assert found.made["a"][0].form == "SHARED"
    assert texts(found.made["b"][0].sources) == ["y.cpp"]
    assert texts(found.made["b"][0].links) == ["a", "m", "n"]
    assert found.aliases == {"c::c": "a"}
    assert sorted(found.made) == ["a", "b"]


def test_properties():
    found = collected(
        "add_library(a x.c)\nadd_library(b y.c)\nset_target_properties(a b PROPERTIES VERSION 1 OUTPUT_NAME n)\n"
        "set_property(TARGET a PROPERTY OUTPUT_NAME m)\nset_property(TARGET b APPEND PROPERTY SOURCES z.c)\n"
        "set_property(TARGET)\nset_target_properties(a PROPERTIES ODD)"
    )
    assert [found.made[name][0].output for name in "ab"] == ["m", "n"]
    assert texts(found.made["b"][0].sources) == ["y.c", "z.c"]


def test_places_of_installation():
    found = collected(
        "add_library(a x.c)\nadd_executable(b y.c)\n"
        "install(TARGETS a b EXPORT e ARCHIVE DESTINATION lib LIBRARY DESTINATION lib64 RUNTIME DESTINATION bin/x)\n"
        "install(TARGETS b)\ninstall(EXPORT e DESTINATION share)\ninstall()"
    )
    assert found.made["a"][0].installed == ["lib64"]
    assert found.made["b"][0].installed == ["bin/x", "bin"]


def test_files_that_are_installed():
    found = collected(
        "install(FILES a.sh DESTINATION d PERMISSIONS OWNER_READ OWNER_EXECUTE)\n"
        "install(FILES b c DESTINATION e RENAME f)\n"
        'install(DIRECTORY g DESTINATION h FILES_MATCHING PATTERN "*.py" PATTERN ".svn" EXCLUDE)'
    )
    assert [(one.kind, one.item.text, one.destination, one.rename, one.only) for one in found.installed] == [
        ("programs", "a.sh", "d", "", ()),
        ("files", "b", "e", "f", ()),
        ("files", "c", "e", "f", ()),
        ("directory", "g", "h", "", ("*.py",)),
    ]


def test_targets_of_one_name_on_both_sides():
    found = collected(
        "if(X_FOUND)\nadd_library(a x.c)\nelse()\nadd_library(a y.c)\nendif()\ntarget_link_libraries(a b)"
    )
    assert [(texts(one.sources), one.conditions, texts(one.links)) for one in found.made["a"]] == [
        (["x.c"], ("X_FOUND",), ["b"]),
        (["y.c"], ("NOT (X_FOUND)",), ["b"]),
    ]


def test_scripts_of_python_packages():
    found = collected("ament_python_install_package(p SCRIPTS_DESTINATION lib/p)\ncatkin_python_setup()")
    assert (found.script_folder, found.python_setup) == ("lib/p", True)


def test_a_name_is_made_once():
    found = collected("while(1)\nadd_library(a x.c)\nendwhile()")
    assert len(found.made["a"]) == 1


def test_sources_for_those_that_link_are_no_sources_of_the_library():
    found = collected("add_library(a x.cpp)\ntarget_sources(a PRIVATE y.cpp INTERFACE i.cpp PUBLIC p.cpp)")
    (made,) = found.made["a"]
    assert texts(made.sources) == ["x.cpp", "y.cpp", "p.cpp"]
    assert texts(made.given) == ["i.cpp", "p.cpp"]


def test_names_of_files_are_those_of_the_kind():
    rename = "PROPERTIES RUNTIME_OUTPUT_NAME r LIBRARY_OUTPUT_NAME l ARCHIVE_OUTPUT_NAME a OUTPUT_NAME o)"
    found = collected(
        "add_executable(e x.cpp)\nadd_library(s STATIC x.cpp)\nadd_library(d SHARED x.cpp)\n"
        f"set_target_properties(e s d {rename}"
    )
    assert [found.made[name][0].output for name in "esd"] == ["r", "a", "l"]


def test_folders_of_types():
    found = collected("install(FILES a TYPE SYSCONF)\ninstall(FILES b TYPE DATA)\ninstall(PROGRAMS c TYPE SBIN)")
    assert [one.destination for one in found.installed] == ["etc", "share", "sbin"]
