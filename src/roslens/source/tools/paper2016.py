"""From the results of cccc for the files of a package to the values of the 2016 study for the package."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from math import log, sin, sqrt

import msgspec

from roslens.judge.ranges.range import Range
from roslens.judge.ranges.rate import rate
from roslens.model.verdict import State
from roslens.source.tools.cccc_quantities import (
    CBO,
    CCCC_QUANTITIES,
    COMMENT_LINES,
    COMMENT_RATIO,
    CYCLOMATIC_COMPLEXITY,
    DIT,
    HALSTEAD_VOLUME,
    LOC,
    MAC,
    MAINTAINABILITY_INDEX,
    NOC,
    RQV,
    WMC,
)
from roslens.source.tools.cccc_report import CcccFile, CcccModule

SUFFIXES = (".cpp", ".cc", ".h", ".hpp", ".c")
LEFT_OUT = frozenset({".git", "doc", "bin", "cmake"})


class StudiedFile(msgspec.Struct, frozen=True):
    """A file of the study: its path, the results of cccc for it, and its Halstead volume."""

    path: str
    report: CcccFile
    volume: float


def is_studied(path_in_package: str) -> bool:
    """Return whether the study looked at a file: by its suffix, and no folder above it is left out."""
    *folders, name = path_in_package.split("/")
    return name.endswith(SUFFIXES) and LEFT_OUT.isdisjoint(folders)


def class_values(module: CcccModule) -> dict[str, float]:
    """Return what is measured of a class, by key; zeros are left out as the study did."""
    values = {
        CBO.key: module.cbo,
        NOC.key: module.noc,
        WMC.key: module.wmc,
        DIT.key: module.dit,
        MAC.key: module.mac,
    }
    return {key: float(value) for key, value in values.items() if value > 0}


def file_values(file: StudiedFile) -> dict[str, float]:
    """Return what is measured of a file, by key; without code only its volume and violations."""
    report = file.report
    values: dict[str, float] = {HALSTEAD_VOLUME.key: file.volume, RQV.key: float(_violations(report))}
    if report.loc > 0:
        values[LOC.key] = float(report.loc)
        values[COMMENT_LINES.key] = float(report.comment_lines)
        values[COMMENT_RATIO.key] = float(100 * report.comment_lines // report.loc)
    return values


def package_values(files: Sequence[StudiedFile]) -> dict[str, float]:
    """Return the values of the study for a package with these files, by key; nothing where there is no code."""
    with_code = [file.report for file in files if file.report.loc > 0]
    if not with_code:
        return {}
    loc = sum(report.loc for report in with_code)
    comment_lines = sum(report.comment_lines for report in with_code)
    complexities = [one.complexity for file in files for one in file.report.functions if one.complexity >= 1]
    complexity = _mean(complexities)
    volume = _mean([file.volume for file in files])
    classes = [class_values(module) for file in files for module in file.report.modules]
    return {
        LOC.key: float(loc),
        COMMENT_LINES.key: float(comment_lines),
        COMMENT_RATIO.key: 100 * comment_lines / loc,
        CYCLOMATIC_COMPLEXITY.key: complexity,
        **{
            quantity.key: _mean([values[quantity.key] for values in classes if quantity.key in values])
            for quantity in (CBO, WMC, MAC, NOC, DIT)
        },
        HALSTEAD_VOLUME.key: volume,
        MAINTAINABILITY_INDEX.key: maintainability_index(volume, complexity, loc / len(with_code), comment_lines / loc),
        RQV.key: float(sum(_violations(file.report) for file in files)),
    }


def maintainability_index(volume: float, complexity: float, loc: float, comments: float) -> float:
    """Return the index of the study.

    Args:
        volume: mean Halstead volume of the files; 0 makes the index 0.
        complexity: mean cyclomatic complexity of the functions.
        loc: mean lines of code of the files, above 0.
        comments: comment lines for each line of code.
    """
    if volume <= 0:
        return 0.0
    index = (171 - 5.2 * log(volume) - 0.23 * complexity - 16.2 * log(loc)) * 100 / 171
    return max(0.0, index + 50 * sin(sqrt(2.4 * comments)))


def _violations(report: CcccFile) -> int:
    ranges = _ranges()
    return sum(
        1 for key, value in _judged(report) if key in ranges and rate(value, ranges[key]) in {State.LOW, State.HIGH}
    )


def _judged(report: CcccFile) -> Iterator[tuple[str, float]]:
    if report.loc > 0:
        yield COMMENT_RATIO.key, float(100 * report.comment_lines // report.loc)
    for function in report.functions:
        if function.complexity >= 1:
            yield CYCLOMATIC_COMPLEXITY.key, float(function.complexity)
    for module in report.modules:
        yield from class_values(module).items()


@lru_cache(maxsize=1)
def _ranges() -> Mapping[str, Range]:
    """Return the ranges of the model ``paper2016`` by quantity."""
    from roslens.judge.quality.quality_model import load_model

    known = {quantity.key: quantity for quantity in CCCC_QUANTITIES}
    return {one.quantity: one.range for one in load_model("paper2016", known).constraints}


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values) if values else 0.0
