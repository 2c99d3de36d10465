from roslens.source.extract.configuration.assemble_units import KnownUnits, as_script, meant_by
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.facts.node_facts import Evidence, NodeFacts, Target, TargetKind
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.text import Text, unknown

HERE = Evidence("pkg/CMakeLists.txt", 3)


def target(kind: TargetKind, name: str, sources=(), **others) -> Target:
    return Target(kind, "pkg", name, sources, HERE, **others)


def meant(
    targets, facts, executable: Text | str = "", plugin: str = "", package: Text | str = "pkg", kind: str = "node"
):
    texts = [one if isinstance(one, Text) else Text.of(one) for one in (package, executable)]
    return meant_by(Launched(*texts, HERE, plugin=Text.of(plugin), kind=kind), KnownUnits({"pkg": targets}, facts))


MAIN = NodeFacts("main", "pkg/a.cpp", 9, "ros2")
CLASS = NodeFacts("ns.Part", "pkg/part.cpp", 4, "ros2", "component")


def test_an_executable_is_the_main_function_of_one_of_its_sources():
    found = meant([target(TargetKind.EXECUTABLE, "a", ("pkg/b.cpp", "pkg/a.cpp"))], [MAIN], "a")
    assert found.facts == (MAIN,)


def test_an_executable_may_be_made_for_a_class():
    found = meant([target(TargetKind.EXECUTABLE, "a", ("pkg/part.cpp",), entry="ns::Part")], [CLASS], "a")
    assert found.facts == (CLASS,)


def test_a_component_is_found_by_its_class_even_if_no_build_registers_it():
    registered = [target(TargetKind.COMPONENT, "ns::Part", entry="ns::Part")]
    assert meant(registered, [CLASS], plugin="ns::Part", kind="component").facts == (CLASS,)
    assert meant([], [CLASS], plugin="ns::Part", kind="component").facts == (CLASS,)


def test_a_script_may_be_in_a_folder_and_an_installed_target_is_preferred():
    script = NodeFacts("<module>", "pkg/scripts/a.py", 1, "ros1")
    targets = [
        target(TargetKind.EXECUTABLE, "a.py", ("pkg/a.cpp",), installed=False),
        target(TargetKind.SCRIPT, "scripts/a.py", ("pkg/scripts/a.py",)),
    ]
    assert meant(targets, [MAIN, script], "a.py").facts == (script,)


def test_conditions_of_the_build_are_kept():
    found = meant([target(TargetKind.EXECUTABLE, "a", ("pkg/a.cpp",), conditions=("WITH_A",))], [MAIN], "a")
    assert as_written(found.conditions) == ("WITH_A",)


def test_what_is_not_found_has_a_reason():
    assert "no build of package pkg creates b" in meant([], [], "b").reason
    assert "not in the workspace" in meant([], [], "b", package="other").reason
    assert "registers no ns::Part" in meant([], [], plugin="ns::Part", kind="component").reason
    assert "the executable is unknown" in meant([], [], unknown("argument x")).reason
    assert "the package is unknown" in meant([], [], "b", package=unknown("argument x")).reason
    assert "no node was found" in meant([target(TargetKind.EXECUTABLE, "a", ("pkg/a.cpp",))], [], "a").reason


def test_a_program_is_evaluated_with_the_words_of_its_command_line():
    asked = []

    class Asked(KnownUnits):
        def program(self, path, function="", words=None, chosen=None):
            asked.append((path, words))
            return super().program(path, function, words)

    words = (Text.of("a"), Text.of("scan"))
    units = Asked({"pkg": [target(TargetKind.EXECUTABLE, "a", ("pkg/a.cpp",))]}, [MAIN])
    assert meant_by(Launched(Text.of("pkg"), Text.of("a"), HERE), units, words).facts == (MAIN,)
    assert asked == [("pkg/a.cpp", words)]


def script(path: str) -> NodeFacts:
    return NodeFacts("<module>", path, 1, "ros1")


def test_a_script_that_nobody_installs_is_found_where_it_lies():
    one = script("pkg/src/deep/a.py")
    units = KnownUnits({"pkg": ()}, [one, script("pkg/scripts/other.py"), script("far/a.py")])
    found = as_script(Launched(Text.of("pkg"), Text.of("a.py"), HERE), units)
    assert found is not None
    assert found.facts == (one,)


def test_of_several_scripts_of_one_name_none_is_started():
    units = KnownUnits({"pkg": ()}, [script("pkg/b/a.py"), script("pkg/c/a.py")])
    assert as_script(Launched(Text.of("pkg"), Text.of("a.py"), HERE), units) is None
    assert as_script(Launched(Text.of("other"), Text.of("a.py"), HERE), units) is None
    assert as_script(Launched(Text.of("pkg"), unknown("argument x"), HERE), units) is None
