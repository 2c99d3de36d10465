from __future__ import annotations

import pytest

from roslens.model.source import Language, Role, SourceFile
from roslens.source.metrics.class_model.join_classes import join_classes
from roslens.source.syntax.facts import ClassFacts, FieldFacts, FileFacts, Lines, MethodFacts


def class_(qualified_name: str, **facts: object) -> ClassFacts:
    name = qualified_name.replace("::", ".").rpartition(".")[2]
    return ClassFacts(name, qualified_name, "class", 1, 1, 9, **facts)


@pytest.fixture
def joined(function_of):
    """Join files given as (path, classes, names of member functions as ``class method``)."""

    def join(*files, syntax="cpp"):
        made = []
        for path, classes, members in files:
            role = Role.TEST if path.startswith("test/") else Role.OWN
            functions = tuple(
                function_of(name=member.split()[1], class_name=member.split()[0], types=tuple(member.split()[2:]))
                for member in members
            )
            language = Language.CPP if syntax == "cpp" else Language.PYTHON
            facts = FileFacts(syntax, Lines(), functions=functions, classes=tuple(classes))
            made.append((SourceFile(path, language, role), facts))
        return join_classes(made)

    return join


def names(joined, place):
    return [body.name for body in joined.classes[place].bodies]


def test_members_join_their_class_across_files(joined):
    result = joined(("a.hpp", [class_("n::A")], ["n::A inline"]), ("a.cpp", [], ["n::A far", "nobody::B lost"]))
    assert names(result, (0, 0)) == ["inline", "far"]
    assert result.owners == {(0, 0): (0, 0), (1, 0): (0, 0)}


def test_a_class_named_without_its_namespace_is_found(joined):
    result = joined(("a.cpp", [], ["A far"]), ("a.hpp", [class_("n::A")], []))
    assert result.owners == {(0, 0): (1, 0)}


def test_of_two_classes_with_one_name_the_file_means_its_own(joined):
    result = joined(("a.hpp", [class_("A")], []), ("b.cpp", [class_("A")], ["A mine"]), ("c.cpp", [], ["A far"]))
    assert result.owners == {(1, 0): (1, 0), (2, 0): (0, 0)}


def test_a_test_means_the_class_of_tests_before_the_one_of_its_package(joined):
    result = joined(("a.hpp", [class_("A")], []), ("test/a.hpp", [class_("A")], []), ("test/a.cpp", [], ["A far"]))
    assert result.owners == {(2, 0): (1, 0)}


def test_what_a_class_uses_comes_from_everywhere(joined):
    user = class_(
        "n::User",
        bases=("Base",),
        types=("Typed", "User"),
        fields=(FieldFacts("f", ("Field",)),),
        methods=(MethodFacts("m", "()", types=("Signature",)),),
    )
    result = joined(("a.hpp", [user], []), ("a.cpp", [], ["n::User m n::Body"]))
    assert result.classes[0, 0].suppliers == {"Base", "Typed", "Field", "Signature", "n::Body"}


def test_clients_and_children_are_found_across_files(joined):
    result = joined(
        ("a.hpp", [class_("n::A")], []),
        ("b.hpp", [class_("n::B", bases=("A",)), class_("m::C", types=("n::A",))], []),
    )
    assert result.classes[0, 0].clients == {"n::B", "m::C"}
    assert result.classes[0, 0].children == {"n::B"}
    assert result.classes[1, 0].depth == 1


def test_tests_do_not_change_what_they_test(joined):
    result = joined(
        ("a.hpp", [class_("A", types=("test::Mock",))], []),
        ("test/b.hpp", [class_("test::Mock", bases=("A",)), class_("test::Deep", bases=("Mock",))], []),
    )
    assert result.classes[0, 0].clients == result.classes[0, 0].children == frozenset()
    assert result.classes[1, 0].clients == {"A", "test::Deep"}
    assert result.classes[1, 0].children == {"test::Deep"}
    assert result.classes[1, 1].depth == 2


def test_modules_keep_classes_of_python_apart(joined):
    result = joined(
        ("pkg/a.py", [class_("A"), class_("B", bases=("A", "object"))], ["A move"]),
        ("pkg/b.py", [class_("A"), class_("C", bases=("a.A",)), class_("D", bases=("object",))], ["A move"]),
        ("pkg/__init__.py", [class_("E")], ["E move"]),
        syntax="python",
    )
    assert result.owners == {(0, 0): (0, 0), (1, 0): (1, 0), (2, 0): (2, 0)}
    assert result.classes[0, 0].children == {"pkg.a.B", "pkg.b.C"}
    assert result.classes[1, 0].children == frozenset()
    assert (result.classes[1, 1].depth, result.classes[1, 2].depth) == (1, 0)


def test_languages_do_not_mix(joined, function_of):
    cpp = FileFacts("cpp", Lines(), classes=(class_("A"),))
    python = FileFacts("python", Lines(), classes=(class_("B", bases=("A",)),))
    result = join_classes([(SourceFile("a.cpp", Language.CPP), cpp), (SourceFile("b.py", Language.PYTHON), python)])
    assert result.classes[0, 0].children == frozenset()
    assert result.classes[1, 0].suppliers == {"A"}
