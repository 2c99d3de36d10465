from roslens.live.adapters.ros2.read_parameters import selected


def test_a_parameter_and_those_below_it():
    values = {"reference": "a", "reference.arm": "b", "references": "c", "rate": 1}
    assert selected(values, "reference") == {"reference": "a", "reference.arm": "b"}
    assert selected(values, "reference.arm") == {"reference.arm": "b"}
    assert selected(values, "ref") == {}
