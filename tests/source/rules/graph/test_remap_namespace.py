import pytest

from roslens.model.configuration import ConfiguredRemap
from roslens.model.finding import Severity
from roslens.source.rules.graph.names.remap_namespace import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, launched, node


def _remapped(name, target, *ends):
    return node(name, *ends, remaps=(ConfiguredRemap("image", target, launched(4)),))


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings()))


def test_a_global_name_of_a_node_that_is_in_the_namespace_is_told():
    (one,) = findings(_remapped("/left/rectify", "/camera/image"), node("/left/camera"))
    assert (one.severity, one.line) == (Severity.WARNING, 4)
    assert one.message == (
        "remapping of `image` to `/camera/image`: /left/rectify is in the namespace /left, and so is /left/camera, "
        "whose names are below /left. Nothing has the global name. Write `camera/image`."
    )
    (one,) = findings(_remapped("/left/rectify", "/camera/image"), node("/left/camera/driver"))
    assert "/left/camera/driver" in one.message


@pytest.mark.parametrize("target", ["camera/image", "/left/camera/image", "/image", "/camera/*", "/other/image"])
def test_other_names_are_right(target):
    assert not findings(_remapped("/left/rectify", target), node("/left/camera"))


@pytest.mark.parametrize(
    "other",
    [
        node("/camera"),
        node("/camera/driver"),
        node("/viewer", end("pub", "/camera/image")),
        _remapped("/left/viewer", "/camera/image"),
        node("/left/*", resolved=False),
    ],
)
def test_a_name_that_somebody_has_or_may_have_is_right(other):
    assert not findings(_remapped("/left/rectify", "/camera/image"), node("/left/camera"), other)


def test_a_node_without_a_namespace_has_none_to_leave():
    assert not findings(_remapped("/rectify", "/camera/image"), node("/camera"))
