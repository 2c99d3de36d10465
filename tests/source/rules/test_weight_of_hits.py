"""How grave a finding on a package is follows from what is known of the package."""

import pytest

from roslens.model.finding import Severity
from roslens.model.weight.consequence import Consequence
from roslens.source.rules.package_findings import rule_findings
from roslens.source.settings import RuleSettings

NOTE, WARNING = Severity.NOTE, Severity.WARNING
MANIFEST = (
    "<package format='3'><name>{}</name><version>{}</version><description>Moves an arm.</description>"
    "<maintainer email='{}'>Ada</maintainer><license>{}</license>{}"
    "<export><build_type>{}</build_type></export></package>"
)
SETUP = 'from setuptools import setup\nsetup(name="arm", version="{}")\n'
FLAGS = "project(arm)\nadd_compile_options(-std=c++{})\nadd_executable(a a.cpp)\n"
GENERATES = 'project(arm)\nrosidl_generate_interfaces(arm "msg/State.msg")\n'
IMPORTS = "from arm.msg import State, BoardState\n"
INCLUDES = "#include <arm/msg/board_state.hpp>\n"
MENTIONS = "# The BoardState of other games.\nfrom arm.msg import State\n"
MAKES = (
    "project(arm)\nfind_package(catkin REQUIRED COMPONENTS {})\n"
    "add_message_files(FILES State.msg)\ngenerate_messages()\n"
)
SPLITS = (
    "<launch><arg name='model' default='{}'/>"
    "<arg name='name' default=\"$(eval arg('model').split('_')[1])\"/>"
    "<param name='a' value='$(arg name)'/></launch>"
)
TO_MAKE = "<build_depend>message_generation</build_depend>"


def write(
    folder, name="arm", kind="ament_cmake", version="1.2.0", email="ada@arm.dev", licence="BSD", asks="", **files
):
    (folder / name).mkdir()
    manifest = MANIFEST.format(name, version, email, licence, asks, kind)
    for path, text in {"package__xml": manifest, **files}.items():
        *folders, stem, ending = path.split("__")
        where = folder / name / "/".join(folders) / f"{stem}.{ending}"
        where.parent.mkdir(parents=True, exist_ok=True)
        where.write_text(text)


@pytest.fixture
def weights(tmp_path, package_view):
    def found(rule):
        failures = []
        view = package_view(tmp_path, "arm")
        findings = rule_findings(view, RuleSettings((), (rule,)), {}, (), (), failures)
        assert not failures
        return [(one.severity, one.consequence) for one in findings]

    return found


@pytest.mark.parametrize(
    ("given", "severities"),
    [
        ({"licence": "TODO: License declaration"}, [WARNING]),
        ({"email": "you@todo.todo"}, [NOTE]),
        ({"licence": "TODO", "email": "you@todo.todo"}, [WARNING, NOTE]),
    ],
)
def test_nothing_depends_on_the_address_that_a_template_wrote(given, severities, weights, tmp_path):
    write(tmp_path, **given)
    assert [one for one, _ in weights("package.boilerplate")] == severities


@pytest.mark.parametrize(
    ("manifest", "setup", "severity"), [("1.2.0", "1.1.0", WARNING), ("0.0.1", "0.0.0", NOTE), ("1.2.0", "0.0.0", NOTE)]
)
def test_a_version_that_a_template_wrote_was_never_released(manifest, setup, severity, weights, tmp_path):
    write(tmp_path, kind="ament_python", version=manifest, setup__py=SETUP.format(setup))
    assert [one for one, _ in weights("package.version_disagrees")] == [severity]


@pytest.mark.parametrize(
    ("kind", "standard", "asks", "severity"),
    [
        ("ament_cmake", "14", "", WARNING),
        ("ament_cmake", "17", "", NOTE),
        ("ament_cmake", "2a", "", NOTE),
        ("catkin", "11", "", NOTE),
        ("catkin", "11", "<depend>pcl_ros</depend>", WARNING),
        ("catkin", "14", "<depend>pcl_ros</depend>", NOTE),
    ],
)
def test_a_standard_matters_where_what_the_package_uses_needs_a_newer_one(
    kind, standard, asks, severity, weights, tmp_path
):
    write(tmp_path, kind=kind, asks=asks, CMakeLists__txt=FLAGS.format(standard), a__cpp="int main() {}\n")
    assert [one for one, _ in weights("cmake.language_standard")] == [severity]


@pytest.mark.parametrize(
    ("asks", "severity"),
    [("", NOTE), ("<depend>pcl_conversions</depend>", WARNING), ("<depend>gtsam</depend>", WARNING)],
)
def test_code_of_one_processor_matters_beside_libraries_that_come_built(asks, severity, weights, tmp_path):
    build = "project(arm)\nadd_compile_options(-march=native)\nadd_executable(a a.cpp)\n"
    write(tmp_path, asks=asks, CMakeLists__txt=build, a__cpp="int main() {}\n")
    assert [one for one, _ in weights("cmake.machine_flags")] == [severity]


@pytest.mark.parametrize(("default", "severity"), [("", NOTE), ("arm", WARNING)])
def test_an_expression_may_wait_for_what_an_empty_default_stands_for(default, severity, weights, tmp_path):
    write(tmp_path, kind="catkin", launch__arm__launch=SPLITS.format(default))
    assert [one for one, _ in weights("launch.failing_expression")] == [severity]


@pytest.mark.parametrize(
    ("files", "weight"),
    [
        ({"scripts__board__py": IMPORTS}, (WARNING, Consequence.STOPS_BUILD)),
        ({"src__board__cpp": INCLUDES}, (WARNING, Consequence.STOPS_BUILD)),
        ({"msg__Game__msg": "BoardState[] boards\n"}, (WARNING, Consequence.STOPS_BUILD)),
        ({"scripts__board__py": MENTIONS}, (NOTE, Consequence.HARD_TO_MAINTAIN)),
        ({}, (NOTE, Consequence.HARD_TO_MAINTAIN)),
    ],
)
def test_a_message_that_nothing_uses_stops_no_build(files, weight, weights, tmp_path):
    build = GENERATES.replace('"msg/State.msg"', '"msg/State.msg" "msg/Game.msg"')
    definitions = {"msg__State__msg": "int32 a\n", "msg__BoardState__msg": "int32 b\n"}
    write(tmp_path, CMakeLists__txt=build, **definitions, **files)
    assert weights("cmake.interface_not_generated") == [weight]


@pytest.mark.parametrize(("text", "severity"), [(IMPORTS, WARNING), (MENTIONS, NOTE)])
def test_of_a_package_of_messages_those_that_depend_on_it_are_asked(text, severity, weights, tmp_path):
    definitions = {"msg__State__msg": "int32 a\n", "msg__BoardState__msg": "int32 b\n"}
    write(tmp_path, CMakeLists__txt=GENERATES, **definitions)
    write(tmp_path, "game", asks="<depend>arm</depend>", scripts__board__py=text)
    assert [one for one, _ in weights("cmake.interface_not_generated")] == [severity]


@pytest.mark.parametrize(
    ("components", "asks", "weight"),
    [
        ("message_generation", TO_MAKE, (WARNING, Consequence.HARD_TO_MAINTAIN)),
        ("roscpp", "<exec_depend>message_runtime</exec_depend>", (WARNING, Consequence.STOPS_BUILD)),
        (
            "message_generation",
            "<exec_depend>message_runtime</exec_depend>",
            (WARNING, Consequence.HARD_TO_MAINTAIN),
        ),
    ],
)
def test_a_build_that_finds_its_generator_does_not_stop(components, asks, weight, weights, tmp_path):
    build = MAKES.format(components)
    write(tmp_path, kind="catkin", asks=asks, CMakeLists__txt=build, msg__State__msg="int32 a\n")
    assert weights("package.interface_dependencies") == [weight]
