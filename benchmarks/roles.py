"""How well the roles of packages that nobody looked at are guessed: leave one repository out, 180 packages of 45.

    python benchmarks/roles.py                       from the recorded marks
    python benchmarks/roles.py --record FOLDER       look at the clones again, checked with `roslens check FOLDER`
    python benchmarks/roles.py --write               also write the weights that `roslens roles` decides by
    python benchmarks/roles.py --independent FOLDER  of packages of today, in FOLDER/ros1 and FOLDER/ros2, checked

The roles are those that the authors of the 2016 study gave by hand (tests/fixtures/study). Words of the marks were
chosen with all packages in view, so the words are not held out, only the weights. The independent ones are of packages
with code, one of each of 57 repositories drawn at random of those that benchmarks/study_2026.py fetches and the study
has not: one person gave them by name and description before seeing what is guessed.
"""

from __future__ import annotations

import argparse
import csv
import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.special import logsumexp

from roslens.source.study.role import ROLES

ROOT = Path(__file__).parents[1]
MARKS = ROOT / "tests" / "fixtures" / "study" / "role_marks.csv"
LABELS = ROOT / "tests" / "fixtures" / "study" / "package_repo_metrics.csv"
TODAY = ROOT / "tests" / "fixtures" / "study" / "role_labels_2026.csv"
WEIGHTS = ROOT / "src" / "roslens" / "source" / "study" / "role_weights.json"
PENALTY = 1.0
PRIOR = {
    "application_name": "application", "application_text": "application", "robot_application": "application",
    "task_include": "application", "example": "application", "on_bringup": "application",
    "device_access": "driver", "device_include": "driver", "device_dependency": "driver",
    "device_name": "driver", "driver_name": "driver",
    "driver_text": "driver", "robot_part": "driver", "robot_repository": "driver",
    "graph_asks": "application", "graph_commands": "application", "graph_measures": "driver", "graph_obeys": "driver",
    "general": "library", "headers": "library", "library_name": "library", "no_node": "library",
}  # fmt: skip
"""What a mark speaks for before any package is seen: the packages have few of some, and then this decides."""

STRENGTH = 2.0
STRONG = {
    "device_access": 4.0, "device_include": 5.0,
    "graph_asks": 3.0, "graph_commands": 3.0, "graph_measures": 3.0, "graph_obeys": 3.0,
}  # fmt: skip
"""What reaches a device is a driver by what the word means, also where sources do and nothing else says so; of the 180
packages most drivers are of a robot by name. What nodes say was not recorded of them, and is weighed by its meaning."""

Matrix = NDArray[np.float64]


def recorded(path: Path = MARKS) -> list[tuple[str, str, str, frozenset[str]]]:
    """Return name, repository, role by hand and marks of each package."""
    with path.open(newline="") as stream:
        return [(a, b, c, frozenset(d.split())) for a, b, c, d in list(csv.reader(stream))[1:]]


def record(folder: Path) -> None:
    """Write the marks of the packages of the study, as the last run of a folder shows them."""
    from roslens.source.study.role import facts_of
    from roslens.source.study.role_graph import spoken_by_package
    from roslens.source.study.role_marks import marks_of
    from roslens.store.runs import Store

    with LABELS.open(newline="") as stream:
        labels = {row["Package"]: row for row in csv.DictReader(stream)}
    rows = []
    with Store.open(folder / ".roslens" / "store.sqlite") as store:
        view = store.view(None)
        spoken = spoken_by_package(one.configuration for one in view.configurations())
        for summary in view.packages():
            result = view.outline(summary.id)
            if result and summary.name in labels:
                label = labels[summary.name]
                marks = " ".join(sorted(marks_of(facts_of(result, spoken.get(summary.name)))))
                rows.append((summary.name, label["Repository"], ROLES[int(label["Level"]) - 1], marks))
    with MARKS.open("w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(("package", "repository", "role", "marks"))
        writer.writerows(sorted(rows))


def fit(names: Sequence[str], marks: Matrix, roles: NDArray[np.int64], start: Matrix | None = None) -> Matrix:
    """Return weights (marks by roles; the last row is the bias), drawn to the prior; the bias is free.

    There is one best answer, wherever the search starts.
    """
    before = np.array(
        [[STRONG.get(name, STRENGTH) * (PRIOR.get(name) == role) for role in ROLES] for name in [*names, "bias"]]
    )
    wanted = np.eye(len(ROLES))[roles]
    shape = (marks.shape[1], len(ROLES))

    def loss(flat: Matrix) -> tuple[float, Matrix]:
        weights = flat.reshape(shape)
        scores = marks @ weights
        total = logsumexp(scores, axis=1)
        penalised = weights - before
        penalised[-1] = 0
        slope = marks.T @ (np.exp(scores - total[:, None]) - wanted) + PENALTY * penalised
        return float((total - (scores * wanted).sum(1)).sum() + PENALTY / 2 * (penalised**2).sum()), slope.ravel()

    found: Any = minimize(
        loss, (before if start is None else start).ravel(), jac=True, method="L-BFGS-B", options={"maxiter": 2000}
    )
    return np.asarray(found.x, dtype=float).reshape(shape)


def matrix(rows: Sequence[tuple[str, str, str, frozenset[str]]]) -> tuple[list[str], Matrix, NDArray[np.int64]]:
    """Return the names of marks, the matrix with a last column of ones, and the numbers of roles."""
    names = sorted({*PRIOR, *(mark for row in rows for mark in row[3])})
    marks = np.array([[float(name in row[3]) for name in names] + [1.0] for row in rows])
    return names, marks, np.array([ROLES.index(row[2]) for row in rows])


def left_out(rows: Sequence[tuple[str, str, str, frozenset[str]]], only: Sequence[str] = ()) -> list[str]:
    """Return the role that each package gets by weights made without its repository.

    With ``only`` some repositories, packages of others get what they have by hand.
    """
    names, marks, roles = matrix(rows)
    repositories = np.array([row[1] for row in rows])
    reported = roles.copy()
    near = fit(names, marks, roles)
    for repository in only or sorted(set(repositories)):
        here = repositories == repository
        reported[here] = (marks[here] @ fit(names, marks[~here], roles[~here], near)).argmax(1)
    return [ROLES[number] for number in reported]


def independent(folder: Path, path: Path = TODAY) -> list[tuple[str, str, str]]:
    """Return name, role by hand and guessed role of each package of today, by the last runs of two folders."""
    from roslens.source.study.role import RolesInRuns
    from roslens.store.runs import Store

    with path.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    found = []
    for one in sorted({row["list"] for row in rows}):
        with Store.open(folder / one / ".roslens" / "store.sqlite") as store:
            view, roles = store.view(None), RolesInRuns()
            for row in rows:
                reported = roles.decision(view, row["package"]) if row["list"] == one else None
                if reported is not None:
                    found.append((f"{row['repository']}/{row['package']}", row["role"], reported.role))
    return found


def tell(given: Sequence[str], reported: Sequence[str]) -> None:
    """Print how many are guessed as by hand, and how they are confused."""
    right = sum(a == b for a, b in zip(given, reported, strict=True))
    print(f"accuracy {right / len(given):.3f} ({right}), kappa {kappa(given, reported):.3f}")
    print(f"{'by hand':>12} | " + " ".join(f"{role:>12}" for role in ROLES))
    for role in ROLES:
        counts = Counter(b for a, b in zip(given, reported, strict=True) if a == role)
        print(f"{role:>12} | " + " ".join(f"{counts[other]:>12}" for other in ROLES))


def kappa(given: Sequence[str], reported: Sequence[str]) -> float:
    """Return Cohen's kappa: agreement beyond what chance brings."""
    same = sum(a == b for a, b in zip(given, reported, strict=True)) / len(given)
    first, second = Counter(given), Counter(reported)
    chance = sum(first[role] * second[role] for role in ROLES) / len(given) ** 2
    return (same - chance) / (1 - chance)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--record", type=Path, metavar="FOLDER")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--independent", type=Path, metavar="FOLDER")
    options = parser.parse_args()
    if options.independent:
        found = independent(options.independent)
        print(f"{len(found)} packages of today, each of a repository that the study has not")
        tell([one[1] for one in found], [one[2] for one in found])
        for name, role, other in found:
            if role != other:
                print(f"  {name}: {role} by hand, {other} guessed")
        return
    if options.record:
        record(options.record)
    rows = recorded()
    reported = left_out(rows)
    given = [row[2] for row in rows]
    print(f"{len(rows)} packages of {len({row[1] for row in rows})} repositories, each guessed without its own one")
    tell(given, reported)
    for row, other in zip(rows, reported, strict=True):
        if row[2] != other:
            print(f"  {row[1]}/{row[0]}: {row[2]} by hand, {other} guessed; {', '.join(sorted(row[3]))}")
    if options.write:
        names, marks, roles = matrix(rows)
        weights = fit(names, marks, roles)
        table = {
            name: {role: round(float(value), 3) for role, value in zip(ROLES, line, strict=True)}
            for name, line in zip([*names, "bias"], weights, strict=True)
        }
        WEIGHTS.write_text(json.dumps(table, indent=2) + "\n")


if __name__ == "__main__":
    main()
