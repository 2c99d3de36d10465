from roslens.source.rules.graph.surroundings import Surroundings, Transform
from roslens.source.rules.graph.transform import found
from testbed.configured import clauses, configuration, launched


def findings(*transforms):
    return list(found(configuration(), Surroundings(transforms=transforms)))


def test_a_frame_with_two_parents_is_told():
    (one,) = findings(Transform("/a", "base", "laser", launched(2)), Transform("/b", "mast", "/laser", launched(5)))
    assert one.line == 5
    assert one.message == (
        "frame laser has two parents: base by /a (launch/robot.launch.xml:2) and mast by /b "
        "(launch/robot.launch.xml:5). Remove one of the two."
    )


def test_the_same_transform_twice_is_told():
    (one,) = findings(Transform("/a", "base", "laser", launched(2)), Transform("/b", "base", "laser", launched(5)))
    assert "both place laser in base" in one.message


def test_frames_of_their_own_and_opposite_conditions_are_none():
    assert not findings(Transform("/a", "base", "laser", launched(2)), Transform("/b", "base", "imu", launched(5)))
    assert not findings(
        Transform("/a", "base", "laser", launched(2), clauses=clauses(["sim"])),
        Transform("/b", "mast", "laser", launched(5), clauses=clauses(["not sim"])),
    )
