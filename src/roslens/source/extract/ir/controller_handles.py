"""Handles that a manager of ros_control gives a controller: in the namespace of its name, which parameters say."""

from __future__ import annotations

from roslens.source.extract.ir.program import Function, Parameter
from roslens.source.extract.ir.type_names import type_name

_HARDWARE = ("hardware_interface", "RobotHW", "RobotHWSim")


def is_of_controller(what: Function, parameter: Parameter) -> bool:
    """Return whether a parameter is the handle of a controller.

    ``init`` takes hardware, then the handle of the robot where it takes two, and that of the controller as its last.
    """
    handles = [one for one in what.parameters if type_name(one.type)[0].endswith("NodeHandle")]
    if not any(one is parameter for one in handles):
        return False
    hardware = any(word in one.type for one in what.parameters for word in _HARDWARE)
    return "controller" in parameter.name or (what.name == "init" and hardware and handles[-1] is parameter)
