"""The picture as one SVG."""

from __future__ import annotations

import re
from types import ModuleType
from xml.etree import ElementTree as ET

import msgspec
import pytest

from roslens.dashboard.computation.to_svg import palettes, to_svg
from roslens.model.configuration import Configuration, ConfiguredNode, Proof
from roslens.model.finding import Finding, Severity

SVG = "{http://www.w3.org/2000/svg}"


def parsed(text: str) -> ET.Element:
    return ET.fromstring(text)


def titles(root: ET.Element) -> list[str]:
    return [one.text or "" for one in root.findall(f".//{SVG}g/{SVG}title")]


@pytest.fixture
def robot(made_up: ModuleType) -> Configuration:
    found: Configuration = made_up.robot()
    return found


def test_nodes_topics_services_and_actions_are_there_and_noise_is_not(robot: Configuration) -> None:
    told = "\n".join(titles(parsed(to_svg(robot))))
    for line in ("topic /scan", "node /navigation/planner"):
        assert line in told
    assert "/rosout" not in told
    assert "/rosout" in "\n".join(titles(parsed(to_svg(robot, everything=True))))


def test_conditions_and_doubt_show(robot: Configuration) -> None:
    text = to_svg(robot)
    assert re.search(r'<path class="wire [^"]*conditional', text)
    assert re.search(r'<path class="wire [^"]*unresolved', text)
    assert "name not resolved" in text


def test_the_worst_finding_marks_an_element(robot: Configuration) -> None:
    finding = Finding("graph.qos", Severity.ERROR, "m", entity="topic:/scan")
    marks = [one for one in parsed(to_svg(robot, [finding])).iter(f"{SVG}text") if one.get("class") == "mark error"]
    assert [one.text for one in marks] == ["\N{HEAVY MULTIPLICATION X}"]


def test_the_same_bytes_each_time(robot: Configuration) -> None:
    assert to_svg(robot) == to_svg(robot)


def test_nothing_of_a_name_becomes_markup() -> None:
    name = "/a<script>&\"'\x00\x1b"
    found = Configuration(name, "ros2", (ConfiguredNode(name, Proof("a.py", 1)),))
    root = parsed(to_svg(found))
    assert {one.tag.removeprefix(SVG) for one in root.iter()} <= {
        "svg", "title", "style", "rect", "circle", "g", "path", "text", "tspan",
    }  # fmt: skip
    assert any("<script>" in title for title in titles(root))


def test_a_picture_holds_everything_that_stands_in_it(robot: Configuration) -> None:
    root = parsed(to_svg(robot))
    width, height = (float(root.get(side, "0")) for side in ("width", "height"))
    for one in root.findall(f"{SVG}g"):
        if match := re.match(r"translate\(([\d.]+) ([\d.]+)\)", one.get("transform", "")):
            assert 0 < float(match[1]) < width
            assert 0 < float(match[2]) < height


def test_many_elements_are_drawn_as_nodes_joined_by_lines(made_up: ModuleType) -> None:
    root = parsed(to_svg(made_up.large()))
    assert {one.split(" ")[0] for one in titles(root)} == {"node"}
    lines = [one.text for path in root.iter(f"{SVG}path") for one in path.findall(f"{SVG}title")]
    assert lines
    assert all(lines)


def test_without_any_node_there_is_still_a_picture() -> None:
    assert "no nodes" in to_svg(Configuration("nothing", "ros2"))


def test_colours_are_those_of_the_pages_in_light_and_dark(robot: Configuration) -> None:
    light, dark = palettes()
    assert light["ground"] != dark["ground"]
    assert light.keys() == dark.keys()
    text = to_svg(msgspec.structs.replace(robot, title="t"))
    before, after = text.split("@media (prefers-color-scheme:dark)")
    assert f".paper{{fill:{light['ground']}}}" in before
    assert f".paper{{fill:{dark['ground']}}}" in after


def test_doubt_is_a_sign_of_its_own_shape_beside_the_name() -> None:
    nodes = tuple(ConfiguredNode(f"/{sure}", Proof("a.py", 1, sure=sure)) for sure in ("certain", "likely", "possible"))
    picture = to_svg(Configuration("a", "ros2", nodes))
    # Each once on its node and once in the legend.
    assert (picture.count('class="half"'), picture.count('class="asked"')) == (2, 2)
    assert "likely ~" not in picture
