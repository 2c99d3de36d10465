from roslens.model.configuration import ConfiguredArgument
from roslens.model.finding import Severity
from roslens.source.rules.graph.argument import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, launched, node

ROBOT = ConfiguredArgument("robot", launched(2), None, "which one", ())
MODE = ConfiguredArgument("mode", launched(3), "slow", "", ("slow", "fast"))


def findings(**given):
    known = configuration(node("/a"), arguments=(ROBOT, MODE))
    return list(found(known, Surroundings(given=given, started=True)))


def test_what_must_be_given_to_a_file_that_nobody_starts_is_no_mistake_of_it():
    known = configuration(node("/a"), arguments=(ROBOT, MODE))
    assert not list(found(known, Surroundings()))


def test_an_argument_without_a_default_must_be_given():
    (one,) = findings()
    assert (one.severity, one.line, one.entity) == (Severity.ERROR, 2, "launch_file:launch/robot.launch.xml")
    assert one.message == (
        "argument `robot` (which one) must be given: launch/robot.launch.xml:2 declares it without a default. "
        "Give `robot:=…` or declare a default."
    )


def test_what_is_given_and_valid_is_none():
    assert not findings(robot="a", mode="fast")


def test_a_value_has_to_be_one_of_the_choices():
    (one,) = findings(robot="a", mode="turbo")
    assert "argument `mode` is given as `turbo`; launch/robot.launch.xml:3 allows slow, fast." in one.message


def test_an_argument_that_nobody_declares_is_a_warning():
    missing, useless = findings(robto="a")
    assert "`robto` is given instead" in missing.message
    assert (useless.severity, "Did you mean `robot`?" in useless.message) == (Severity.WARNING, True)
