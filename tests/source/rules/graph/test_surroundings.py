import pytest

from roslens.source.rules.graph.surroundings import Surroundings


@pytest.mark.parametrize("name", ["/tf", "/clock", "/robot/diagnostics", "/camera/image/compressed"])
def test_the_other_end_of_these_is_elsewhere(name):
    assert Surroundings().is_external(name)


def test_others_are_not():
    assert not Surroundings().is_external("/scan")


@pytest.mark.parametrize("name", ["/cmd_vel", "/robot/cmd_vel", "/arm_controller/command"])
def test_these_move_something(name):
    assert Surroundings().is_command(name)


def test_a_multiplexers_inputs_do_not():
    assert not Surroundings().is_command("/cmd_vel_mux/input/joy")
