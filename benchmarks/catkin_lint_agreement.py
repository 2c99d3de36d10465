"""Compares native rules on packages of ROS 1 with catkin_lint: ``python benchmarks/catkin_lint_agreement.py FOLDER…``.

Each folder is a clone. What catkin_lint reports is set against what ``roslens check`` reports with the rules of the
table below, by package and by the name that both are about (a dependency, a target, a file), else by package. The page
is written to ``docs/accuracy_of_rules_against_catkin_lint.md``; what only one of the two reports was read
(``--examples``).
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterable
from pathlib import Path
from xml.etree.ElementTree import fromstring

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "docs" / "accuracy_of_rules_against_catkin_lint.md"
TOPICS: dict[str, tuple[tuple[str, ...], tuple[str, ...], str]] = {
    "a package is used and not declared": (
        ("MISSING_DEPEND", "LAUNCH_DEPEND"),
        ("package.undeclared_dependency", "package.dependency_kind"),
        (
            "Only catkin_lint: dependencies of packages for tests, and for those who build on the package. Only "
            "roslens: imports of Python and includes of C++, which catkin_lint does not read, and system "
            "libraries such as BZip2."
        ),
    ),
    "a declared package is not used": (
        ("UNCONFIGURED_BUILD_DEPEND",),
        ("package.unused_dependency",),
        (
            "Only catkin_lint: declared for the build and not looked for by CMake, but included: the rule counts that "
            "as use. Only roslens: looked for and used nowhere."
        ),
    ),
    "what exported headers need is not exported": (
        ("MISSING_CATKIN_DEPEND",),
        ("cmake.catkin_depends", "cmake.exported_dependency"),
        (
            "Only catkin_lint: packages of programs and tests, which export no header. The rules ask where an "
            "installed header includes it, and find that of others."
        ),
    ),
    "a program, library or header is not installed": (
        ("UNINSTALLED_SCRIPT", "UNINSTALLED_TARGET", "UNINSTALLED_INCLUDE_PATH", "UNINSTALLED_EXPORT_LIB"),
        ("cmake.program_not_installed", "cmake.library_not_installed", "cmake.header_not_installed"),
        "Only catkin_lint: scripts and launch files that can be executed. The rules ask for what CMake builds.",
    ),
    "a file that CMake names does not exist": (
        ("MISSING_FILE", "MISSING_DIRECTORY"),
        ("cmake.missing_source",),
        "Only catkin_lint: folders to include and to install; the rule asks for sources of targets.",
    ),
    "a test is built without asking for tests": (("UNGUARDED_TEST_CMD",), ("cmake.unguarded_test",), ""),
    "a needed package is looked for as if it were optional": (
        ("MISSING_REQUIRED",),
        ("cmake.optional_package",),
        "Only catkin_lint: catkin itself, and rostest or rosunit for tests.",
    ),
    "CMake is too old": (
        ("CMAKE_ANCIENT",),
        ("cmake.minimum_version",),
        "Only catkin_lint: 2.8.3. The rule asks packages for ROS 2, whose systems have CMake 4.",
    ),
    "a script cannot be started": (
        ("MISSING_SHEBANG",),
        ("package.program_shebang",),
        "The same script: one names the file, the other its first line.",
    ),
    "the description is that of the template": (
        ("DESCRIPTION_BOILERPLATE", "DESCRIPTION_MEANINGLESS"),
        ("package.boilerplate",),
        (
            "Only catkin_lint: how a description begins (`A set of`, `This package`); the rule asks for that of the "
            "template."
        ),
    ),
}
"""What is compared: what both are about, the ids of each, and why they differ."""

Place = tuple[str, str]


def of_catkin_lint(folder: Path, command: str) -> tuple[dict[str, set[Place]], Counter[str], str]:
    """Return the places of each message, how often each is said, and the version."""
    run = subprocess.run(
        [command, "--offline", "-W2", "--output", "xml", str(folder)], capture_output=True, text=True, check=False
    )
    root = fromstring(run.stdout)
    found: dict[str, set[Place]] = defaultdict(set)
    said: Counter[str] = Counter()
    for one in root:
        name, text = one.findtext("id") or "", one.findtext("text") or ""
        found[name].add((one.findtext("location/package") or "", subject(text)))
        said[name] += 1
    return found, said, root.get("version", "")


def of_roslens(folder: Path, rules: Iterable[str]) -> dict[str, set[Place]]:
    """Return the places of each rule."""
    with tempfile.TemporaryDirectory() as scratch:
        settings, result = Path(scratch, "roslens.toml"), Path(scratch, "run.json")
        named = ", ".join(f'"{one}"' for one in rules)
        settings.write_text(f"[rules]\nprofiles = []\nenable = [{named}]\n")
        program = str(Path(sys.executable).with_name("roslens"))
        command = [program, "check", str(folder), "--config", str(settings), "--no-store", "--no-cache", "--no-graph"]
        command += ["-q", "--fail-on", "never", "--format", "json", "-o", str(result)]
        subprocess.run(command, check=False, capture_output=True)
        run = json.loads(result.read_text())
    packages = sorted(
        ((one["path"].strip("/").removeprefix("."), one["name"]) for one in run["packages"]), reverse=True
    )
    found: dict[str, set[Place]] = defaultdict(set)
    for one in run["findings"]:
        owner = next((name for path, name in packages if f"{one['path']}/".startswith(f"{path}/" if path else "")), "")
        names = quoted(one["message"])
        for name in names or [""]:
            found[one["rule"]].add((owner, name))
    return found


def quoted(text: str) -> list[str]:
    """Return what a message of roslens is about: the texts between apostrophes, those of files without their folder."""
    return [one.rpartition("/")[2] for one in re.findall(r"'([^']+)'", text.partition("; expected")[0])]


def subject(text: str) -> str:
    """Return what a message of catkin_lint is about."""
    if searched := re.match(r"find_package\((\S+)\)", text):
        return searched[1]
    return "" if text.startswith("package description") else next(iter(quoted(text)), "")


def compare(theirs: set[Place], ours: set[Place]) -> tuple[int, int, int]:
    """Return how many places both name, only catkin_lint, only roslens; without a name the package decides."""
    packages = {package for package, _ in ours}
    both = {one for one in theirs if one in ours or (not one[1] and one[0] in packages)}
    met = {package for package, name in both if not name}
    return len(both), len(theirs - both), len({one for one in ours if one not in both and one[0] not in met})


def main() -> int:
    """Compare over all folders and write the page."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("folders", nargs="+", type=Path)
    options.add_argument("--catkin-lint", default="catkin_lint", help="command")
    options.add_argument("--examples", action="store_true", help="print what only one of the two reports")
    given = options.parse_args()
    rules = sorted({one for _, ids, _ in TOPICS.values() for one in ids})
    total: dict[str, Counter[str]] = defaultdict(Counter)
    said: Counter[str] = Counter()
    version = ""
    for folder in given.folders:
        theirs, here, version = of_catkin_lint(folder, given.catkin_lint)
        ours = of_roslens(folder, rules)
        said += here
        for topic, (ids, names, _) in TOPICS.items():
            there = {one for each in ids for one in theirs[each]}
            found = {one for each in names for one in ours[each]}
            both, lost, new = compare(there, found)
            total[topic].update(both=both, theirs=lost, ours=new)
            if given.examples:
                for name, places in (("catkin_lint", there - found), ("roslens", found - there)):
                    for place in sorted(places)[:6]:
                        print(f"{topic}: only {name}: {folder.name} {place}")
    PAGE.write_text(page([one.name for one in given.folders], version, total, said))
    print(PAGE)
    return 0


def page(names: list[str], version: str, total: dict[str, Counter[str]], said: Counter[str]) -> str:
    """Return the page."""
    folders = ", ".join(f"`{one.replace('+', '/')}`" for one in names)
    compared = {one for ids, _, _ in TOPICS.values() for one in ids}
    rest = ", ".join(f"`{name}` ({count})" for name, count in sorted(said.items()) if name not in compared)
    rows = ""
    for topic, (ids, rules, why) in TOPICS.items():
        count = total[topic]
        theirs, ours = ", ".join(f"`{one.lower()}`" for one in ids), ", ".join(f"`{one}`" for one in rules)
        rows += f"| {topic} ({theirs}; {ours}) | {count['both']} | {count['theirs']} | {count['ours']} | {why} |\n"
    return f"""\
# Native rules against catkin_lint and the linters of ament

Cloned repositories: {folders}.
What catkin_lint {version} says of their packages of ROS 1 (`-W2`), and what the native rules say, by package and the
name that both are about. `python benchmarks/catkin_lint_agreement.py FOLDER…` writes this page; the reasons are judged
by reading what only one of the two reports (`--examples`).

| about | both | only catkin_lint | only roslens | why |
| --- | --: | --: | --: | --- |
{rows}
What catkin_lint says besides and no native rule asks for, because it is a matter of style, or of what a build says
itself: {rest}.

The linters of ament (`ament_copyright`, `ament_flake8`, `ament_lint_cmake`, `ament_pep257`, `ament_xmllint`) look at
the layout of CMake, XML and Python; none of them asks whether a manifest fits what a package does, so that there is
nothing to compare. Most of them are in no wheel that can be installed beside, but in installations of ROS 2, where
roslens calls them as [tools](reference/tools.md).
"""


if __name__ == "__main__":
    sys.exit(main())
