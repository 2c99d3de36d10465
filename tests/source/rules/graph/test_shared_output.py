from roslens.model.configuration import Proof
from roslens.source.rules.graph.shared_output import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node

REMAPPED = Proof("launch/robot.launch.xml", 3)
CODE = Proof("src/camera.cpp", 1)


def camera(name, *ends, **more):
    from msgspec.structs import replace

    placed = [replace(one, proof=replace(one.proof, path="src/camera.cpp")) for one in ends]
    return node(name, *placed, executable="camera", defined=CODE, **more)


def raw(side, **more):
    return end("pub", f"/{side}/image_raw", line=1, given="image_raw", **{"remapped": REMAPPED, **more})


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings()))


IMAGE = end("pub", "/image", line=2, given="image")


def test_an_output_that_was_forgotten_is_told():
    (one,) = findings(camera("/left", raw("left"), IMAGE), camera("/right", raw("right"), IMAGE))
    assert (one.rule, one.entity, one.severity.value) == ("graph.shared_output", "topic:/image", "warning")
    assert one.message == (
        "/left, /right (src/camera.cpp:2) all publish topic /image, while they keep /left/image_raw, "
        "/right/image_raw apart by remapping. Remap `image` for each of them too."
    )


def test_what_was_kept_apart_or_never_was_is_none():
    other = end("pub", "/r/image", line=2, remapped=REMAPPED)
    assert not findings(camera("/left", raw("left"), IMAGE), camera("/right", raw("right"), other))
    assert not findings(camera("/left", raw("same"), IMAGE), camera("/right", raw("same"), IMAGE))
    assert not findings(camera("/left", IMAGE), camera("/right", IMAGE))


def test_namespaces_keep_apart_what_is_meant_to_be_shared():
    assert not findings(camera("/l/c", raw("l", remapped=None), IMAGE), camera("/r/c", raw("r", remapped=None), IMAGE))


def test_what_all_share_inputs_other_programs_and_alternatives_are_none():
    told = end("pub", "/diagnostics", line=2)
    heard = end("sub", "/trigger", line=2)
    assert not findings(camera("/left", raw("left"), told), camera("/right", raw("right"), told))
    assert not findings(camera("/left", raw("left"), heard), camera("/right", raw("right"), heard))
    assert not findings(camera("/left", raw("left"), IMAGE), node("/right", raw("right"), IMAGE))
    assert not findings(
        camera("/left", raw("left"), IMAGE, conditions=("a",)),
        camera("/right", raw("right"), IMAGE, conditions=("not a",)),
    )
