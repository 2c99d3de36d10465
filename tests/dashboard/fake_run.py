"""A run as a real workspace gives it, made up from a seed: packages in tiers, C++ sources, findings that fit them."""

from __future__ import annotations

import atexit
import importlib.util
import random
import statistics
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType

import msgspec

from roslens.dashboard.site import Site
from roslens.dashboard.sources.source_text import blob_id
from roslens.judge.quality.fold import fold_parts, fold_steps
from roslens.judge.quality.quality_model import load_model, rules_of
from roslens.judge.quality.thresholds import judge_entities
from roslens.model.entity import Entity, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity, fingerprint
from roslens.model.result import PackageResult, RunHeader, WorkspaceResult
from roslens.model.source import Dependency, Language, License, Location, Package, Person, Role, SourceFile
from roslens.source.metrics.table import QUANTITIES
from roslens.store.runs import Store

MODELS = ("ros",)
COMPARED = ("ros", "his", "kth", "nasa-satc", "akureyri", "verifysoft", "microsoft")

_TO_FILE = fold_steps(QUANTITIES.values(), EntityKind.FILE)
_TO_PACKAGE = fold_steps(QUANTITIES.values(), EntityKind.PACKAGE)

NAMES = [
    "msgs",
    "common",
    "util",
    "core",
    "lifecycle_manager",
    "map_server",
    "costmap_2d",
    "voxel_grid",
    "amcl",
    "planner",
    "controller",
    "smoother",
    "behaviors",
    "bt_navigator",
    "behavior_tree",
    "navfn_planner",
    "smac_planner",
    "theta_star_planner",
    "dwb_core",
    "dwb_critics",
    "dwb_plugins",
    "dwb_msgs",
    "regulated_pure_pursuit_controller",
    "mppi_controller",
    "rotation_shim_controller",
    "graceful_controller",
    "waypoint_follower",
    "velocity_smoother",
    "collision_monitor",
    "constrained_smoother",
    "simple_commander",
    "route",
    "docking",
    "rviz_plugins",
    "loopback_sim",
    "bringup",
    "system_tests",
    "navigation",
]

RULES = (
    RuleInfo(
        "cpp.using_namespace_in_header",
        "using namespace in a header",
        "A header that opens a namespace opens it for everyone who includes it.",
        Severity.ERROR,
        ("cpp", "headers", "google", "hicpp"),
        "Names of two libraries clash far from the line that is to blame. Name what you use instead.",
        "native",
        ("cpp",),
    ),
    RuleInfo(
        "cpp.explicit_constructor",
        "Constructor with one argument is not explicit",
        "A constructor that takes one argument converts silently.",
        Severity.WARNING,
        ("cpp", "classes", "google"),
        "A function gets an object that nobody made on purpose.",
        "native",
        ("cpp",),
    ),
    RuleInfo(
        "style.line_length",
        "Line longer than 100 characters",
        "ROS 2 style asks for at most 100 characters a line.",
        Severity.NOTE,
        ("style", "formatting", "ros"),
        "Two files beside each other fit on a screen.",
        "native",
    ),
    RuleInfo(
        "style.todo_without_owner",
        "Note of unfinished work without a name",
        "A note of unfinished work says whom to ask.",
        Severity.NOTE,
        ("style", "comments", "google"),
        "",
        "native",
    ),
    RuleInfo(
        "ros.raw_printf",
        "printf in a node",
        "Output that bypasses the logger reaches neither /rosout nor a log file.",
        Severity.WARNING,
        ("ros", "logging"),
        "Use RCLCPP_INFO and its relatives.",
        "native",
        ("cpp",),
    ),
    RuleInfo(
        "ros.undeclared_dependency",
        "Used but not declared in package.xml",
        "A package is included whose name package.xml does not mention.",
        Severity.ERROR,
        ("ros", "manifest", "dependencies"),
        "It builds here and breaks on the build farm.",
        "native",
        scope="package",
    ),
    RuleInfo("cppcheck.unusedVariable", "Unused variable", "", Severity.NOTE, ("cpp", "cppcheck"), "", "cppcheck"),
    RuleInfo("never.broken", "A rule that nothing breaks", "It is there to show zero.", tags=("style",)),
)

VERBS = [
    "update",
    "compute",
    "plan",
    "get",
    "set",
    "on",
    "handle",
    "reset",
    "make",
    "transform",
    "publish",
    "declare",
    "validate",
    "activate",
    "configure",
]
NOUNS = [
    "costmap",
    "path",
    "goal",
    "pose",
    "plan",
    "footprint",
    "layer",
    "bounds",
    "scan",
    "map",
    "parameters",
    "state",
    "velocity",
    "feedback",
    "request",
]


class _Writer:
    """Collects lines of C++ and remembers where functions stand."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def add(self, *lines: str) -> None:
        self.lines += lines


def _function(writer: _Writer, chance: random.Random, owner: str) -> tuple[str, int, int, dict[str, float]]:
    name = f"{chance.choice(VERBS)}{chance.choice(NOUNS).capitalize()}"
    depth = min(6, int(chance.expovariate(0.9)))
    statements = 2 + int(chance.expovariate(0.09))
    start = len(writer.lines) + 1
    writer.add(f"void {owner}::{name}(const std::string & frame, double tolerance)", "{")
    complexity, calls, indent = 1, 0, 1
    for number in range(statements):
        pad = "  " * indent
        kind = chance.random()
        if kind < 0.22 and indent <= depth:
            writer.add(f"{pad}if (tolerance > {number}.5 && !frame.empty()) {{")
            complexity += 2
            indent += 1
        elif kind < 0.3 and indent <= depth:
            writer.add(f"{pad}for (unsigned int i = 0; i < size_x_; ++i) {{")
            complexity += 1
            indent += 1
        elif kind < 0.4 and indent > 1:
            indent -= 1
            writer.add("  " * indent + "}")
        elif kind < 0.5:
            writer.add(f"{pad}// Cells that were never seen keep the value of {chance.choice(NOUNS)}.")
        else:
            verb, noun = chance.choice(VERBS), chance.choice(NOUNS)
            writer.add(f"{pad}{noun}_ = {verb}{noun.capitalize()}(frame, {number} * tolerance);")
            calls += 1
    while indent > 1:
        indent -= 1
        writer.add("  " * indent + "}")
    writer.add("}", "")
    end = len(writer.lines) - 1
    values = {
        "physical_lines": float(end - start + 1),
        "loc": float(end - start),
        "eloc": float(statements),
        "cyclomatic_complexity": float(complexity),
        "cognitive_complexity": float(int(complexity * 1.3)),
        "nesting": float(depth),
        "parameters": float(chance.choice((0, 1, 2, 2, 3, 4, 7))),
        "calls": float(calls),
        "static_paths": float(2 ** min(12, complexity - 1)),
        "maintainability_index": max(5.0, 120 - 6 * complexity - statements / 2),
    }
    return f"{name}(const std::string &, double)", start, end, values


def _made_up_configurations() -> ModuleType:
    path = Path(__file__).with_name("made_up_configurations.py")
    spec = importlib.util.spec_from_file_location("made_up_configurations", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class FakeRun:
    """Packages, sources and the store that holds the run. The same arguments give the same run.

    Args:
        packages: how many.
        findings: about how many findings besides those of the quality model; they are added evenly.
        sources: whether files have text that can be read.
        prefix: of the names of packages.
    """

    def __init__(self, packages: int = 38, findings: int = 0, *, sources: bool = True, seed: int = 7) -> None:
        self.sources: dict[str, bytes] = {}
        self._chance = random.Random(seed)
        self._with_sources = sources
        self._models = tuple(load_model(name, QUANTITIES) for name in MODELS)
        self._names = [
            f"nav2_{NAMES[n % len(NAMES)]}" + (f"_{n // len(NAMES)}" if n >= len(NAMES) else "")
            for n in range(packages)
        ]
        self._extra = findings // max(1, packages)
        self.store = Store.open(None)
        # Sites outlive the run they are of; Python 3.13 warns of a database that nobody closes.
        atexit.register(self.store.close)
        made_up = _made_up_configurations()
        self.configurations = {"rover": made_up.large() if packages > 100 else made_up.robot()}
        self.about = {"rover": made_up.robot_findings()}
        self._write()

    def site(self, read: bool = True) -> Site:
        """Return the site of the run, as the command line makes it."""
        models = tuple(load_model(name, QUANTITIES) for name in COMPARED)
        return Site(
            self.store.view(),
            quantities=QUANTITIES,
            models=models,
            read_source=self.sources.get if read else lambda _: None,
            configurations=self.configurations,
            about=self.about,
        )

    def _write(self) -> None:
        header = RunHeader(
            key="fake",
            root="/home/user/navigation_ws/src",
            paths=("/home/user/navigation_ws/src",),
            started="2026-03-04T09:30:00+00:00",
            seconds=12.4,
            commit="8f2c1a94d0b7",
            tools={"roslens": "0.1.0", "cppcheck": "2.10"},
            models=MODELS,
        )
        results = [self._package(number) for number in range(len(self._names))]
        values = self._graph_values(results)
        with self.store.writing(header) as writer:
            for result in results:
                writer.add(result.package.id, result)
            workspace = WorkspaceResult(
                package_values=values,
                findings=(
                    Finding(
                        "ros.undeclared_dependency",
                        Severity.ERROR,
                        "nav2_util is included by 3 packages that do not declare it",
                        tags=("ros", "manifest", "dependencies"),
                        tool="native",
                        fingerprint="workspace0000001",
                    ),
                ),
                failures=(
                    Failure(
                        "cppcheck",
                        "cppcheck stopped after 60 s",
                        "an answer within the time limit",
                        "Raise time_limit_s in roslens.toml, or disable cppcheck",
                        detail="Traceback (most recent call last):\n  <cppcheck> & more\n",
                    ),
                ),
                rules=(*RULES, *(rule for model in self._models for rule in rules_of(model))),
                quantities=tuple(QUANTITIES.values()),
            )
            writer.complete(workspace, header)

    def _graph_values(self, results: list[PackageResult]) -> dict[str, dict[str, float]]:
        needs = {result.package.id: {need.name for need in result.package.dependencies} for result in results}
        return {
            package: {
                "dependencies": float(len(found & needs.keys())),
                "dependents": float(sum(package in other for other in needs.values())),
            }
            for package, found in needs.items()
        }

    def _package(self, number: int) -> PackageResult:
        chance, name = self._chance, self._names[number]
        needs: set[str] = set()
        if number:
            for _ in range(chance.choice((1, 2, 2, 3, 4))):
                needs.add(self._names[int(chance.random() ** 2 * min(number, 60))])
        if number % 19 == 17:
            needs = set()
        if name == "nav2_common":
            needs.add("nav2_util")
        location = Location(f"{name}/package.xml", 3, 9)
        package = Package(
            id=name,
            name=name,
            path=name,
            manifest=location,
            format=3,
            version="1.4.0",
            build_type="ament_python" if "commander" in name or "sim" in name else "ament_cmake",
            description=f"The {name.removeprefix('nav2_').replace('_', ' ')} of the navigation stack.",
            metapackage=name == "nav2_navigation",
            dependencies=tuple(
                Dependency(need, "depend", location) for need in (*sorted(needs), "rclcpp", "std_msgs", "tf2_ros")
            ),
            maintainers=(Person("A. Maintainer", "a@example.org"),),
            licenses=(License("Apache-2.0"),),
        )
        if package.metapackage or name.endswith("msgs"):
            return PackageResult(package, entities=(Entity(f"package:{name}", EntityKind.PACKAGE, name, name),))
        size = 1 + int(chance.expovariate(0.4)) if self._with_sources else 2
        files, parts, findings = [], [], []
        for index in range(size):
            self._file(package, index, files, parts, findings)
        for extra in range(max(0, self._extra - len(findings))):
            file = files[extra % len(files)]
            findings.append(self._finding(RULES[2 + extra % 5], file.path, 1 + extra, f"occurrence {extra}"))
        package_values = dict(fold_parts(_TO_PACKAGE, parts))
        package_values["comment_ratio"] = round(statistics.fmean([8, 31, chance.uniform(2, 45)]), 2)
        package_values["maintainability_index"] = round(chance.uniform(20, 95), 2)
        own = Entity(f"package:{name}", EntityKind.PACKAGE, name, name, values=package_values)
        findings += judge_entities(self._models, parts)
        aside = {file.path for file in files if file.role is not Role.OWN}
        findings = [msgspec.structs.replace(one, gated=one.path not in aside) for one in findings]
        failures = ()
        if number % 9 == 4:
            failures = (
                Failure(
                    "syntax",
                    "'EXPORT_CLASS(' without its end",
                    "a declaration",
                    "Add the macro to macros.blank in roslens.toml",
                    Location(files[0].path, 12, 3),
                    package=name,
                    partial=True,
                ),
            )
        return PackageResult(package, tuple(files), (own, *parts), tuple(findings), failures)

    def _file(
        self,
        package: Package,
        index: int,
        files: list[SourceFile],
        parts: list[Entity],
        findings: list[Finding],
    ) -> None:
        chance = self._chance
        stem = f"{chance.choice(NOUNS)}_{chance.choice(VERBS)}_{index}"
        role = Role.TEST if index and index % 4 == 3 else Role.OWN
        path = f"{package.path}/{'test' if role is Role.TEST else 'src'}/{stem}.cpp"
        owner = f"{package.name}::{stem.title().replace('_', '')}"
        writer = _Writer()
        writer.add(
            "// Copyright (c) 2026",
            f'#include "{package.name}/{stem}.hpp"',
            "#include <string>",
            "",
            f"namespace {package.name}",
            "{",
            "",
        )
        functions = []
        for _ in range(3 + int(chance.expovariate(0.2)) if self._with_sources else 4):
            name, line, end, values = _function(writer, chance, owner.rpartition("::")[2])
            if any(known[0] == name for known in functions):
                name += "~2"
            functions.append((name, line, end, values))
        writer.add(f"}}  // namespace {package.name}  <script>alert('x')</script>")
        content = ("\n".join(writer.lines) + "\n").encode()
        if self._with_sources:
            self.sources[path] = content
        files.append(SourceFile(path, Language.CPP, role, len(content), blob_id(content)))
        file_id = f"file:{path}"
        loc = float(sum(1 for line in writer.lines if line.strip() and "//" not in line))
        comments = float(sum(1 for line in writer.lines if "//" in line))
        inside = [
            Entity(
                f"function:{path}#{owner}::{name}",
                EntityKind.FUNCTION,
                f"{owner}::{name}",
                path,
                line,
                end,
                file_id,
                values=values,
            )
            for name, line, end, values in functions
        ]
        methods = float(len(inside))
        inside.append(
            Entity(
                f"class:{path}#{owner}",
                EntityKind.CLASS,
                owner,
                path,
                5,
                len(writer.lines),
                file_id,
                values={
                    "wmc": sum(entity.values["cyclomatic_complexity"] for entity in inside),
                    "mac": methods,
                    "cbo": float(chance.choice((0, 1, 2, 3, 5, 8))),
                    "dit": float(chance.choice((0, 1, 1, 2))),
                },
            )
        )
        values = {
            "physical_lines": float(len(writer.lines)),
            "loc": loc,
            "comment_lines": comments,
            "blank_lines": len(writer.lines) - loc - comments,
            "comment_ratio": round(100 * comments / (loc + comments), 2),
            "maintainability_index": round(chance.uniform(15, 95), 2),
            **{
                key: value
                for key, value in fold_parts(_TO_FILE, inside).items()
                if key.startswith(("cyclomatic", "cognitive"))
            },
        }
        name = path.rpartition("/")[2]
        parts += [Entity(file_id, EntityKind.FILE, name, path, parent=f"package:{package.id}", values=values), *inside]
        for line, text in enumerate(writer.lines, 1):
            if "unseen" in text or ("never seen" in text and chance.random() < 0.3):
                findings.append(self._finding(RULES[3], path, line, "a note without a name", text, role))
            elif "for (" in text and chance.random() < 0.25:
                findings.append(
                    self._finding(RULES[6], path, line, "variable 'i' is assigned but <never> used", text, role)
                )
            elif "_ = " in text and chance.random() < 0.02:
                findings.append(self._finding(RULES[chance.choice((1, 4))], path, line, "see the rule", text, role))
        if chance.random() < 0.2:
            findings.append(self._finding(RULES[0], path, 5, "`using namespace std;` in a header & more", "", role))

    def _finding(
        self, rule: RuleInfo, path: str, line: int, message: str, context: str = "", role: Role = Role.OWN
    ) -> Finding:
        return Finding(
            rule.id,
            rule.severity,
            message,
            path,
            line,
            3,
            entity=f"file:{path}",
            tags=rule.tags,
            tool=rule.tool,
            fingerprint=fingerprint(rule.id, path, context or message, line),
            gated=role is Role.OWN,
        )


def counts_of(run: FakeRun) -> Mapping[str, int]:
    """Return how much the run holds, for messages of tests."""
    stored = run.store.runs()[0]
    return {"packages": stored.packages, "files": stored.files, "findings": stored.findings}
