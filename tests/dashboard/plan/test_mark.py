"""How a node or topic is drawn: its name fits into its box."""

from __future__ import annotations

from roslens.dashboard.plan.mark import LONGEST, label_of, lane_of, namespace_of, part_of, relative


def test_labels_say_the_end_of_a_long_name() -> None:
    label = label_of("/a/" + "x" * 40 + "/image", "/a")
    assert len(label) == LONGEST
    assert label.endswith("/image")
    assert label_of("/a/image", "/a") == "image"
    assert label_of("/a/*", "/a", "CameraNode") == "* (CameraNode)"


def test_names_are_told_as_seen_from_their_namespace() -> None:
    assert relative("/a/b/c", "/a") == "b/c"
    assert relative("/a", "/") == "a"


def test_a_host_is_around_the_namespace() -> None:
    assert part_of("node:/a/b", "/a/b", "/a", host="base").lane == "/@base/a"
    assert part_of("topic:/b", "/b", "/", host="base").lane == "/@base"
    assert part_of("topic:/b", "/b", "/").lane == "/"


def test_a_name_stands_in_the_innermost_namespace_that_holds_nodes() -> None:
    assert namespace_of("/a/b") == "/a"
    assert namespace_of("/a") == "/"
    assert lane_of("/a/b/c", {"/a"}) == "/a"
    assert lane_of("/b/c", {"/a"}) == "/"
