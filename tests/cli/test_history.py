"""`roslens history` over what a watch kept."""

import csv
import io
import json
import sys
from itertools import pairwise
from types import ModuleType

import pytest

from roslens.cli.main import main
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Event
from roslens.model.verdict import State, Verdict
from roslens.report.history.history_text import sparkline
from roslens.store.live.history import History
from roslens.store.live.series import Point

START = 1_769_846_400
SCAN = EntityId(EntityKind.TOPIC, "/scan")


def verdict(at, state, value=None, cause=""):
    return Verdict(SCAN, "r.scan", "rate", state, START + at, START + at + 1.0, value, "8..12 Hz", cause=cause)


@pytest.fixture
def kept(tmp_path):
    """Two minutes of a topic that is slow for a quarter of a minute, and of a host."""
    path = tmp_path / "robot.sqlite"
    with History.open(path) as history:
        for second in range(120):
            history.add_values("topic:/scan", START + second, {"rate": 4.0 if 60 <= second < 75 else 10.0})
            history.add_values("host:base", START + second, {"cpu": float(second)})
        history.add_verdicts(
            [verdict(1, State.OK, 10.0), verdict(60, State.LOW, 4.0, "node:/lidar"), verdict(75, State.OK, 10.0)]
        )
        history.add_verdicts([verdict(110, State.ABSENT)])
        history.add_events([Event(START + 5.5, Change.APPEARED, "node:/late", "on base")])
    return path


def said(capsys, *words):
    assert main(["history", *map(str, words)]) == 0
    return capsys.readouterr().out


def test_a_summary_has_a_line_a_series_and_each_fault_with_its_length(kept, capsys):
    lines = said(capsys, kept, "--no-color").splitlines()
    assert lines[0].startswith(f"{kept}: ")
    assert lines[0].endswith(", 120 s")
    rows = {tuple(line.split()[:2]): line for line in lines[1:4]}
    assert "4 Hz" in rows["topic:/scan", "rate"]
    assert "9.25 Hz" in rows["topic:/scan", "rate"]
    assert "█▁" in rows["topic:/scan", "rate"]
    assert rows["host:base", "cpu"].rstrip().endswith("█")
    assert lines[4] == "what was wrong, 2 times:"
    assert "low     topic:/scan rate for 15.0 s because of node:/lidar" in lines[5]
    assert "absent  topic:/scan rate to the end" in lines[6]
    assert lines[7] == "events: 1 appeared"


def test_points_as_csv(kept, capsys):
    rows = list(csv.DictReader(io.StringIO(said(capsys, kept, "--format", "csv", "--signal", "rate"))))
    assert len(rows) == 120
    assert {row["entity"] for row in rows} == {"topic:/scan"}
    assert [float(row["at"]) for row in rows] == list(range(120))
    assert [float(row["mean"]) for row in rows[58:62]] == [10.0, 10.0, 4.0, 4.0]
    assert (rows[0]["unit"], rows[0]["seconds"], float(rows[0]["time"])) == ("Hz", "1", START)


@pytest.mark.parametrize(
    ("since", "until", "times"),
    [("10s", None, (110, 119)), ("+5s", "+20s", (5, 20)), ("2026-01-31T08:00:30+00:00", "1min", (30, 60))],
)
def test_a_stretch_of_time(kept, capsys, since, until, times):
    words = [kept, "--format", "csv", "--signal", "cpu", "--since", since, *(["--until", until] if until else [])]
    rows = list(csv.DictReader(io.StringIO(said(capsys, *words))))
    assert (float(rows[0]["at"]), float(rows[-1]["at"])) == times


def test_verdicts_and_events_as_csv(kept, capsys):
    rows = list(csv.DictReader(io.StringIO(said(capsys, kept, "--format", "csv", "--what", "verdicts"))))
    assert [(row["state"], float(row["since"]) - START) for row in rows] == [
        ("ok", 1), ("low", 60), ("ok", 75), ("absent", 110),
    ]  # fmt: skip
    rows = list(csv.DictReader(io.StringIO(said(capsys, kept, "--format", "csv", "--what", "events"))))
    assert [(row["entity"], row["change"], row["at"]) for row in rows] == [("node:/late", "appeared", "5.5")]


def test_everything_as_json_with_times_from_the_beginning(kept, capsys):
    (file,) = json.loads(said(capsys, kept, kept, "--format", "json"))["files"][:1]
    assert {one["entity"]: len(one["points"]) for one in file["series"]} == {"host:base": 120, "topic:/scan": 120}
    assert file["verdicts"][1]["entity"] == "topic:/scan"
    assert (file["verdicts"][1]["at"], file["verdicts"][1]["state"]) == (61.0, "low")
    assert (file["events"][0]["at"], file["begin"]) == (5.5, START)


@pytest.mark.parametrize(
    ("pattern", "found"), [("topic:/**", {"topic:/scan"}), ("/scan", {"topic:/scan"}), ("host:*", {"host:base"})]
)
def test_entities_by_pattern(kept, capsys, pattern, found):
    (file,) = json.loads(said(capsys, kept, "--format", "json", "--entity", pattern))["files"]
    assert {one["entity"] for one in file["series"]} == found


@pytest.mark.parametrize("ahead", [0, 3, 7])
def test_what_was_long_ago_is_told_in_the_resolution_that_is_left(tmp_path, capsys, ahead):
    path = tmp_path / "old.sqlite"
    with History.open(path) as history:
        for second in range(0, 3600, 5):
            history.add_values("host:base", START + ahead + second, {"cpu": 1.0})
        history.flush(final=True)
        history.prune(START + 3600 + ahead)
    rows = list(csv.DictReader(io.StringIO(said(capsys, path, "--format", "csv"))))
    assert {row["seconds"] for row in rows} == {"1", "10"}
    ends = [(float(row["at"]), float(row["at"]) + float(row["seconds"])) for row in rows]
    assert all(end <= start for (_, end), (start, _) in pairwise(ends))
    assert sum(int(row["count"]) for row in rows) == 720


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--entity", "topic:/nothing"], "matches nothing that was kept"),
        (["--signal", "rat"], "matches nothing that was kept"),
        (["--since", "yesterday"], "--since 'yesterday'"),
        (["--since", "1s", "--until", "1min"], "before"),
        (["--format", "parquet"], "-o FILE"),
        (["--format", "csv", "--what", "events", "--what", "series"], "one table"),
    ],
)
def test_what_makes_no_sense_is_named(kept, capsys, words, said):
    assert main(["history", str(kept), *words]) == 2
    assert said in capsys.readouterr().err


def test_a_file_that_is_no_history_is_named_and_left_alone(tmp_path, capsys):
    other = tmp_path / "other.sqlite"
    other.write_bytes(b"something else, and longer than a header of SQLite, which has a hundred bytes" * 3)
    for path in (other, tmp_path / "missing.sqlite"):
        assert main(["history", str(path)]) == 2
        assert "roslens watch --history" in capsys.readouterr().err
    assert not (tmp_path / "missing.sqlite").exists()


def test_parquet_needs_what_is_not_installed_with_roslens(kept, tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert main(["history", str(kept), "--format", "parquet", "-o", str(tmp_path / "x.parquet")]) == 2
    assert "pip install 'roslens[parquet]'" in capsys.readouterr().err
    assert not (tmp_path / "x.parquet").exists()


def test_parquet_gets_the_columns_of_the_table(kept, tmp_path, monkeypatch):
    """What pyarrow is given; that it writes what it is given is its own affair."""
    given = {}
    arrow, parquet = ModuleType("pyarrow"), ModuleType("pyarrow.parquet")
    arrow.array, arrow.table = list, dict
    parquet.write_table = lambda table, path: (given.update(table), path.write_text("written"))
    monkeypatch.setitem(sys.modules, "pyarrow", arrow)
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", parquet)
    out = tmp_path / "x.parquet"
    assert main(["history", str(kept), "--signal", "rate", "--format", "parquet", "-o", str(out)]) == 0
    assert out.read_text() == "written"
    assert (set(given["entity"]), len(given["mean"]), given["at"][:2]) == ({"topic:/scan"}, 120, [0.0, 1.0])


def test_a_picture_of_a_series():
    points = [(1, Point(at, 1, float(at % 8), 0.0, 8.0)) for at in range(8)]
    assert sparkline(points, 0.0, 8.0, 8, ascii_only=False) == "▁▂▃▄▅▆▇█"
    assert sparkline(points[4:], 0.0, 8.0, 8, ascii_only=False)[:4] == "    "
    assert sparkline([(1, Point(0, 1, 5.0, 5.0, 5.0))], 0.0, 2.0, 2, ascii_only=True) == "= "
