import pytest

from roslens.model.errors import DocumentError
from roslens.source.extract.parameters.parameter_file import ros1_parameters, ros2_parameters

ROS2 = b"""\
/**:
  ros__parameters:
    use_sim_time: true
lidar:
  ros__parameters:
    filter: {window: 5, weights: [0.5, 1.0]}
    name: "7"
/front:
  camera:
    ros__parameters:
      rate: 1e1
"""


def told(settings):
    return [(one.node, str(one.name), str(one.value), one.type, one.evidence.line) for one in settings]


def test_files_of_ros2_are_keyed_to_nodes():
    assert told(ros2_parameters(ROS2, "a.yaml")) == [
        ("/**", "use_sim_time", "true", "bool", 3),
        ("/lidar", "filter.window", "5", "int", 6),
        ("/lidar", "filter.weights", "[0.5, 1.0]", "double_array", 6),
        ("/lidar", "name", "7", "string", 7),
        ("/front/camera", "rate", "1e1", "double", 11),
    ]


def test_what_ros2_refuses_is_an_error_with_its_place():
    with pytest.raises(DocumentError, match=r"a\.yaml:2:9: a value outside of ros__parameters") as caught:
        ros2_parameters(b"lidar:\n  rate: 5\n", "a.yaml")
    assert "indent" in caught.value.advice


@pytest.mark.parametrize(
    ("value", "what"),
    [
        ("x: [0.5, 1]", "a list of values of different types: [0.5, 1]"),
        ("x: ['1', 2]", "a list of values of different types"),
        ("x: [true, a]", "a list of values of different types"),
        ("", "not a table of parameters"),
    ],
)
def test_what_rcl_refuses_is_an_error(value, what):
    with pytest.raises(DocumentError) as caught:
        ros2_parameters(f"lidar:\n  ros__parameters:\n    {value}\n".encode(), "a.yaml")
    assert (caught.value.what.startswith(what), "does not start" in caught.value.advice) == (True, True)


def test_what_is_empty_sets_nothing_and_the_last_of_two_holds():
    content = b"lidar:\n  ros__parameters:\n    a: {}\n    b: {c: {}}\n    d: 1\n    d: 2\n    e: ['$(var x)', 1]\n"
    assert [(str(one.name), str(one.value), one.type) for one in ros2_parameters(content, "a.yaml")] == [
        ("d", "2", "int"),
        ("e", "[$(var x), 1]", "list"),
    ]
    assert ros2_parameters(b"lidar: {ros__parameters: {}}", "a.yaml") == []


def test_files_of_ros1_are_flattened():
    content = b"base: &b {p: 1}\nother:\n  <<: *b\n  empty: {}\nangles: [1, 2]\n"
    assert told(ros1_parameters(content, "g.yaml", 10)) == [
        ("", "base/p", "1", "int", 11),
        ("", "other/p", "1", "int", 11),
        ("", "angles", "[1, 2]", "int_array", 15),
    ]
    assert ros1_parameters(b"", "g.yaml") == ros2_parameters(b"", "g.yaml") == []


def test_of_two_keys_of_one_name_rosparam_takes_the_last():
    settings = ros1_parameters(b"layer:\n  z: 1\n  a: x\n  z: 2\n", "a.yaml")
    assert {str(one.name): (str(one.value), one.evidence.line) for one in settings} == {
        "layer/z": ("2", 4),
        "layer/a": ("x", 3),
    }


def test_tags_are_read_as_rcl_does():
    content = b"""\
lidar:
  ros__parameters:
    a: !!str 5
    b: !!str true
    c: !!int "5"
    d: !!float 1
    e: !custom 1.5
    f: [!!str 1, "2"]
    g: !!seq [1, 2]
    h: !!bool yes
"""
    assert {name: (value, kind) for _, name, value, kind, _ in told(ros2_parameters(content, "a.yaml"))} == {
        "a": ("5", "string"), "b": ("true", "string"), "c": ("5", "string"), "d": ("1", "int"), "e": ("1.5", "double"),
        "f": ("[1, 2]", "string_array"), "g": ("[1, 2]", "int_array"), "h": ("yes", "bool"),
    }  # fmt: skip


def test_documents_of_a_file_are_read_one_after_the_other():
    content = b"---\na:\n  ros__parameters: {x: 1}\n---\nb:\n  ros__parameters: {y: 2}\n---\n"
    assert told(ros2_parameters(content, "a.yaml")) == [("/a", "x", "1", "int", 3), ("/b", "y", "2", "int", 6)]
