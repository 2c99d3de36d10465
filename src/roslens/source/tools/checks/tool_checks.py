"""What the checks of foreign tools mean here: weight, tags and clauses of standards, from data beside each tool.

``<tool>.checks.toml`` has ``about`` (where the checks are documented), ``page`` (address of one check, with
``{check}``, and ``{family}`` and ``{rest}`` of the part before and behind its first ``-``), a table ``checks`` with an
entry for each check that has something of its own, and a list ``family`` whose globs (``match``) say what holds for
the others; the first that matches counts. An entry may have ``title``, ``consequence`` and ``certainty``, ``tags``,
``clauses``, ``why``.
"""

from __future__ import annotations

from collections.abc import Mapping
from fnmatch import fnmatchcase
from functools import cache
from importlib.resources import files as packaged

import msgspec

from roslens.model.finding import RuleInfo, Severity
from roslens.model.weight.consequence import Certainty, Consequence, severity_of

LAYOUT = "layout"
"""Tag of the checks about white space, line length and the position of braces: what a formatter fixes."""


class Check(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """What is said of one check, or of a family of them.

    ``consequence`` and ``certainty`` stand together or not at all: then the severity is what the tool says.
    ``clauses`` are of published standards: ``misra-cpp-2008 6-4-1``.
    """

    title: str = ""
    consequence: Consequence | None = None
    certainty: Certainty | None = None
    tags: tuple[str, ...] = ()
    clauses: tuple[str, ...] = ()
    why: str = ""
    match: str = ""

    @property
    def severity(self) -> Severity | None:
        """Of its findings; None is what the tool says."""
        if self.consequence is None or self.certainty is None:
            return None
        return severity_of(self.consequence, self.certainty)


class Checks(msgspec.Struct, frozen=True, omit_defaults=True, forbid_unknown_fields=True):
    """The data file of a tool.

    ``levels`` translates the tool's own severities, ``names`` other names that its checks go by: numbers, say.
    """

    about: str = ""
    page: str = ""
    levels: dict[str, str] = {}
    names: dict[str, str] = {}
    checks: dict[str, Check] = {}
    family: tuple[Check, ...] = ()

    def of(self, check: str) -> Check:
        """Return what holds for a check: its own entry, completed by its family."""
        family = next((one for one in self.family if fnmatchcase(check, one.match)), Check())
        own = self.checks.get(check)
        if own is None:
            return family
        return Check(
            own.title or family.title,
            own.consequence or family.consequence,
            own.certainty or family.certainty,
            tuple(dict.fromkeys((*family.tags, *own.tags))),
            own.clauses or family.clauses,
            own.why or family.why,
        )

    def severity_of(self, check: str, level: str = "") -> Severity:
        """Return how much a finding matters; what nothing is known of is a note."""
        return self.of(check).severity or Severity(self.levels.get(level.lower(), "") or Severity.NOTE)


@cache
def checks_of(tool: str) -> Checks:
    """Return the data file of a tool; an empty one where there is none, as for a tool of the user's."""
    import tomli

    place = packaged("roslens.source.tools").joinpath(f"{tool}.checks.toml")
    if not place.is_file():
        return Checks(levels=LEVELS)
    return msgspec.convert(tomli.loads(place.read_text("utf-8")), Checks)


LEVELS = {
    "error": "error",
    "fatal": "error",
    "warning": "warning",
    "note": "note",
    "none": "note",
    "information": "note",
    "style": "note",
}
"""Severities that tools commonly use."""


def rule_id(tool: str, check: str) -> str:
    """Return the id that a check of a tool has here."""
    return f"{tool}.{check}"


def tags_of(tool: str, check: str) -> tuple[str, ...]:
    """Return the tags of a check: its tool, what it is about, and the standards of its clauses."""
    known = checks_of(tool).of(check)
    standards = (clause.partition(" ")[0] for clause in known.clauses)
    return tuple(dict.fromkeys((tool, *known.tags, *standards)))


def rule_of(tool: str, check: str, titles: Mapping[str, str] | None = None) -> RuleInfo:
    """Return what readers see of a check; ``titles`` are known to the tool's own output."""
    checks = checks_of(tool)
    known = checks.of(check)
    family, _, rest = check.partition("-")
    page = checks.page.format(check=check, family=family, rest=rest) if checks.page else checks.about
    title = known.title or (titles or {}).get(check, "") or check
    clauses = f" Clauses: {', '.join(known.clauses)}." if known.clauses else ""
    return RuleInfo(
        rule_id(tool, check),
        title,
        f"Check `{check}` of {tool}.{clauses}",
        checks.severity_of(check),
        tags_of(tool, check),
        known.why,
        tool=tool,
        url=page,
        consequence=known.consequence,
        certainty=known.certainty,
    )
