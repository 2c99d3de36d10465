"""One count, everywhere: what the terminal, every page, the CSV tables and the JSON report say of one run adds up."""

from __future__ import annotations

import csv
import io
import json
import re
import shutil
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import pytest

from roslens.cli.graph.site import site_of
from roslens.cli.main import main
from roslens.cli.workplace.workplace import open_store
from roslens.dashboard.routes import PAGES
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Table
from roslens.dashboard.view import Limits, Query, Request, View
from roslens.report.run.fix_first import FURTHEST

EXAMPLE = Path(__file__).parents[2] / "examples/workspace"
MANY_CALLS = "def walk(step):\n" + "".join(f"    step.move_{number}()\n" for number in range(12)) + "    return step\n"
OF_EACH_ROLE = {
    "talk/talk/walking.py": MANY_CALLS,
    "talk/test/test_walking.py": MANY_CALLS,
    "talk/third_party/walking.py": MANY_CALLS,
    "talk/talk/generated/walking.py": MANY_CALLS,
    "talk/test/nodes_under_test.py": MANY_CALLS,
}
FLEET = '<launch><include file="$(find-pkg-share talk)/launch/robot.launch.xml"/></launch>\n'


Write = Callable[[Path], Path]


def example(root: Path, _: Write) -> list[str]:
    """Limits that are warnings."""
    shutil.copytree(EXAMPLE, root, ignore=shutil.ignore_patterns(".roslens"))
    return ["--model", "ros"]


def with_every_role(root: Path, talk: Write) -> list[str]:
    """Graph findings, and findings in own, test, vendored and generated code."""
    talk(root)
    for path, text in OF_EACH_ROLE.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    return ["--graph"]


def of_two_packages(root: Path, talk: Write) -> list[str]:
    """A configuration in one package that starts nodes of another, and files outside of both."""
    talk(root)
    (root / "fleet/launch").mkdir(parents=True)
    (root / "fleet/package.xml").write_text((root / "talk/package.xml").read_text().replace("talk", "fleet"))
    (root / "fleet/launch/fleet.launch.xml").write_text(FLEET)
    (root / "loose").mkdir()
    (root / "loose/walking.py").write_text(MANY_CALLS)
    (root / "roslens.toml").write_text('[graph.configurations.fleet]\nlaunch = "fleet/fleet.launch.xml"\n')
    return ["--model", "ros,his"]


class Run:
    """A checked workspace, and what each way to look at it says."""

    def __init__(self, root: Path, more: list[str]) -> None:
        self._root, self._more = root, more
        self.text = self._checked("--format", "text")
        self.report = json.loads(self._checked("--format", "json"))
        self._checked("--format", "csv", "-o", str(root / "tables"))

    def _checked(self, *options: str) -> str:
        command = ["check", str(self._root), "--jobs", "1", "-q", "--fail-on", "never", *self._more, *options]
        with io.TextIOWrapper(io.BytesIO(), "utf-8") as out:
            with redirect_stdout(out):
                assert main(command) in {0, 3}
            out.seek(0)
            return out.read()

    def table(self, name: str) -> list[dict[str, str]]:
        """Return the rows of a CSV table."""
        text = (self._root / "tables" / f"{name}.csv").read_text(encoding="utf-8")
        return list(csv.DictReader(io.StringIO(text)))


@pytest.fixture(scope="module", params=["example", "with_every_role", "of_two_packages"])
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def run(name: str, tmp_path_factory: pytest.TempPathFactory, talk: Write) -> Run:
    root = tmp_path_factory.mktemp(name) / "workspace"
    return Run(root, globals()[name](root, talk))


@pytest.fixture
def site(run: Run) -> Iterator[Site]:
    with open_store(str(run._root)) as store:
        yield site_of(store.view())


def page(site: Site, name: str, key: str = "", **query: str) -> View:
    found = PAGES[name](
        site, Request(key, query=Query(query.items()), limits=Limits(findings=10_000, per_group=10_000))
    )
    assert found is not None
    return found


def column(table: Table, key: str) -> list[Any]:
    place = [one.key for one in table.columns].index(key)
    return [row[place].value for row in table.rows]


def total(table: Table, key: str) -> int:
    return sum(column(table, key))


def by_severity(findings: list[dict[str, Any]]) -> dict[str, int]:
    return {severity: sum(one["severity"] == severity for one in findings) for severity in ("error", "warning", "note")}


def packages_of(run: Run) -> int:
    return len([one for one in run.report["packages"] if one["id"] != "(outside packages)"])


def test_files_outside_packages_are_no_package_in_any_count(run: Run, site: Site, name: str) -> None:
    packages = packages_of(run)
    # Files outside of packages stand among the findings and nowhere among the packages.
    assert len(run.report["packages"]) == packages
    outside = any(one["package"] == "(outside packages)" for one in run.report["findings"])
    assert outside is (name == "of_two_packages")
    assert f" {packages} package{'s' * (packages != 1)}, " in run.text.splitlines()[0]
    facts = page(site, "overview").facts
    assert facts["counts"]["packages"] == packages
    beside = " and outside of packages" * (name == "of_two_packages")
    assert facts["headline"].endswith(f" of {packages} package{'s' * (packages != 1)}{beside}.")
    assert page(site, "packages").shown["of_all"] == packages
    findings = [one for one in run.report["findings"] if one["package"] != "(outside packages)"]
    owners = {(one["rule"], one["severity"], one["package"]) for one in findings}
    of_rule = Counter((rule, severity) for rule, severity, _ in owners)
    assert all(total.packages == of_rule[total.rule, total.severity.value] for total in site.rule_totals())
    assert page(site, "metric", "loc", kind="package").shown["figures"].n == packages


def test_the_workspaces_hold_what_makes_sums_differ(run: Run, name: str) -> None:
    findings = run.report["findings"]
    graph = [one for one in findings if one["rule"].startswith("graph.")]
    assert graph
    assert all(one["package"] for one in graph)
    role_of = {file["path"]: file["role"] for file in run.report["files"]}
    if name == "with_every_role":
        assert {role_of[one["path"]] for one in findings if one["path"]} == {"own", "test", "generated", "vendored"}
    if name == "of_two_packages":
        assert {one["package"] for one in graph} == {"talk"}
        assert {one["package"] for one in findings} == {"talk", "fleet", "(outside packages)"}


def test_tables_and_report_hold_the_same_findings(run: Run) -> None:
    of_report = Counter((one["rule"], one["package"], one["path"], one["line"]) for one in run.report["findings"])
    of_table = Counter((one["rule"], one["package"], one["path"], int(one["line"])) for one in run.table("findings"))
    assert of_report == of_table
    for package in run.table("packages"):
        of_package = [one for one in run.report["findings"] if one["package"] == package["id"]]
        assert {key: int(package[f"{key}s"]) for key in ("error", "warning", "note")} == by_severity(of_package)


def test_the_terminal_counts_what_counts_for_gates(run: Run) -> None:
    counted = [one for one in run.report["findings"] if one["gated"]]
    reported = re.search(r"^Findings: (.*)$", run.text, re.MULTILINE)
    assert reported
    words = dict(re.findall(r"(\w+?)s? (\d+)", " ".join(reversed(reported[1].replace(",", "").split()))))
    assert {word: int(count) for word, count in words.items()} == {
        word: count for word, count in by_severity(counted).items() if count
    }
    aside = re.search(r"(\d+) more findings? in test, generated or vendored code", run.text)
    assert int(aside[1] if aside else 0) == len(run.report["findings"]) - len(counted)


def test_the_terminal_shows_the_worst_of_each_rule(run: Run, name: str) -> None:
    worst: dict[str, tuple[float, str]] = {}
    number: Counter[str] = Counter()
    alone = {one["severity"] for one in run.report["findings"] if one["gated"]} == {"note"}
    for one in run.report["findings"]:
        counts = one["gated"] and (alone or one["severity"] != "note")
        if counts and "bound" in one:
            excess = one["value"] / (one["bound"] or 1)  # below 1 of what should be more
            worst[one["rule"]] = max(worst.get(one["rule"], (0.0, "")), (excess, one["message"]))
            number[one["rule"]] += 1
    assert worst or name != "example"
    near = [rule for rule, (excess, _) in worst.items() if excess < FURTHEST]
    for rule in worst.keys() - set(near):
        assert worst[rule][1].partition(")")[0] in run.text
    counted = re.findall(r"(\d+) (?:limits? of metrics|notes?) of (\d+) rules?", run.text)
    assert not near or (str(sum(number[rule] for rule in near)), str(len(near))) in counted


def test_the_terminals_packages_add_up(run: Run) -> None:
    head, *lines = next(part for part in run.text.split("\n\n") if part.startswith("  package ")).splitlines()
    severities = [word.removesuffix("s") for word in head.split() if word in {"errors", "warnings", "notes"}]
    found = Counter[str]()
    for line in lines:
        if match := re.match(r"  (\(outside packages\)|\S+)((?: +(?:\d+|·))+)", line):
            for severity, count in zip(severities, match[2].split(), strict=False):
                found[severity] += 0 if count == "·" else int(count)
    counted = by_severity([one for one in run.report["findings"] if one["gated"]])
    assert found == {severity: counted[severity] for severity in severities}


def test_the_overview_adds_up(run: Run, site: Site) -> None:
    findings = run.report["findings"]
    facts = page(site, "overview").facts
    gated = [one for one in findings if one["gated"]]
    assert facts["counts"]["findings"] == len(findings)
    assert facts["counts"]["own"] == len(gated)
    assert facts["counts"]["aside"] == sum(not one["gated"] for one in findings)
    assert facts["severities"] == by_severity(gated)
    words = re.findall(r"(\d+) (error|warning|note)", facts["headline"])
    assert {word: int(count) for count, word in words} == {
        word: count for word, count in by_severity(gated).items() if count
    }
    reported = re.search(r"^Findings: (.*)$", run.text, re.MULTILINE)
    assert reported
    assert facts["headline"].startswith(reported[1] + " in ")
    whole = page(site, "packages").tables[0]
    assert (total(whole, "findings"), total(whole, "aside")) == (len(gated), len(findings) - len(gated))
    assert [total(whole, f"{key}s") for key in ("error", "warning", "note")] == list(by_severity(gated).values())
    worst = page(site, "overview").table("worst")
    assert not worst.cut
    assert (total(worst, "findings"), total(worst, "aside")) == (len(gated), len(findings) - len(gated))


def test_every_package_page_adds_up(run: Run, site: Site) -> None:
    owned = Counter(one["package"] for one in run.report["findings"])
    for package in site.packages:
        facts = page(site, "package", package.id).facts
        of_package = [one for one in run.report["findings"] if one["package"] == package.id]
        own = [one for one in of_package if one["gated"]]
        assert facts["severities"] == by_severity(own)
        assert facts["aside"] == len(of_package) - len(own)
        assert facts["total"] == len(facts["findings"]) == owned[package.id]
        in_files = page(site, "package", package.id).table("files")
        assert total(in_files, "findings") == sum(bool(one["path"]) for one in of_package)
    assert sum(owned.values()) == len(run.report["findings"])


def test_every_file_page_lists_what_its_package_counts(run: Run, site: Site) -> None:
    for package in site.packages:
        files = page(site, "package", package.id).table("files")
        for path, count in zip(column(files, "path"), column(files, "findings"), strict=True):
            assert page(site, "file", path).facts["total"] == count


def test_every_rule_page_adds_up(run: Run, site: Site) -> None:
    broken = Counter(one["rule"] for one in run.report["findings"])
    rules = page(site, "rules").tables[0]
    counted = zip(column(rules, "rule"), column(rules, "findings"), column(rules, "aside"), strict=True)
    assert {rule: own + aside for rule, own, aside in counted} == {rule: broken[rule] for rule in site.rules}
    assert total(rules, "findings") == sum(one["gated"] for one in run.report["findings"])
    for rule in broken:
        view = page(site, "rule", rule)
        packages = view.table("packages")
        assert total(packages, "findings") + total(packages, "aside") == view.facts["total"] == broken[rule]
        assert total(packages, "findings") == sum(one["gated"] for one in run.report["findings"] if one["rule"] == rule)
        assert "(workspace)" not in column(packages, "package")


def test_lists_of_findings_are_as_long_as_the_numbers_that_lead_to_them(run: Run, site: Site) -> None:
    assert page(site, "findings").facts["total"] == len(run.report["findings"])
    for role, gated in (("gated", True), ("aside", False)):
        of_role = [one for one in run.report["findings"] if one["gated"] is gated]
        assert page(site, "findings", role=role).facts["total"] == len(of_role)
        owned = Counter(one["package"] for one in of_role)
        for package, count in owned.items():
            assert page(site, "findings", package=package, role=role).facts["total"] == count
    pairs = Counter((one["package"], one["rule"]) for one in run.report["findings"])
    for (package, rule), count in pairs.items():
        facts = page(site, "findings", package=package, rule=rule).facts
        assert facts["total"] == len(facts["findings"]) == count
        assert {one["package"] for one in facts["findings"]} == {package}


def test_the_graph_and_the_store_count_them_too(run: Run, site: Site) -> None:
    nodes = page(site, "graph").facts["graph"]["nodes"]
    # The picture is of packages: what lies outside of them has no disc.
    inside = [one for one in run.report["findings"] if one["package"] != "(outside packages)"]
    assert sum(count for node in nodes for _, count, _ in node["counts"]) == len(inside)
    gated = sum(gated for node in nodes for _, _, gated in node["counts"])
    assert gated == sum(one["gated"] for one in inside)
    assert total(page(site, "graph").tables[0], "value") == gated
    assert total(page(site, "graph", aside="1").tables[0], "value") == len(inside)
    with open_store(str(run._root)) as store:
        assert store.runs()[0].findings == len(run.report["findings"])
        assert store.runs()[0].packages == packages_of(run)


def test_every_list_says_first_how_many_count_for_gates(run: Run, site: Site) -> None:
    gated = Counter(one["rule"] for one in run.report["findings"] if one["gated"])
    assert page(site, "findings").facts["own"] == gated.total()
    for group in ("file", "function", "rule"):
        assert page(site, "findings", group=group, text=" ").facts["own"] == gated.total()
    assert page(site, "findings", role="aside").facts["own"] == 0
    for rule in site.rules:
        shown = page(site, "rule", rule)
        assert shown.facts["own"] == gated[rule]


def test_each_limit_counts_what_breaks_it_and_others_too(run: Run, site: Site) -> None:
    broken = Counter[str]()
    for one in run.report["findings"]:
        if one["gated"] and one.get("model"):
            broken.update([reason.partition(": ")[0] for reason in one.get("others", ())] or [one["rule"]])
    rules = [
        f"{model.name}.{constraint.id}.{side}"
        for model in site.run_models
        for constraint in model.constraints
        for side in constraint.sides
    ]
    (table,) = [table for table in page(site, "overview").tables if table.name == "conditions"]
    assert [row[-1].value for row in table.rows] == [broken[rule] for rule in rules]
    assert all((row[0].value == "ok") == (row[-1].value == 0) for row in table.rows)
