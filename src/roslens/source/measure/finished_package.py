"""A package finished where it was measured: judged, and made into the rows that a store keeps of it.

So the one process that all results come to has only to write them. That works where nothing else has a say: no plug-in
and no foreign tool, and no finding that was accepted, for which the files of all packages are looked through.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import msgspec

from roslens.judge.quality.quality_model import QualityModel
from roslens.model.failure import Failure
from roslens.model.result import PackageResult
from roslens.plugins.outcome import Outcome
from roslens.source.measure.analyse_package import MeasuredPackage, measure_task
from roslens.source.measure.finish_package import Finisher
from roslens.source.measure.package_task import PackageTask
from roslens.source.nameable_rules import nameable_rules
from roslens.source.settings import SourceSettings
from roslens.source.workspace.silence import Silence
from roslens.store.encodable import encodable
from roslens.store.writing.unit_rows import UnitRows, unit_rows


class Finishing(msgspec.Struct, frozen=True):
    """How packages are finished.

    Attributes:
        settings: of the run.
        models: that it judges by.
        failures: of finding packages and reading files, each with the package that it belongs to.
        brief: whether what was measured inside of packages is left out.
    """

    settings: SourceSettings
    models: tuple[QualityModel, ...]
    failures: tuple[Failure, ...] = ()
    brief: bool = False


class FinishedPackage(msgspec.Struct, frozen=True):
    """What is left to write of a package.

    Attributes:
        package: its id.
        rows: of its result.
        rules: that its findings name.
        analyses: of files that were not in the cache, encoded.
        evaluated: what rules evaluated, which replaces what the cache has.
    """

    package: str
    rows: UnitRows
    rules: tuple[str, ...]
    analyses: dict[str, bytes] = {}
    evaluated: dict[str, bytes] = {}


def finish_packed(how: bytes, failures: bytes, task: bytes) -> bytes:
    """Measure and finish a package in another process; all that crosses is packed.

    Args:
        how: a :class:`Finishing`, without failures: the same bytes for all packages of a run.
        failures: those of the package.
        task: a :class:`roslens.source.measure.package_task.PackageTask`.
    """
    finishing = _finishing(how)
    asked = msgspec.msgpack.decode(task, type=PackageTask)
    package = asked.package
    measured = measure_task(asked)
    finisher = Finisher(
        finishing.settings,
        finishing.models,
        {package.id: package},
        {package.id: asked.files},
        msgspec.msgpack.decode(failures, type=tuple[Failure, ...]),
        Silence(finishing.settings.ignore),
        nameable_rules(finishing.settings, finishing.models, ()),
    )
    result = finisher.finish(measured, Outcome())
    rules = tuple(sorted(set(rules_in(result))))
    try:
        return _packed(result, rules, measured, brief=finishing.brief)
    except UnicodeEncodeError:
        return _packed(encodable(result), rules, measured, brief=finishing.brief)


def rules_in(result: PackageResult) -> Iterable[str]:
    """Yield the rules that findings of a package name, those that were set aside too."""
    for finding in result.findings:
        yield finding.rule
        yield from finding.witnesses
    for one in result.set_aside:
        yield one.finding.rule


def _packed(result: PackageResult, rules: tuple[str, ...], measured: MeasuredPackage, *, brief: bool) -> bytes:
    rows = unit_rows(result, brief=brief)
    made = FinishedPackage(result.package.id, rows, rules, measured.analyses, measured.evaluated)
    return msgspec.msgpack.encode(made)


@lru_cache(maxsize=2)
def _finishing(packed: bytes) -> Finishing:
    return msgspec.msgpack.decode(packed, type=Finishing)
