from pathlib import Path

from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.workspace.workspace_facts import WorkspaceFacts
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import find_workspace
from roslens.store.cache import Cache

EXAMPLE = Path(__file__).parents[4] / "examples" / "workspace"


def facts(cache: Cache) -> WorkspaceFacts:
    settings = SourceSettings()
    return WorkspaceFacts(find_workspace([EXAMPLE], settings.workspace), settings, cache=cache, now_s=1e9, jobs=1)


def test_packages_builds_and_launch_files_are_known():
    with Cache.open(None) as cache:
        found = facts(cache)
        assert found.has("rover_sensors")
        assert not found.has("nowhere")
        assert "range_filter" in {target.name for target in found.targets("rover_sensors")}
        assert found.targets("nowhere") == ()
        (script,) = found.scripts("rover_sensors", "range_filter.py")
        assert script.endswith("rover_sensors/rover_sensors/range_filter.py")
        assert found.scripts("rover_sensors", "package.xml") == found.scripts("nowhere", "a.py") == []
        assert [path.rpartition("/")[2] for path in found.launch_files("rover_bringup")] == [
            "navigation.launch.xml",
            "rover.launch.py",
            "sensors.launch.yaml",
        ]
        assert found.launch_files("nowhere") == found.paths("nowhere") == ()


def test_what_was_evaluated_is_there_the_next_time(tmp_path, monkeypatch):
    path = "src/rover/rover_sensors/rover_sensors/battery_monitor.py"
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        found = facts(cache).of("ros2")
        first = found.program(path, "main")
        found.keep()
    assert [one.name.known for one in first] == ["battery_monitor"]
    from roslens.source.extract.units import node_units

    monkeypatch.setattr(node_units, "facts_of_module", None)
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        again = facts(cache).of("ros2")
        assert again.program(path, "main") == first
        assert again.broken == []


def test_a_unit_that_breaks_is_told_and_not_kept(tmp_path, monkeypatch):
    from roslens.source.extract.units import node_units

    def broken(*_: object, **_named: object) -> None:
        raise ZeroDivisionError

    path = "src/rover/rover_sensors/rover_sensors/battery_monitor.py"
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        with monkeypatch.context() as patched:
            patched.setattr(node_units, "facts_of_module", broken)
            found = facts(cache)
            assert found.program(path, "main") == ()
            assert ["ZeroDivisionError" in one.what for one in found.broken] == [True]
        assert facts(cache).program(path, "main") != ()


def test_whether_a_program_reads_its_words_is_kept(tmp_path):
    path, words = "src/rover/rover_sensors/rover_sensors/battery_monitor.py", (Text.of("a"), Text.of("b"))
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        found = facts(cache).of("ros2")
        first = found.program(path, "main", words)
        found.keep()
        again = facts(cache).of("ros2")
        assert again.program(path, "main", words) == first
        assert not again._parts._indexes


def test_units_are_evaluated_once_though_all_are_asked_for_what_they_miss(monkeypatch):
    from roslens.source.extract.units import finished_unit

    path = "src/rover/rover_sensors/rover_sensors/battery_monitor.py"
    with Cache.open(None) as cache:
        found = facts(cache).of("ros2")
        first = found.program(path)
        runs = []
        made, ran = (
            finished_unit._made,
            lambda engine: runs.append((engine.emitter.node.path, engine.emitter.node.unit)),
        )
        monkeypatch.setattr(finished_unit, "_made", lambda engine, run: ran(engine) or made(engine, run))
        assert found.missed_in_code("rover_sensors") == ()
        assert found.missed_in_code("nowhere") == ()
        assert found.program(path) == first
    assert (path, "main") in runs
    assert (path, "<module>") not in runs
