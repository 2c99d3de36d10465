"""What the tests of all metrics share: facts made by hand, and examples worked out by hand.

An example is a folder ``tests/fixtures/metrics/<key>/`` that is read as one package (files below ``test/`` are its
tests). A line of a comment such as ::

    expect: function Foo::bar = 3   1 + if + for
    expect: class Foo = absent      no method has a body
    expect[lambdas=off]: file = 2
    expect: package.max = 3

says what the metric of that folder must be, and why. An entity is the kind and the qualified name (with ``(types)``
where the name alone is not enough); it is looked for in the file of the line first.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from roslens.model.entity import Entity
from roslens.model.finding import Finding, Severity
from roslens.model.source import Dependency, Language, Location, Package, Role, SourceFile
from roslens.source.measure.analyse_file import analyse_file
from roslens.source.metrics.measure_file import measure_file
from roslens.source.metrics.measure_package import measure_package
from roslens.source.metrics.measure_workspace import measure_workspace
from roslens.source.settings import CountingSettings, MacroSettings
from roslens.source.syntax.facts import Control, FileFacts, FunctionFacts

EXAMPLES = Path(__file__).parents[2] / "fixtures" / "metrics"
LANGUAGES = {".cpp": Language.CPP, ".hpp": Language.CPP, ".c": Language.C, ".h": Language.CPP, ".py": Language.PYTHON}
EXPECTATION = re.compile(
    r"expect(?:\[(?P<options>[^]]*)\])?:\s+(?P<kind>function|class|file|package)(?P<fold>\.\w+)?"
    r"(?:\s+(?P<name>(?!=)\S.*?))?\s+=\s+(?P<value>-?[\d.]+|absent)(?:\s+(?P<working>\S.*))?$"
)
EVENT = re.compile(r"(?P<indent> *)(?P<role>[a-z_]+)(?P<marks>[?#]*)(?: .*)?")


@pytest.fixture(scope="session")
def function_of() -> Callable[..., FunctionFacts]:
    """Facts of a function from its control structure: one event a line, indented by depth.

    ``?`` behind a role says that it stands in the condition of its parent, ``#`` that it is in a later arm of ``#if``.
    """

    def build(control: str = "", **facts: object) -> FunctionFacts:
        events = [EVENT.fullmatch(line) for line in control.splitlines() if line.strip()]
        assert all(events)
        least = min((len(event["indent"]) for event in events), default=0)
        made = tuple(
            Control(
                event["role"],
                (len(event["indent"]) - least) // 2,
                "condition" if "?" in event["marks"] else "body",
                "#" in event["marks"],
            )
            for event in events
        )
        lambdas: list[int] = []
        in_lambda: Counter[str] = Counter()
        for event in made:
            lambdas = [depth for depth in lambdas if depth < event.depth]
            in_lambda.update([event.role] if lambdas else [])
            lambdas += [event.depth] if event.role == "lambda" else []
        given = {
            "name": "f",
            "qualified_name": "f",
            "signature": "()",
            "line": 1,
            "column": 1,
            "end_line": 9,
            "control": made,
            "counts": {**Counter(event.role for event in made)},
            "lambda_counts": {**in_lambda},
            "alternative_counts": {**Counter(event.role for event in made if event.alternative)},
        }
        for counts in ("counts", "lambda_counts", "alternative_counts"):
            given[counts] = {**given[counts], **facts.pop(counts, {})}
        return FunctionFacts(**{**given, **facts})

    return build


def parse(path: Path) -> FileFacts:
    return analyse_file(path.read_bytes(), LANGUAGES[path.suffix], MacroSettings()).facts


def settings_of(options: str | None) -> CountingSettings:
    chosen: dict[str, bool | int] = {}
    for option in (options or "").replace(" ", "").split(","):
        if option:
            name, _, value = option.partition("=")
            chosen[name] = int(value) if value.isdigit() else {"on": True, "off": False}[value]
    return CountingSettings(**chosen)


def measured_example(folder: Path, counting: CountingSettings) -> tuple[Entity, ...]:
    files = []
    for path in sorted(folder.rglob("*")):
        if path.suffix in LANGUAGES:
            relative = path.relative_to(folder).as_posix()
            role = Role.TEST if relative.startswith("test/") else Role.OWN
            facts = parse(path)
            source = SourceFile(relative, LANGUAGES[path.suffix], role)
            files.append((source, facts, measure_file(relative, facts, counting)))
    package = Package(id="example", name="example", path=".", manifest=Location("package.xml", 1))
    return measure_package(package, files, counting)


@pytest.fixture(scope="session")
def measure_example() -> Callable[..., tuple[Entity, ...]]:
    """The entities of the example of a key."""

    def measure(key: str, counting: CountingSettings | None = None) -> tuple[Entity, ...]:
        return measured_example(EXAMPLES / key, counting or CountingSettings())

    return measure


@pytest.fixture(scope="session")
def check_example() -> Callable[[str], None]:
    """Hold every expectation in the example of a key against what is measured."""

    def check(key: str) -> None:
        folder = EXAMPLES / key
        seen = 0
        by_options: dict[str | None, tuple[Entity, ...]] = {}
        for path in sorted(folder.rglob("*")):
            if path.suffix not in LANGUAGES:
                continue
            for number, line in enumerate(path.read_text("utf-8").splitlines(), 1):
                match = EXPECTATION.search(line.rstrip().removesuffix("*/").rstrip())
                assert match or "expect:" not in line, f"{path}:{number}: cannot read {line.strip()!r}"
                if not match:
                    continue
                seen += 1
                options = match["options"]
                if options not in by_options:
                    by_options[options] = measured_example(folder, settings_of(options))
                place = f"{path.relative_to(EXAMPLES)}:{number}: {match[0]}"
                entity = found(by_options[options], match, path.relative_to(folder).as_posix(), place)
                value = entity.values.get(key + (match["fold"] or ""))
                if match["value"] == "absent":
                    assert value is None, place
                else:
                    decimals = len(match["value"].partition(".")[2])
                    assert value is not None, place
                    assert round(value, decimals) == float(match["value"]), f"{place}: measured {value}"
        assert seen, f"no expectation in {folder}"

    return check


def found(entities: tuple[Entity, ...], match: re.Match[str], path: str, place: str) -> Entity:
    of_kind = [entity for entity in entities if entity.kind.value == match["kind"]]
    name = match["name"]
    if match["kind"] == "file":
        of_kind = [entity for entity in of_kind if entity.path == (name or path)]
    elif name:
        of_kind = [entity for entity in of_kind if name in (entity.name, entity.id.partition("#")[2])]
        of_kind = [entity for entity in of_kind if entity.path == path] or of_kind
    assert len(of_kind) == 1, f"{place}: {[entity.id for entity in of_kind]}"
    return of_kind[0]


PACKAGE = re.compile(r"(?P<name>\w+)(?:\((?P<group>\w+)\))?:(?P<dependencies>.*)")
NUMBER = re.compile(r"# expect: (?:(?P<name>\w+) = )?(?P<value>\d+)(?:\s+\S.*)?")


def dependency(written: str) -> Dependency:
    kind, _, name = written.removeprefix("-").rpartition("/")
    return Dependency(name, kind or "depend", Location("package.xml", 2), active=not written.startswith("-"))


@pytest.fixture(scope="session")
def package_of() -> Callable[..., Package]:
    """A package from ``name: dependency kind/dependency -kind/inactive``, with ``name(group)`` for a member."""

    def build(line: str) -> Package:
        match = PACKAGE.fullmatch(line.strip())
        assert match, line
        return Package(
            id=match["name"],
            name=match["name"],
            path=match["name"],
            manifest=Location(f"{match['name']}/package.xml", 1),
            dependencies=tuple(map(dependency, match["dependencies"].split())),
            member_of_groups=(dependency(f"group/{match['group']}"),) if match["group"] else (),
        )

    return build


@pytest.fixture(scope="session")
def check_workspace(package_of) -> Callable[[str], None]:
    """Hold what an example's ``workspace.txt`` expects of each package against what is measured."""

    def check(key: str) -> None:
        lines = (EXAMPLES / key / "workspace.txt").read_text("utf-8").splitlines()
        expected = {match["name"]: float(match["value"]) for line in lines if (match := NUMBER.fullmatch(line))}
        assert len(expected) == sum("expect:" in line for line in lines) > 2
        measured = measure_workspace([package_of(line) for line in lines if line and not line.startswith("#")])
        assert {name: values[key] for name, values in measured.items()} == expected

    return check


@pytest.fixture(scope="session")
def example_findings() -> Callable[[str], tuple[list[Finding], float]]:
    """The findings in an example's ``findings.txt`` and how many of them are expected to count."""

    def read(key: str) -> tuple[list[Finding], float]:
        lines = (EXAMPLES / key / "findings.txt").read_text("utf-8").splitlines()
        expected = NUMBER.fullmatch(lines[0])
        assert expected
        findings = []
        for line in lines[1:]:
            rule, _, model = line.partition(" ")
            findings.append(Finding(rule, Severity.WARNING, "x", model=model.strip().removeprefix("model=")))
        return findings, float(expected["value"])

    return read
