"""Types of messages and services that reactions name, held against the definitions that are here."""

from __future__ import annotations

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.react.definitions import folders_of, unchecked_types
from roslens.live.window.signals import BY_KEY
from roslens.model.errors import DocumentError


def unchecked(action, folders=()):
    text = f"kind: reference\nname: r\nreactions:\n- id: a\n  when: {{node: /x, is: gone}}\n  do:\n  - {action}\n"
    reactions = load_reference([GivenText("r.yaml", text.encode())], BY_KEY).reactions
    return [(one.type, one.place) for one in unchecked_types(reactions, folders)]


def publish(type_, fields="{}"):
    return f"publish: {{topic: /t, type: {type_}, fields: {fields}}}"


@pytest.mark.parametrize(
    ("type_", "fields"),
    [
        ("std_msgs/Bool", "{data: true}"),
        ("std_msgs/msg/Bool", "{data: true}"),
        ("geometry_msgs/msg/Twist", "{linear: {x: 0.0}, angular: {z: 0.0}}"),
        ("std_msgs/Header", "{seq: 1, frame_id: a, stamp: now}"),
    ],
)
def test_what_exists_is_taken(type_, fields):
    assert unchecked(publish(type_, fields)) == []


@pytest.mark.parametrize(
    ("type_", "fields", "said"),
    [
        ("std_msgs/Boool", "{}", "no message 'std_msgs/Boool'"),
        ("std_msgs/Boool", "{}", "Did you mean 'Bool'?"),
        ("std_msgs/msg/Bool", "{date: true}", "std_msgs/msg/Bool has no field 'date'; expected one of data"),
        ("geometry_msgs/Twist", "{linear: {w: 1}}", "'linear' of geometry_msgs/Twist has no field 'w'"),
    ],
)
def test_what_does_not_is_refused_with_its_place(type_, fields, said):
    with pytest.raises(DocumentError) as error:
        unchecked(publish(type_, fields))
    assert said in str(error.value)
    assert str(error.value).startswith("r.yaml:7:5:")


def test_what_nobody_here_knows_is_told_and_not_refused():
    assert unchecked(publish("my_msgs/msg/Stop")) == [("my_msgs/msg/Stop", "r.yaml:7:5")]
    assert unchecked("call: {service: /s, type: std_srvs/Trigger}") == [("std_srvs/Trigger", "r.yaml:7:5")]


def test_packages_that_are_installed_rule(tmp_path):
    for name in ("msg/Stop.msg", "srv/Trigger.srv"):
        place = tmp_path / "share" / "my_msgs" / name
        place.parent.mkdir(parents=True)
        place.write_text("bool data\n")
    folders = folders_of({"AMENT_PREFIX_PATH": f"/nowhere:{tmp_path}"})
    assert unchecked(publish("my_msgs/msg/Stop"), folders) == []
    assert unchecked("call: {service: /s, type: my_msgs/srv/Trigger}", folders) == []
    with pytest.raises(DocumentError, match="no service 'my_msgs/srv/Triger'"):
        unchecked("call: {service: /s, type: my_msgs/srv/Triger}", folders)
