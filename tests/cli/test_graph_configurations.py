from pathlib import Path

import msgspec
import pytest

from roslens.cli.graph.graph_configurations import (
    Assembled,
    Named,
    assembled,
    largest,
    most_telling,
    named_configurations,
)
from roslens.cli.graph.graph_source import GraphSource
from roslens.source.settings import DeclaredConfiguration, GraphSettings, SourceSettings


def opened(root: Path, settings: SourceSettings | None = None) -> GraphSource:
    return GraphSource(str(root), settings or SourceSettings(), "roslens.toml", {})


def declared(**configurations: DeclaredConfiguration) -> SourceSettings:
    return SourceSettings(graph=GraphSettings(configurations=configurations))


def test_without_a_declaration_it_is_what_no_other_launch_file_includes(talking):
    with opened(talking) as source:
        (only,) = named_configurations(source)
    # The one in test/ includes fleet.launch.xml too, but nobody starts a robot with it.
    assert (only.name, Path(only.launch).name) == ("fleet.launch.xml", "fleet.launch.xml")


def test_launch_files_of_one_name_are_told_apart_by_their_path(talking):
    twin = talking / "walk" / "launch" / "fleet.launch.xml"
    twin.parent.mkdir(parents=True)
    (talking / "walk" / "package.xml").write_text((talking / "talk/package.xml").read_text().replace("talk", "walk"))
    twin.write_text('<launch><node pkg="a" exec="b"/></launch>')
    with opened(talking) as source:
        names = [one.name for one in named_configurations(source)]
    assert names == ["talk/launch/fleet.launch.xml", "walk/launch/fleet.launch.xml"]


def test_what_is_declared_is_taken_in_its_order_with_arguments_as_text(talking):
    settings = declared(
        quiet=DeclaredConfiguration("talk/robot.launch.xml", {"listening": False, "depth": 3}),
        all=DeclaredConfiguration("talk/fleet.launch.xml"),
    )
    with opened(talking, settings) as source:
        named = named_configurations(source)
        made = assembled(source, named)
    assert [one.name for one in named] == ["quiet", "all"]
    assert named[0].arguments == {"listening": "false", "depth": "3"}
    assert [len(one.nodes) for one in made.configurations.values()] == [1, 3]
    assert {one.rule for one in made.findings["all"]} == {"graph.qos"}
    assert "graph.qos" not in {one.rule for one in made.findings["quiet"]}


def test_the_largest_keep_their_order(talking):
    with opened(talking) as source:
        named = [
            Named("empty", "talk/robot.launch.xml", {"listening": "false"}),
            Named("all", "talk/fleet.launch.xml"),
            Named("robot", "talk/robot.launch.xml"),
        ]
        assert [one.name for one in largest(source, named, 2)] == ["all", "robot"]


def test_what_starts_almost_the_same_as_another_comes_after_what_differs():
    started = {"a": ("x", "y", "z"), "b": ("x", "y", "z", "b"), "c": ("u", "v"), "d": ("w",), "empty": ()}
    assert most_telling(started, 2) == {"b", "c"}
    assert most_telling(started, 3) == {"b", "c", "d"}
    assert most_telling(started, 4) == {"b", "c", "d", "a"}
    assert most_telling(started, 9) == set(started)


def test_one_that_cannot_be_assembled_is_a_failure_and_the_others_stay(talking, monkeypatch):
    (talking / "talk/launch/empty.launch.xml").write_text("<launch/>")
    named = [Named(name, f"talk/{name}.launch.xml") for name in ("lost", "empty", "robot", "fleet")]
    with opened(talking) as source:
        whole = source.launched

        def launched(launch, arguments):
            if "fleet" in launch:
                raise KeyError("a bug")
            return whole(launch, arguments)

        monkeypatch.setattr(source, "launched", launched)
        made = assembled(source, named)
    assert list(made.configurations) == ["empty", "robot"]
    lost, empty, broken = made.failures
    assert 'configuration "lost": no launch file "talk/lost.launch.xml"' in str(lost)
    assert 'configuration "empty" starts no node' in str(empty)
    assert "KeyError" in str(broken)
    assert "Traceback" in broken.detail


def test_what_several_have_in_common_is_one_finding(talking):
    named = [Named(name, f"talk/{name}.launch.xml") for name in ("robot", "fleet")]
    with opened(talking) as source:
        made = assembled(source, named)
    assert len(made.findings["robot"]) == len(made.findings["fleet"]) == 1
    assert made.all_findings() == made.findings["robot"]
    found = made.findings["robot"][0]
    nearer = msgspec.structs.replace(found, message=f"{found.message} Is it /talk?")
    assert Assembled({}, {"robot": (found,), "fleet": (nearer,)}).all_findings() == (found,)


@pytest.mark.parametrize("value", [{"launch": "a", "argument": {}}, {"arguments": {}}])
def test_a_declaration_says_nothing_else(value):
    with pytest.raises(msgspec.ValidationError):
        msgspec.convert(value, DeclaredConfiguration)
