"""Names that become folders."""

import pytest

from roslens.source.fetch.folder_name import is_folder_name


@pytest.mark.parametrize("name", ["husky", "ros2/rclcpp", "a-b.c_d+1", "sr-ronex"])
def test_plain_ones(name):
    assert is_folder_name(name)


@pytest.mark.parametrize(
    "name",
    ["", ".", "..", "a/../b", "/a", "a//b", "a/", ".git", "a/.git", "x.git", "-a", ".roslens", "a\nb", "a" * 300],
)
def test_others(name):
    assert not is_folder_name(name)
