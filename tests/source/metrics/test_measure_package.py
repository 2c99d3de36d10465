from __future__ import annotations

import msgspec
import pytest

from roslens.model.entity import Entity, EntityKind
from roslens.model.source import Language, Role, SourceFile
from roslens.source.metrics.measure_file import measure_file
from roslens.source.metrics.measure_package import measure_package
from roslens.source.metrics.table import QUANTITIES
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import ClassFacts, FileFacts, Halstead, Lines

COUNTING = CountingSettings()


def facts_of(code: int = 10, **more: object) -> FileFacts:
    return FileFacts("cpp", Lines(code + 5, code, 3, 2), Halstead(6, 4, 6, 8), **more)


@pytest.fixture
def measure(package_of):
    def measure(*files, counting=COUNTING):
        measured = []
        for path, facts, *role in files:
            source = SourceFile(path, Language.CPP, *role)
            measured.append((source, facts, measure_file(path, facts, counting)))
        return measure_package(package_of("pkg:"), measured, counting)

    return measure


def by_id(entities):
    assert len({entity.id for entity in entities}) == len(entities)
    return {entity.id: entity for entity in entities}


ARM = ClassFacts("Arm", "Arm", "class", 2, 1, 9)


def test_the_order_is_package_then_file_classes_functions(measure, function_of):
    entities = measure(
        ("a.hpp", facts_of(classes=(ARM, ARM))), ("a.cpp", facts_of(functions=(function_of(class_name="Arm"),)))
    )
    assert [entity.id for entity in entities] == [
        "package:pkg",
        "file:a.hpp",
        "class:a.hpp#Arm",
        "class:a.hpp#Arm~2",
        "file:a.cpp",
        "function:a.cpp#f()",
    ]


def test_everything_has_its_parent(measure, function_of):
    member, free = function_of(class_name="Arm"), function_of(name="g", qualified_name="g")
    entities = by_id(measure(("a.hpp", facts_of(classes=(ARM,))), ("a.cpp", facts_of(functions=(member, free)))))
    assert {key: entity.parent for key, entity in entities.items()} == {
        "package:pkg": "",
        "file:a.hpp": "package:pkg",
        "class:a.hpp#Arm": "file:a.hpp",
        "file:a.cpp": "package:pkg",
        "function:a.cpp#f()": "class:a.hpp#Arm",
        "function:a.cpp#g()": "file:a.cpp",
    }


def test_every_quantity_of_classes_is_measured_and_goes_up(measure, function_of):
    entities = by_id(measure(("a.hpp", facts_of(classes=(ARM,), functions=(function_of("if", class_name="Arm"),)))))
    of_class = entities["class:a.hpp#Arm"].values
    assert of_class.keys() == {key for key, one in QUANTITIES.items() if one.kinds == (EntityKind.CLASS,)}
    assert of_class["wmc"] == entities["file:a.hpp"].values["wmc"] == entities["package:pkg"].values["wmc.max"] == 2


def test_the_package_has_the_values_of_its_own_code_alone(measure, function_of):
    own = facts_of(10, functions=(function_of("if"),))
    other = facts_of(1000, functions=(function_of("if\nif\nif"),), classes=(ARM,))
    files = [("a.cpp", own)]
    files += [(f"{role.value}/b.cpp", other, role) for role in (Role.TEST, Role.GENERATED, Role.VENDORED)]
    entities = by_id(measure(*files))
    package = entities["package:pkg"].values
    assert (package["files"], package["loc"], package["functions"], package["classes"]) == (1, 10, 1, 0)
    assert package["cyclomatic_complexity"] == 2
    assert "cbo" not in package
    assert entities["file:test/b.cpp"].values["cyclomatic_complexity"] == 4
    assert entities["file:test/b.cpp"].values["cbo"] == 0


@pytest.mark.parametrize("files", [[], [("test/a.cpp", facts_of(), Role.TEST)]])
def test_without_own_code_there_are_counts_of_none(measure, files):
    assert measure(*files)[0].values == {"files": 0, "classes": 0, "functions": 0, "loc": 0}


def test_values_of_a_package_follow_from_sums_not_from_means(measure):
    package = measure(("a.cpp", facts_of(10)), ("b.cpp", facts_of(50)))[0].values
    assert package["comment_ratio"] == 100 * 6 / 60
    assert package["loc.max"] == 50
    assert 0 < package["maintainability_index"] < 100


def test_duplicates_are_looked_for_in_the_whole_package(measure):
    hashed = {"line_hashes": (1, 2, 3, 4), "line_numbers": (1, 2, 3, 4)}
    files = [
        ("a.cpp", facts_of(4, **hashed)),
        ("b.cpp", facts_of(8, **hashed)),
        ("c.cpp", facts_of(4, **hashed), Role.TEST),
    ]
    entities = by_id(measure(*files, counting=CountingSettings(duplicate_lines=4)))
    assert entities["file:a.cpp"].values["duplication_ratio"] == 100
    assert entities["file:b.cpp"].values["duplicated_lines"] == 4
    assert entities["file:c.cpp"].values["duplicated_lines"] == 0
    assert entities["package:pkg"].values["duplicated_lines"] == 8
    assert entities["package:pkg"].values["duplication_ratio"] == 100 * 8 / 12


def test_a_class_is_as_approximate_as_its_members(measure, function_of):
    member = function_of(class_name="Arm", approximate=True)
    entities = by_id(measure(("a.hpp", facts_of(classes=(ARM,))), ("a.cpp", facts_of(functions=(member,)))))
    assert entities["class:a.hpp#Arm"].approximate
    assert not entities["file:a.cpp"].approximate


def test_what_was_measured_of_a_file_is_not_changed(package_of, function_of):
    facts = facts_of(classes=(ARM,), functions=(function_of(class_name="Arm"),))
    of_file = measure_file("a.hpp", facts, COUNTING)
    before = msgspec.json.encode(of_file)
    measure_package(package_of("pkg:"), [(SourceFile("a.hpp", Language.CPP), facts, of_file)], COUNTING)
    assert msgspec.json.encode(of_file) == before


def test_what_is_measured_is_what_is_read_back(measure, function_of):
    measured = measure(("a.hpp", facts_of(classes=(ARM,), functions=(function_of("if", class_name="Arm"),))))
    read_back = msgspec.json.decode(msgspec.json.encode(measured), type=tuple[Entity, ...])
    assert msgspec.json.encode(read_back) == msgspec.json.encode(measured)
