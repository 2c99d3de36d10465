"""What can be asked of a run."""

from concurrent.futures import ThreadPoolExecutor

import msgspec
import pytest

from roslens.model.entity import EntityKind
from roslens.model.finding import Finding, Severity
from roslens.model.result import WorkspaceResult
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.tags import parse_tags
from roslens.store.runs import Store

DRIVE = "src/drive/src/drive.cpp"


@pytest.fixture
def view(tmp_path, write_small):
    with Store.open(tmp_path / "store.sqlite") as store:
        yield store.view(write_small(store))


def rules(findings):
    return [finding.rule for finding in findings]


def test_packages_come_by_id_with_what_needs_all_of_them(view):
    arm, drive = view.packages()
    assert (arm.id, drive.id) == ("arm", "drive")
    assert drive.values == {"loc": 52, "cyclomatic_complexity": 8.75, "dependents": 0}
    assert arm.values == {"loc": 0, "dependents": 1}


def test_a_package_comes_back_as_it_was_kept(view, sample):
    drive = view.package("drive")
    assert drive.entities[0].values == {"loc": 52, "cyclomatic_complexity": 8.75, "dependents": 0}
    assert drive.entities[1:] == sample.drive().entities[1:]
    assert drive.package == sample.drive().package
    assert drive.files == sample.drive().files
    assert drive.findings == sample.drive().findings
    assert drive.failures == sample.drive().failures
    assert view.package("no such") is None
    assert view.package("") is None


@pytest.fixture
def shared(sample):
    """Return findings that only all packages together show: of a package, and of one that the run does not have."""
    return tuple(
        Finding("graph.qos", Severity.ERROR, "do not fit", path, 3, tags=("qos",), fingerprint=path, gated=gated)
        for path, gated in (("src/drive/a.py", True), ("src/drive/test/b.py", False))
    )


def test_what_only_all_packages_show_of_one_counts_as_its_own(sample, shared):
    workspace = msgspec.structs.replace(sample.workspace(), package_findings={"drive": shared, "gone": shared[:1]})
    with Store.open(None) as store:
        with store.writing(sample.header()) as writer:
            writer.add("unit-drive", sample.drive())
            writer.add("unit-arm", sample.arm())
            view = store.view(writer.complete(workspace, sample.header()))
        own = [finding.rule for finding in sample.drive().findings]
        assert rules(view.findings(package="drive")) == [*own, "graph.qos", "graph.qos"]
        assert view.count_findings(package="drive", rule="graph.qos") == 2
        assert view.package("drive").findings[-2:] == shared
        assert len(view.package("drive").files) == 3
        _, drive = view.packages()
        assert next((one.rule, one.count, one.gated) for one in drive.rules) == ("graph.qos", 2, 1)
        assert [one.id for one in view.packages()] == ["arm", "drive"]
        assert view.workspace.package_findings == {"drive": shared}
        assert rules(view.findings(package="")) == rules(view.workspace.findings) == ["manifest.cycle", "graph.qos"]
        owners = [(package, finding.rule) for package, finding in view.owned_findings()]
        assert owners[-3:] == [("drive", "graph.qos"), ("", "manifest.cycle"), ("", "graph.qos")]
        (stored,) = store.runs()
        assert (stored.packages, stored.findings) == (2, len(owners))
        shown = store._connection.execute("SELECT id FROM packages WHERE run = ?", (view.id,)).fetchall()
        assert shown == [("arm",), ("drive",)]
        store.prune(0)
        assert store._connection.execute("SELECT count(*) FROM unit").fetchone() == (0,)


def test_the_workspace_comes_back_as_it_was_kept(view, sample):
    assert view.workspace == sample.workspace()
    assert view.rules() == sample.RULES
    assert view.quantities() == sample.QUANTITIES


def test_entities(view, sample):
    kinds = [entity.kind.value for entity in view.entities()]
    assert kinds == ["package", "package", "file", "class", "function"]
    assert [entity.name for entity in view.entities(kind=EntityKind.PACKAGE)] == ["arm", "drive"]
    assert [entity.name for entity in view.entities(package="arm")] == ["arm"]
    assert [entity.kind.value for entity in view.entities(path=DRIVE)] == ["file", "class", "function"]
    (function,) = view.entities(path=DRIVE, kind=EntityKind.FUNCTION)
    assert function == sample.drive().entities[3]
    assert list(view.entities(package="drive", path="src/arm")) == []


def test_one_entity(view, sample):
    for entity in sample.drive().entities[1:]:
        assert view.entity(entity.id) == entity
    assert view.entity("package:arm").values == {"loc": 0, "dependents": 1}
    assert view.entity("function:src/drive/src/drive.cpp#drive::Drive::reset()") is None
    assert view.entity("nonsense") is None


def test_files(view, sample):
    assert [(package, file.path) for package, file in view.files()][:2] == [
        ("arm", "src/arm/arm/__init__.py"),
        ("drive", "src/drive/package.xml"),
    ]
    assert list(view.files(path=DRIVE)) == [("drive", sample.drive().files[1])]
    assert len(list(view.files(package="drive"))) == 3


def test_findings(view, sample):
    assert rules(view.findings()) == ["ros.cyclomatic_complexity", "style.tabs", "manifest.cycle"]
    assert list(view.findings(package="drive")) == list(sample.drive().findings)
    assert rules(view.findings(package="")) == ["manifest.cycle"]
    assert rules(view.findings(rule="style.tabs")) == ["style.tabs"]
    assert rules(view.findings(path=DRIVE)) == ["ros.cyclomatic_complexity"]
    assert rules(view.findings(severity=Severity.NOTE)) == ["style.tabs"]
    assert rules(view.findings(severity=(Severity.NOTE, Severity.ERROR))) == ["style.tabs", "manifest.cycle"]
    assert rules(view.findings(severity=())) == []
    assert rules(view.findings(include_tags=["style", "ros"])) == ["ros.cyclomatic_complexity", "style.tabs"]
    assert rules(view.findings(exclude_tags=["style", "ros"])) == ["manifest.cycle"]
    assert rules(view.findings(tags=parse_tags("not style and not dependencies"))) == ["ros.cyclomatic_complexity"]
    assert rules(view.findings(tags=parse_tags("metrics"), exclude_tags=["ros"])) == []
    assert rules(view.findings(limit=1)) == ["ros.cyclomatic_complexity"]
    assert rules(view.findings(limit=5, offset=1)) == ["style.tabs", "manifest.cycle"]
    assert rules(view.findings(offset=2)) == ["manifest.cycle"]


def test_findings_are_counted_as_they_are_listed(view):
    for conditions in (
        {},
        {"package": "drive"},
        {"package": ""},
        {"rule": "style.tabs"},
        {"path": DRIVE},
        {"severity": Severity.NOTE},
        {"include_tags": ["ros", "style"]},
        {"exclude_tags": ["ros"]},
        {"tags": parse_tags("ros or style"), "package": "arm"},
    ):
        assert view.count_findings(**conditions) == len(list(view.findings(**conditions))), conditions


def test_failures(view, sample):
    assert view.failures() == (*sample.drive().failures, *sample.workspace().failures)
    assert view.failures(package="drive") == sample.drive().failures
    assert view.failures(package="arm") == ()


def test_values_of_a_quantity(view, sample):
    function = sample.drive().entities[3].id
    assert view.values_of("cyclomatic_complexity", EntityKind.FUNCTION) == [(function, "drive", 17)]
    assert view.values_of("loc", EntityKind.PACKAGE) == [("package:arm", "arm", 0), ("package:drive", "drive", 52)]
    assert view.values_of("dependents", EntityKind.PACKAGE) == [
        ("package:arm", "arm", 1),
        ("package:drive", "drive", 0),
    ]
    assert view.values_of("cyclomatic_complexity", EntityKind.PACKAGE) == [("package:drive", "drive", 8.75)]
    assert view.values_of("loc", EntityKind.CLASS) == []
    assert view.values_of("no such", EntityKind.FUNCTION) == []
    assert view.numbers_of("loc", EntityKind.PACKAGE) == [0, 52]


def test_what_was_measured(view):
    assert view.measured() == ("cyclomatic_complexity", "dependents", "loc")
    assert view.measured(EntityKind.PACKAGE) == ("cyclomatic_complexity", "dependents", "loc")
    assert view.measured(EntityKind.FILE) == ("loc",)
    assert view.measured(EntityKind.CLASS) == ()


def test_extremes_of_a_quantity(tmp_path, sample):
    with Store.open(None) as store:
        header = sample.header()
        with store.writing(header) as writer:
            for key, result in sample.large(3, entities=40, files=4):
                writer.add(key, result)
            writer.complete(WorkspaceResult(), header)
        view = store.view()
        all_values = view.values_of("quantity_03", EntityKind.FUNCTION)
        assert len(all_values) == 3 * 35
        for highest in (True, False):
            expected = sorted(all_values, key=lambda item: -item[2] if highest else item[2])[:7]
            found = view.extremes_of("quantity_03", EntityKind.FUNCTION, 7, highest=highest)
            assert [(entity.id, package, value) for entity, package, value in found] == expected
            assert all(entity.values["quantity_03"] == value for entity, _package, value in found)
        assert view.extremes_of("no such", EntityKind.FUNCTION) == []
        assert view.extremes_of("quantity_03", EntityKind.FUNCTION, 0) == []


def test_what_is_outside_packages_comes_last(tmp_path, sample):
    arm = sample.arm()
    names = ["zeta", OUTSIDE_PACKAGES, "alpha", "alpha@src/b"]
    with Store.open(None) as store:
        header = sample.header()
        with store.writing(header) as writer:
            for name in names:
                package = type(arm.package)(name, name, "src", arm.package.manifest)
                writer.add("key-" + name, type(arm)(package))
            writer.complete(WorkspaceResult(), header)
        assert [package.id for package in store.view().packages()] == [
            "alpha",
            "alpha@src/b",
            "zeta",
            OUTSIDE_PACKAGES,
        ]


def test_findings_are_kept_in_order_of_their_places(sample):
    drive = sample.drive()
    shuffled = type(drive)(drive.package, findings=tuple(reversed(drive.findings)))
    with Store.open(None) as store:
        header = sample.header()
        with store.writing(header) as writer:
            writer.add("key", shuffled)
            writer.complete(WorkspaceResult(), header)
        assert tuple(store.view().findings()) == drive.findings


def test_several_threads_read_one_store(tmp_path, sample):
    with Store.open(tmp_path / "store.sqlite") as store:
        header = sample.header()
        with store.writing(header) as writer:
            for key, result in sample.large(8):
                writer.add(key, result)
            writer.complete(WorkspaceResult(), header)
        view = store.view()

        def ask(number):
            package = f"package_{number % 8:04d}"
            return (
                len(view.packages()),
                len(list(view.entities(package=package))),
                view.count_findings(package=package),
                len(view.values_of("quantity_01", EntityKind.FUNCTION)),
            )

        with ThreadPoolExecutor(4) as pool:
            assert set(pool.map(ask, range(64))) == {(8, 160, 106, 8 * 137)}


def test_the_tables_speak_the_words_of_the_report(view):
    ask = view._run._readers._main.execute
    assert ask("SELECT id, version, dependencies FROM packages WHERE run = 1 ORDER BY id").fetchall() == [
        ("arm", "0.1.0", "[]"),
        ("drive", "1.2.3", '["arm","roscpp"]'),
    ]
    assert ask("SELECT count(*) FROM files WHERE package = 'drive'").fetchone() == (3,)
    assert ask("SELECT name FROM entities WHERE kind = 'function'").fetchall() == [("drive::Drive::update",)]
    assert ask(
        "SELECT entity, quantity, value FROM measurements WHERE run = 1 ORDER BY entity, quantity"
    ).fetchall() == [
        ("file:src/drive/src/drive.cpp", "loc", 40),
        (
            "function:src/drive/src/drive.cpp#drive::Drive::update(const Twist &)",
            "cyclomatic_complexity",
            17,
        ),
        ("function:src/drive/src/drive.cpp#drive::Drive::update(const Twist &)", "loc", 31),
        ("package:arm", "dependents", 1),
        ("package:arm", "loc", 0),
        ("package:drive", "cyclomatic_complexity", 8.75),
        ("package:drive", "dependents", 0),
        ("package:drive", "loc", 52),
    ]
    assert ask("SELECT package, rule, tags FROM findings WHERE gated = 0").fetchall() == [
        ("drive", "style.tabs", '["style"]')
    ]
    assert ask("SELECT path, line, partial FROM failures ORDER BY path").fetchall() == [(None, None, 0), (DRIVE, 44, 1)]
    assert ask("SELECT id, severity FROM rules ORDER BY id").fetchall() == [
        ("manifest.cycle", "error"),
        ("ros.cyclomatic_complexity", "warning"),
        ("style.tabs", "note"),
    ]


def test_those_furthest_beyond_their_bound_come_first_where_asked(sample):
    def finding(line, value=None, bound=None):
        return Finding("r", Severity.NOTE, "m", "src/drive/a.py", line, value=value, bound=bound)

    found = [finding(1), finding(2, 6, 5), finding(3, 20, 5), finding(4, 1, 5), finding(5, 0, 3), finding(6, 7, 0)]
    with Store.open(None) as store:
        with store.writing(sample.header()) as writer:
            writer.add("unit-drive", msgspec.structs.replace(sample.drive(), findings=tuple(found)))
            view = store.view(writer.complete(sample.workspace(), sample.header()))
        lines = [one.line for one in view.findings(package="drive", worst_first=True)]
        assert lines == [6, 4, 3, 5, 2, 1]
        assert lines == [one.line for one in sorted(found, key=lambda one: -one.excess)]
        assert [one.line for one in view.findings(package="drive", limit=2, worst_first=True)] == [6, 4]
        assert [one.line for one in view.findings(package="drive")] == [1, 2, 3, 4, 5, 6]
