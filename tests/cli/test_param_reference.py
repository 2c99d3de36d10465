import argparse
from pathlib import Path

import pytest

from roslens.cli.main import main
from roslens.cli.watch.param_reference import reference_argument, reference_sources
from roslens.live.observe import parameter_source
from roslens.model.errors import UsageError

DOCUMENT = "kind: reference\nname: rover\nconstraints: []\n"


def options(**given):
    asked = {"bag": None, "ros1": False, "ros2": False, "master": None, "domain": None, "python": None, **given}
    return argparse.Namespace(**asked)


@pytest.fixture
def systems(monkeypatch):
    monkeypatch.delenv("ROS_MASTER_URI", raising=False)
    values = {}

    def ros1(name, master):
        if "ros1" not in values:
            raise UsageError("no ROS master", advice="Start roscore")
        return values["ros1"], "ROS 1"

    def ros2(name, python, domain, environment):
        if "ros2" not in values:
            raise UsageError("no node answers", advice="Start it")
        return values["ros2"], "ROS 2"

    monkeypatch.setattr(parameter_source, "ros1_parameter", ros1)
    monkeypatch.setattr(parameter_source, "ros2_parameter", ros2)
    return values


def test_files_stay_and_parameters_become_documents(systems):
    systems["ros2"] = {"ref.b": DOCUMENT, "ref.a": [DOCUMENT, DOCUMENT]}
    given = [reference_argument("a.yaml"), reference_argument("param:/n/ref")]
    first, *documents = reference_sources(given, options(ros2=True))
    assert first == Path("a.yaml")
    assert [one.shown for one in documents] == [
        "parameter ref.a[0] of ROS 2",
        "parameter ref.a[1] of ROS 2",
        "parameter ref.b of ROS 2",
    ]


def test_both_generations_are_looked_through_where_none_is_asked_for(systems, monkeypatch):
    systems["ros1"] = DOCUMENT
    monkeypatch.setenv("ROS_MASTER_URI", "http://robot:11311")
    (one,) = reference_sources(["param:/n/ref"], options())
    assert one.shown == "parameter /n/ref of ROS 1"
    systems["ros2"] = {"ref": DOCUMENT}
    assert len(reference_sources(["param:/n/ref"], options())) == 2


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"ros1": True}, "param:/n/ref: no ROS master.*Start roscore"),
        ({"ros2": True}, "param:/n/ref: no node answers.*Start it"),
        ({"master": "http://robot:11311"}, "no ROS master; no node answers"),
        ({"bag": ["x.bag"]}, "A bag has no parameters"),
    ],
)
def test_what_is_missing_is_said(systems, given, said):
    with pytest.raises(UsageError, match=said):
        reference_sources(["param:/n/ref"], options(**given))


def test_a_relative_name_is_refused(capsys):
    assert main(["watch", "--ros1", "--reference", "param:ref"]) == 2
    assert "param:/ref" in capsys.readouterr().err
