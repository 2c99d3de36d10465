"""Make the field: quantiles of every quantity over ROS packages, and the model of its 90th percentiles.

    python benchmarks/field.py FOLDER          fetch both lists into FOLDER, check them, write field and model
    python benchmarks/field.py FOLDER --kept   of the last runs of FOLDER/ros1 and FOLDER/ros2

Packages count whole; functions, classes and files only where they are a package's own code: no tests, nothing that is
generated or vendored. The repositories and their commits are in benchmarks/corpora/field_*.repos.
"""

from __future__ import annotations

import argparse
import os
import subprocess
from collections.abc import Iterator
from datetime import datetime, timezone
from pathlib import Path

import msgspec
import numpy as np
import yaml

import roslens
from roslens.children.git import git_environment, git_words
from roslens.cli.main import main as roslens_main
from roslens.judge.quality.field import CURRENT, FEWEST, Distribution, Field, FieldRepository
from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity
from roslens.model.result import PackageResult
from roslens.model.source import OUTSIDE_PACKAGES, Role
from roslens.source.study.role import decide, facts_of
from roslens.source.study.run_corpus import language_of
from roslens.store.runs import Store

ROOT = Path(__file__).parents[1]
LISTS = {name: ROOT / "benchmarks" / "corpora" / f"field_{name}.repos" for name in ("ros1", "ros2")}
FIELD = ROOT / "src" / "roslens" / "judge" / "quality" / "fields" / f"{CURRENT}.json"
MODEL = ROOT / "src" / "roslens" / "judge" / "quality" / "models" / f"{CURRENT}.yaml"
STEPS = 40
BOUNDED = (
    ("cyclomatic_complexity", EntityKind.FUNCTION, "complexity"),
    ("cognitive_complexity", EntityKind.FUNCTION, "complexity"),
    ("eloc", EntityKind.FUNCTION, "size"),
    ("nesting", EntityKind.FUNCTION, "complexity"),
    ("parameters", EntityKind.FUNCTION, "interfaces"),
    ("calls", EntityKind.FUNCTION, "coupling"),
    ("static_paths", EntityKind.FUNCTION, "complexity"),
    ("returns", EntityKind.FUNCTION, "complexity"),
    ("cbo", EntityKind.CLASS, "coupling"),
    ("wmc", EntityKind.CLASS, "methods"),
    ("mac", EntityKind.CLASS, "methods"),
    ("dit", EntityKind.CLASS, "inheritance"),
    ("noc", EntityKind.CLASS, "inheritance"),
    ("loc", EntityKind.FILE, "size"),
    ("comment_ratio", EntityKind.FILE, "comments"),
    ("maintainability_index", EntityKind.FILE, "maintainability"),
)
Values = dict[tuple[str, EntityKind, str], list[float]]


def fetch_and_check(folder: Path) -> None:
    """Fetch both lists and check what came."""
    for name, path in LISTS.items():
        into = folder / name
        roslens_main(["fetch", "--distribution", str(path), "--into", str(into)])
        roslens_main(["check", str(into), "--model", "ros", "--tools", "none", "--fail-on", "never", "-q", "-o",
                      str(folder / f"{name}.md")])  # fmt: skip


def values_of(
    result: PackageResult, language: str, generation: str
) -> Iterator[tuple[tuple[str, EntityKind, str], float]]:
    """Yield each value of a package under each group it counts in."""
    own = {file.path for file in result.files if file.role is Role.OWN}
    groups = ["", f"role={decide(facts_of(result)).shown}", f"generation={generation}"]
    groups += [f"language={language}"] if language else []
    for entity in result.entities:
        of_package = entity.kind is EntityKind.PACKAGE
        if of_package or entity.path in own:
            for quantity, value in entity.values.items():
                for group in groups if of_package else groups[:1]:
                    yield (quantity, entity.kind, group), value


def measured(folder: Path) -> tuple[Values, dict[str, Quantity], list[FieldRepository], int]:
    """Return all values of the last runs, the quantities, the repositories and how many packages there are."""
    values: Values = {}
    known: dict[str, Quantity] = {}
    repositories: list[FieldRepository] = []
    packages = 0
    listed = {name: yaml.safe_load(path.read_text())["repositories"] for name, path in LISTS.items()}
    generations = {name: generation for generation, one in listed.items() for name in one}
    for folder_of_list in LISTS:
        with Store.open(folder / folder_of_list / ".roslens" / "store.sqlite") as store:
            view = store.view(None)
            known |= {one.key: one for one in view.quantities()}
            for summary in view.packages():
                result = view.package(summary.id)
                if result is None or summary.id == OUTSIDE_PACKAGES:
                    continue
                packages += 1
                generation = generations[summary.repository]
                for key, value in values_of(result, language_of(summary), generation):
                    values.setdefault(key, []).append(value)
    days = {name: day for one in LISTS for name, day in _days(folder / one).items()}
    for generation, of_list in listed.items():
        repositories += [
            FieldRepository(name, one["url"], one["version"], days[name], generation) for name, one in of_list.items()
        ]
    return values, known, repositories, packages


def _days(folder: Path) -> dict[str, str]:
    days = {}
    for one in folder.iterdir():
        if (one / ".git").exists():
            words = git_words(str(one), "log", "-1", "--format=%cs")
            done = subprocess.run(words, env=git_environment(os.environ), capture_output=True, text=True, check=True)
            days[one.name] = done.stdout.strip()
    return days


def quantiles(values: list[float]) -> tuple[float, ...]:
    """Return evenly spaced quantiles of four significant digits."""
    return tuple(float(f"{value:.4g}") for value in np.quantile(values, np.linspace(0, 1, STEPS + 1)))


def field_of(values: Values, known: dict[str, Quantity], repositories: list[FieldRepository], packages: int) -> Field:
    """Return the field; groups of few values and quantities that depend on who chose models are left out."""
    left_out = {"rqv", "rcv"}
    distributions = tuple(
        Distribution(quantity, kind, len(found), quantiles(found), group)
        for (quantity, kind, group), found in sorted(
            values.items(), key=lambda item: (item[0][0], item[0][1].value, item[0][2])
        )
        if len(found) >= FEWEST and quantity.partition(".")[0] in known and quantity not in left_out
    )
    day = datetime.now(timezone.utc).date().isoformat()
    return Field(CURRENT, day, roslens.__version__, packages, tuple(repositories), distributions)


def model_of(field: Field, known: dict[str, Quantity]) -> str:
    """Return the quality model whose bounds are what nine of ten in the field keep."""
    lines = [
        "kind: quality model",
        f"name: {CURRENT}",
        "title: What nine of ten in the field keep",
        "text: >-",
        "  Bounds are the 90th percentiles (or the 10th, where more is better) over the own code of",
        f"  {field.packages:,} packages of {len(field.repositories)} public repositories of ROS 1 and ROS 2,",
        f"  measured on {field.day}: what is beyond them is unusual, which is no proof that it is bad.",
        "  Made by benchmarks/field.py, not by hand.",
        "source: the field ros-2026 that comes with roslens",
        "constraints:",
    ]
    for quantity, kind, tag in BOUNDED:
        found = field.find(quantity, kind)
        if found is None:
            continue
        better = known[quantity].better
        side, share = ("minimum", 10) if better is Better.HIGHER else ("maximum", 90)
        bound = found.value_at(share)
        lines += [
            f"  - quantity: {quantity}",
            f"    kind: {kind.value}",
            f"    {side}: {bound:g}",
            f"    tags: [{tag}]",
            f"    rationale: Nine of ten {_MANY[kind]} in the field keep it.",
            f"    source: {share}th percentile of {found.n:,} {_MANY[kind]}",
        ]
    return "\n".join(lines) + "\n"


_MANY = {
    EntityKind.FUNCTION: "functions",
    EntityKind.CLASS: "classes",
    EntityKind.FILE: "files",
    EntityKind.PACKAGE: "packages",
}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--kept", action="store_true", help="fetch and check nothing, take the last runs")
    options = parser.parse_args()
    if not options.kept:
        fetch_and_check(options.folder)
    values, known, repositories, packages = measured(options.folder)
    field = field_of(values, known, repositories, packages)
    FIELD.parent.mkdir(exist_ok=True)
    FIELD.write_bytes(msgspec.json.encode(field) + b"\n")
    MODEL.write_text(model_of(field, known))
    print(f"{packages} packages of {len(repositories)} repositories, {len(field.distributions)} distributions")


if __name__ == "__main__":
    main()
