"""Classes and functions of cccc found among our entities."""

from __future__ import annotations

from roslens.model.entity import Entity, EntityKind
from roslens.source.tools.cccc_match import matched_values
from roslens.source.tools.cccc_report import CcccFile, CcccFunction, CcccModule
from roslens.source.tools.paper2016 import StudiedFile

CC = "paper2016.cyclomatic_complexity"
CBO = "paper2016.cbo"


def klass(path: str, name: str, line: int = 1) -> Entity:
    return Entity(f"class:{path}#{name}", EntityKind.CLASS, name, path, line, line + 20)


def function(path: str, name: str, line: int, end_line: int) -> Entity:
    return Entity(f"function:{path}#{name}()@{line}", EntityKind.FUNCTION, name, path, line, end_line)


def module(name: str, cbo: int, line: int = 0) -> CcccModule:
    return CcccModule(name, line, cbo=cbo, noc=0, wmc=0, dit=0, mac=0)


def seen(path: str, *parts: CcccModule | CcccFunction) -> StudiedFile:
    modules = tuple(part for part in parts if isinstance(part, CcccModule))
    functions = tuple(part for part in parts if isinstance(part, CcccFunction))
    return StudiedFile(path, CcccFile(10, 0, modules, functions), 0.0)


def test_a_class_is_found_by_its_last_name_in_its_file():
    entities = [klass("a.h", "ns::Foo"), klass("b.h", "other::Foo")]
    assert matched_values(entities, [seen("b.h", module("Foo", 3))]) == {"class:b.h#other::Foo": {CBO: 3.0}}


def test_a_class_defined_elsewhere_has_the_largest_value_of_all_files():
    files = [seen("a.cpp", module("Foo", 7)), seen("a.h", module("Foo", 2, 1)), seen("b.cpp", module("Foo", 4))]
    assert matched_values([klass("a.h", "ns::Foo")], files) == {"class:a.h#ns::Foo": {CBO: 7.0}}


def test_a_class_that_could_be_two_and_one_that_is_none_of_ours_are_left_out():
    entities = [klass("a.h", "x::Foo"), klass("b.h", "y::Foo")]
    assert matched_values(entities, [seen("c.cpp", module("Foo", 7), module("vector", 9))]) == {}


def test_two_classes_of_a_name_in_a_file_are_told_apart_by_their_lines():
    entities = [klass("a.h", "x::Foo", 3), klass("a.h", "y::Foo", 40)]
    assert matched_values(entities, [seen("a.h", module("Foo", 7, 41))]) == {"class:a.h#y::Foo": {CBO: 7.0}}


def test_functions_are_found_by_name_and_line():
    entities = [
        function("a.cpp", "ns::Foo::run", 10, 20),
        function("a.cpp", "ns::Foo::run", 30, 40),
        function("b.cpp", "ns::Foo::run", 10, 20),
        function("a.cpp", "run_all", 10, 20),
    ]
    report = seen(
        "a.cpp",
        CcccFunction("Foo", "run(int)", 11, 5),
        CcccFunction("Foo", "run(double)", 29, 6),
        CcccFunction("Foo", "walk()", 12, 7),
        CcccFunction("Foo", "run()", 90, 8),
        CcccFunction("Foo", "run(char)", 12, 0),
    )
    assert matched_values(entities, [report]) == {
        "function:a.cpp#ns::Foo::run()@10": {CC: 5.0},
        "function:a.cpp#ns::Foo::run()@30": {CC: 6.0},
    }


def test_a_class_without_any_value_is_left_out():
    assert matched_values([klass("a.h", "Foo")], [seen("a.h", module("Foo", 0))]) == {}
