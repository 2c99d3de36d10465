"""What tools that show diagnostics take for granted: rqt_robot_monitor, aggregators and Foxglove."""

from dashboard.live.scripted_robot import ScriptedRobot

from roslens.live.publish.diagnostics import diagnostics


def statuses():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.gone.add("/camera")
    robot.run(5)
    return diagnostics(robot.session.monitor.standing())


def test_names_are_unique_and_stay_the_same():
    names = [one.name for one in statuses()]
    assert len(names) == len(set(names))
    assert names == [one.name for one in statuses()]
    assert all(name.startswith("roslens: ") for name in names)


def test_levels_are_those_of_the_message_and_values_are_texts():
    found = statuses()
    assert {0, 2} <= {one.level for one in found} <= {0, 1, 2, 3}
    for one in found:
        assert one.message
        keys = [key for key, _ in one.values]
        assert len(keys) == len(set(keys))
        assert all(isinstance(part, str) and part for pair in one.values for part in pair)


def test_a_prefix_that_is_taken_away_leaves_names_apart():
    short = [one.name.removeprefix("roslens: ") for one in statuses()]
    assert all(name and not name.startswith("/") for name in short)
