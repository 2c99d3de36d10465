"""What a keeper asks of a session: as much as it keeps, and no more at each step."""

from dashboard.live.scripted_robot import large_robot

from roslens.live.past import keeper
from roslens.live.past.keeper import Keeper, moment_of
from roslens.model.verdict import State
from roslens.store.live.history import History


def test_how_everything_stands_is_asked_for_where_it_is_kept(monkeypatch):
    """To ask brings every topic to the present, a hundred times what a step costs."""
    monkeypatch.setattr(keeper, "_LEAST_CHANGES", 5)
    robot = large_robot(20)
    robot.page.make = lambda *_: None
    robot.run(30)
    monitor, asked, kept = robot.session.monitor, [], []
    standing = monitor.standing
    monkeypatch.setattr(keeper, "moment_of", lambda session, now: kept.append(now) or moment_of(session, now))
    monitor.standing = lambda: asked.append(robot.now) or standing()
    robot.rates = {topic: 1 for _, topic, *_ in robot.wires[:12]}
    robot.run(30)
    assert sum(one.state is State.LOW for one in standing()) == 12
    assert asked == kept
    robot.rates = {}
    robot.run(30)
    assert asked == kept != []


def test_a_history_tells_how_much_it_takes(tmp_path):
    robot = large_robot(20)
    for path in (None, tmp_path / "history.sqlite"):
        with History.open(path) as history:
            before = history.size
            robot.keeper = Keeper(robot.session, history)
            robot.run(20)
            robot.keeper.end()
            assert history.size > before
