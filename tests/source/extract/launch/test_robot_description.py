import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.launch.robot_description import read_description
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.text import Text

HEAD = '<robot xmlns:xacro="http://ros.org/wiki/xacro">'


class Written:
    """Files that are written in the test."""

    def __init__(self, **files):
        self.files = {f"{name}.xacro": text for name, text in files.items()}

    def package(self, name):
        return "robot" if name == "robot" else None

    def content(self, path):
        text = self.files.get(path)
        return None if text is None else (HEAD + text + "</robot>").encode()


def read(text, given=None, **others):
    found, missing = read_description("top.xacro", Written(top=text, **others), given)
    assert found is not None
    return found, missing


def topics(text, given=None, **others):
    found, _missing = read(text, given, **others)
    return [str(path[-1].text) for path in found.walk() if path[-1].tag == "topic"]


def test_properties_and_expressions():
    assert topics('<xacro:property name="n" value="2"/><topic>scan${n * 2 + 1}</topic>') == ["scan5"]
    assert topics(
        '<xacro:property name="a" value="x"/><xacro:property name="b" value="${a}y"/><topic>${b}</topic>'
    ) == ["xy"]


def test_arguments_hold_over_their_defaults():
    text = '<xacro:arg name="ns" default="left"/><topic>$(arg ns)/image</topic>'
    assert topics(text) == ["left/image"]
    assert topics(text, {"ns": Text.of("right")}) == ["right/image"]


def test_macros_with_defaults_and_blocks():
    text = (
        '<xacro:macro name="laser" params="name topic:=scan *origin **extra"><topic>${name}/${topic}</topic>'
        '<xacro:insert_block name="origin"/><xacro:insert_block name="extra"/></xacro:macro>'
        '<xacro:laser name="front"><topic>origin</topic><all><topic>one</topic><topic>two</topic></all></xacro:laser>'
        '<xacro:laser name="rear" topic="cloud"><a/><b/></xacro:laser>'
    )
    assert topics(text) == ["front/scan", "origin", "one", "two", "rear/cloud"]


def test_old_files_leave_the_prefix_out():
    text = '<property name="n" value="1"/><macro name="m" params="x"><topic>${x}${n}</topic></macro><m x="a"/>'
    assert topics(text) == ["a1"]


@pytest.mark.parametrize(
    ("value", "there"), [("true", True), ("1", True), ("${1 == 2}", False), ("False", False), ("0", False)]
)
def test_conditions(value, there):
    text = f'<xacro:if value="{value}"><topic>if</topic></xacro:if>'
    text += f'<xacro:unless value="{value}"><topic>not</topic></xacro:unless>'
    assert topics(text) == (["if"] if there else ["not"])


def test_a_condition_that_is_unknown_is_kept():
    found, _ = read('<xacro:if value="$(optenv LASER false)"><topic>scan</topic></xacro:if>')
    (path,) = [path for path in found.walk() if path[-1].tag == "topic"]
    assert as_written(path[-1].conditions) == ("$(optenv LASER false)",)


def test_what_is_included_is_part_of_it_and_tells_where_it_stands():
    found, missing = read('<xacro:include filename="laser.xacro"/>', laser="<topic>scan</topic>")
    (path,) = [path for path in found.walk() if path[-1].tag == "topic"]
    assert (path[-1].evidence.path, path[-1].evidence.line) == ("laser.xacro", 1)
    assert not missing


def test_what_is_missing_is_told():
    _found, missing = read(
        '<xacro:include filename="$(find other)/a.xacro"/><xacro:include filename="b.xacro"/><xacro:arm/>'
    )
    assert [one.reason for one in missing] == [
        "the file that is included is unknown",
        "there is no such file in the workspace",
        "no such macro is known in the workspace",
    ]
    assert read_description("none.xacro", Written())[1][0].reason == "there is no such description in the workspace"


def test_files_and_macros_that_hold_themselves_end():
    assert topics('<xacro:include filename="top.xacro"/><topic>a</topic>')[-1] == "a"
    assert topics('<xacro:macro name="m" params=""><xacro:m/><xacro:m/></xacro:macro><xacro:m/><topic>a</topic>') == []


@given(st.text(alphabet='<>/"$ {}()=abxacro:if*', max_size=80))
def test_nothing_breaks_it(text):
    read_description("top.xacro", Written(top=text))
