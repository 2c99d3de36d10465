import sqlite3
from contextlib import closing

import pytest

from roslens.model.entity import EntityId, EntityKind
from roslens.model.errors import StoreError
from roslens.model.graph import Change, Event
from roslens.model.verdict import State, Verdict
from roslens.store.live.history import KEPT_VERDICTS_S, History
from roslens.store.live.series import Tier
from roslens.store.past.moment import Moment

SCAN = EntityId(EntityKind.TOPIC, "/scan")
NOW = 1_700_000_000.0


def verdict(time, state=State.LOW, entity=SCAN):
    return Verdict(entity, "rover.scan.rate", "rate", state, time - 1, time, 12.5, "25..35 Hz")


def test_what_was_written_is_read_after_a_restart(tmp_path):
    path = tmp_path / "live.sqlite"
    with History.open(path) as history:
        for second in range(30):
            history.add_values("topic:/scan", NOW + second, {"rate": 25.0 + second, "jitter": 0.001})
        history.add_verdicts([verdict(NOW + 3)])
        history.add_events([Event(NOW + 4, Change.VANISHED, "node:/lidar", "killed")])
    with History.open(path) as history:
        points = history.points("topic:/scan", "rate", NOW, NOW + 100)
        assert [(point.time, point.mean) for point in points] == [(NOW + n, 25.0 + n) for n in range(30)]
        assert history.points("topic:/other", "rate", NOW, NOW + 100) == ()
        assert history.verdicts(NOW, NOW + 10) == (verdict(NOW + 3),)
        assert history.verdicts(NOW, NOW + 10, entity="node:/x") == ()
        assert history.events(NOW, NOW + 10) == (Event(NOW + 4, Change.VANISHED, "node:/lidar", "killed"),)


def test_a_reader_sees_what_was_flushed_while_the_writer_goes_on(tmp_path):
    path = tmp_path / "live.sqlite"
    with History.open(path) as writer, History.open(path) as reader:
        writer.add_values("host:a", NOW, {"cpu": 1.0})
        writer.add_values("host:a", NOW + 1, {"cpu": 2.0})
        assert reader.points("host:a", "cpu", NOW, NOW + 10) == ()
        writer.flush()
        assert [point.mean for point in reader.points("host:a", "cpu", NOW, NOW + 10)] == [1.0]


def test_old_things_go_and_coarse_ones_stay():
    with History.open(None) as history:
        for second in range(0, 7200, 5):
            history.add_values("host:a", NOW + second, {"cpu": 1.0})
        history.add_verdicts([verdict(NOW), verdict(NOW + KEPT_VERDICTS_S)])
        history.prune(NOW + 7200)
        assert history.points("host:a", "cpu", NOW, NOW + 600) == ()
        assert len(history.points("host:a", "cpu", NOW, NOW + 7200, most=800)) == 719
        history.prune(NOW + KEPT_VERDICTS_S + 1)
        assert history.verdicts(NOW - 1, NOW + 2 * KEPT_VERDICTS_S) == (verdict(NOW + KEPT_VERDICTS_S),)
        assert history.points("host:a", "cpu", NOW, NOW + 7200, most=800) == ()


def test_how_everything_stood_is_kept_less_often_the_longer_it_is_ago():
    tiers = (Tier(1, 60), Tier(10, 600), Tier(60, 6000))
    begun = 1_200_000.0
    with History.open(None, tiers) as history:
        for second in range(3000):
            history.add_moment(Moment(begun + second + 0.5))
        history.prune(begun + 3000)
        known = [time for (time,) in history._connection.execute("SELECT time FROM moment ORDER BY time")]
        assert [time for time in known if time > begun + 2940] == [begun + 2940.5 + at for at in range(60)]
        assert [time for time in known if begun + 2400 < time < begun + 2940] == [
            begun + at + 9.5 for at in range(2400, 2940, 10)
        ]
        assert [time for time in known if time < begun + 2400] == [
            begun + 0.5, *(begun + at + 59.5 for at in range(0, 2400, 60))
        ]  # fmt: skip


def test_series_of_which_nothing_is_left_are_forgotten():
    with History.open(None, (Tier(1, 60), Tier(10, 600))) as history:
        for second in range(0, 2000, 5):
            history.add_values(f"process:a/{second}", NOW + second, {"cpu": 1.0})
            history.add_values("host:a", NOW + second, {"cpu": 1.0})
        history.prune(NOW + 2000)
        kept = {entity for (entity,) in history._connection.execute("SELECT entity FROM series")}
        assert "host:a" in kept
        assert len(kept) <= 1 + 600 / 5 + 1
        history.add_values("host:a", NOW + 2001, {"cpu": 2.0})
        history.flush(final=True)
        assert history.points("host:a", "cpu", NOW + 2001, NOW + 2002)[-1].mean == 2.0


def test_hostile_names_are_stored():
    with History.open(None) as history:
        for name in ("topic:/a'b\"c", "topic:/\udcff", "topic:/" + "x" * 10_000, "topic:/\x00"):
            history.add_values(name, NOW, {"rate": 1.0})
            history.add_events([Event(NOW, Change.APPEARED, name, "\udcff")])
        history.add_verdicts([verdict(NOW, entity=EntityId(EntityKind.TOPIC, "/é"))])
        history.flush(final=True)
        assert len(history.points("topic:/a'b\"c", "rate", NOW - 1, NOW + 1)) == 1
        assert len(history.events(NOW, NOW)) == 4


def test_a_file_that_is_none_of_ours_is_left_alone(tmp_path):
    path = tmp_path / "live.sqlite"
    path.write_bytes(b"something else entirely, of some length" * 100)
    with pytest.raises(StoreError, match="not a SQLite database"):
        History.open(path)
    assert path.read_bytes().startswith(b"something else")


def test_a_failed_write_loses_nothing(tmp_path, monkeypatch):
    with History.open(tmp_path / "live.sqlite") as history:
        history.add_events([Event(NOW, Change.APPEARED, "node:/a")])
        with closing(sqlite3.connect(tmp_path / "live.sqlite")) as other, other:
            other.execute("BEGIN IMMEDIATE")
            history._connection.execute("PRAGMA busy_timeout = 1")
            with pytest.raises(StoreError, match="in use by another process"):
                history.flush()
            other.execute("ROLLBACK")
        other.close()
        history.flush()
        assert len(history.events(NOW, NOW)) == 1


@pytest.mark.parametrize("ended", [True, False])
def test_a_full_disk_is_told_whether_sqlite_has_ended_the_transaction_or_not(tmp_path, monkeypatch, ended):
    history = History.open(tmp_path / "live.sqlite")
    history.add_events([Event(1.0, Change.VANISHED, "node:/a")])

    def full():
        if ended:
            history._connection.execute("ROLLBACK")
        raise sqlite3.OperationalError("database or disk is full")

    monkeypatch.setattr(history, "_write", full)
    with pytest.raises(StoreError, match="full"):
        history.flush()
    assert not history._connection.in_transaction
    history._connection.close()


def test_a_series_that_was_let_go_goes_on_in_the_same_buckets(tmp_path):
    begin = NOW // 600 * 600
    with History.open(tmp_path / "live.sqlite") as history:
        history.add_values("host:a", begin, {"cpu": 1.0})
        history.add_values("host:a", begin + 1, {"cpu": 4.0})
        history.let_go(begin + 200)
        history.add_values("host:a", begin + 300, {"cpu": 10.0})
        history.flush(final=True)
        (point,) = [one for one in history.points("host:a", "cpu", begin, begin + 80 * 86_400) if one.time == begin]
        assert (point.count, point.mean, point.least, point.greatest) == (3, 5.0, 1.0, 10.0)


def test_a_verdict_about_a_name_that_utf8_cannot_write_is_kept():
    with History.open(None) as history:
        history.add_verdicts([verdict(NOW, entity=EntityId(EntityKind.HOST, "a\udcff"))])
        history.flush()
        (found,) = history.verdicts(NOW, NOW + 1)
        assert found.entity.name == "a\\xff"
