import pytest

from roslens.source.extract.launch.launch_version import launch_version


@pytest.mark.parametrize(
    ("path", "content", "versions", "expected"),
    [
        ("a.launch", b'<launch><include file="b.launch"/></launch>', ("ros2",), "ros2"),
        ("a.launch", b'<launch><include file="b.launch"/></launch>', ("ros1", "ros2"), "ros1"),
        ("a.launch", b'<launch><include file="$(find a)/b.launch"/></launch>', ("ros2",), "ros1"),
        ("a.launch", b'<launch><node pkg="a" type="b" name="c"/></launch>', ("ros2",), "ros1"),
        ("a.launch", b'<launch><node pkg="a" exec="b"/></launch>', ("ros1",), "ros2"),
        ("a.launch.xml", b'<launch><node pkg="a" type="b"/></launch>', (), "ros1"),
        ("a.launch.xml", b"<launch/>", ("ros1",), "ros2"),
    ],
)
def test_a_launch_file_is_for_the_version_that_it_is_written_in_else_for_that_of_its_package(
    path, content, versions, expected
):
    assert launch_version(path, content, versions) == expected
