"""A report of a mistake, rebuilt as a small workspace: what ``expect.json`` says of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import msgspec

ROOT = Path(__file__).parents[2]
CASES = ROOT / "tests" / "reports" / "cases"
ROUNDS = ("first", "second", "third", "fourth")

Consequence = Literal[
    "stops the build",
    "stops the start",
    "wrong at run time",
    "may be wrong at run time",
    "hard to maintain",
    "style",
]
Area = Literal[
    "launch",
    "parameters",
    "QoS and topics",
    "executors and callbacks",
    "lifecycle",
    "clocks, time and transforms",
    "install rules and packaging",
    "interfaces",
    "plug-ins and components",
    "configuration of nav2 and ros2_control",
    "distributions' changes",
]


class Place(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Where a finding may stand, and of what it has to speak.

    Attributes:
        path: of the file, from the workspace.
        any: of these words one has to stand in the message or the rule of the finding, in any case.
        lines: first and last that are accepted; None accepts all of the file.
    """

    path: str
    any: list[str]
    lines: tuple[int, int] | None = None


class ReportCase(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What ``expect.json`` says.

    Attributes:
        title: what is wrong, in a sentence; of a correct form, what looks wrong.
        source: ``owner/name#number`` of the report.
        ros: 1 or 2.
        distro: that the mistake is one of; empty is any.
        area: of ROS that it belongs to.
        good: what the corrected form has to be.
        wrong: why it fails, and how.
        why_correct: of a case that has a correct form only.
        consequence: of the mistake.
        bad: where it may be reported; empty where the case has a correct form only.
    """

    title: str
    source: str
    ros: Literal[1, 2]
    distro: str
    area: Area
    good: Literal["clean"]
    wrong: str = ""
    why_correct: str = ""
    consequence: Consequence | None = None
    bad: list[Place] = []


class Rebuilt(msgspec.Struct, frozen=True):
    """A case and where it lies.

    Attributes:
        name: of its folder.
        folder: with ``expect.json``, ``good`` and, where there is a mistake, ``bad``.
        case: what it says.
    """

    name: str
    folder: Path
    case: ReportCase

    @property
    def forms(self) -> Sequence[str]:
        """The workspaces that it has: ``bad`` and ``good``, or ``good``."""
        return ("bad", "good") if self.case.bad else ("good",)


def rebuilt(round_name: str) -> list[Rebuilt]:
    """Return the cases of a round by name.

    Raises:
        ValueError: no such round, or an ``expect.json`` is not what it has to be: it says of which case.
    """
    if round_name not in ROUNDS:
        raise ValueError(f"no round {round_name!r}: {', '.join(ROUNDS)}")
    cases = []
    for path in sorted((CASES / round_name).glob("*/expect.json")):
        try:
            case = msgspec.json.decode(path.read_bytes(), type=ReportCase)
        except msgspec.DecodeError as error:
            raise ValueError(f"{path.parent.name}: {error}") from error
        cases.append(Rebuilt(path.parent.name, path.parent, case))
    return cases
