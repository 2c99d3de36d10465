"""Which rules were mended by the cause of what was not true, and what was read of them since."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec
import yaml

from graph_findings.judgements import ROOT, Sample

TABLE = ROOT / "tests" / "fixtures" / "rule_mendings" / "mended.yaml"


class Mending(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The last time that a rule was mended.

    Attributes:
        after: name of the last table that was read before.
        cause: of what was not true, in words.
    """

    after: str
    cause: str


def read_mendings(path: Path = TABLE) -> dict[str, Mending]:
    """Return what was mended last, by rule.

    Raises:
        ValidationError: the file is no such table.
    """
    return msgspec.convert(yaml.safe_load(path.read_text("utf-8")), dict[str, Mending])


def since(rule: str, mending: Mending, found: Mapping[str, Sample]) -> tuple[int, int]:
    """Return how many findings were true and read in the tables that were drawn after a rule was mended.

    Raises:
        KeyError: there is no table of the name that the mending says.
    """
    last = found[mending.after].seed
    verdicts = [
        one.verdict
        for sample in found.values()
        if sample.seed > last and not sample.developed_on
        for one in sample.findings
        if one.rule == rule and one.verdict is not None
    ]
    return sum(verdicts), len(verdicts)
