"""4: tests, coverage, performance, style and static analysis."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.requirement import Item
from roslens.model.source import Location
from roslens.source.evidence.answer import met, not_known, not_met
from roslens.source.evidence.package_folder import PackageFolder
from roslens.source.evidence.version import declared

_COVERAGE = ("codecov.yml", ".codecov.yml", ".coveragerc")
_BENCHMARKS = frozenset(
    {"ament_cmake_google_benchmark", "performance_test_fixture", "google_benchmark_vendor", "benchmark"}
)
_STYLE = frozenset({
    "ament_lint_common", "ament_cpplint", "ament_cmake_cpplint", "ament_uncrustify", "ament_cmake_uncrustify",
    "ament_clang_format", "ament_cmake_clang_format", "ament_flake8", "ament_cmake_flake8", "roslint",
})  # fmt: skip
_ANALYSIS = frozenset({
    "ament_lint_common", "ament_cppcheck", "ament_cmake_cppcheck", "ament_clang_tidy", "ament_cmake_clang_tidy",
    "ament_mypy", "ament_cmake_mypy", "ament_pclint",
})  # fmt: skip
_STYLE_FILES = (".pre-commit-config.yaml",)
_ANALYSIS_PATTERN = r"cppcheck|clang[-_]tidy|clang-analyzer|mypy|codeql|coverity|sonar"


def testing(folder: PackageFolder) -> Iterator[Item]:
    """Yield what is known of tests."""
    tests = folder.tests()
    places = [Location(one.path) for one in tests]
    if tests:
        yield not_known(
            "4.i", f"{len(tests)} files of tests; whether they cover each feature is not determined", *places
        )
        yield not_known(
            "4.ii", f"{len(tests)} files of tests; coverage of the public API is not determined", *places[:2]
        )
    else:
        yield not_met("4.i", "no file of tests")
        yield not_met("4.ii", "no file of tests")
    yield from _coverage(folder)
    yield _performance(folder)
    yield declared(folder, "4.iv.b", r"performance", "losses of performance")
    yield _linters(
        folder, "4.v.a", _STYLE, _STYLE_FILES, r"clang[-_]format|uncrustify|pre-commit|ament_lint|flake8|black\b"
    )
    yield _linters(folder, "4.v.b", _ANALYSIS, (".clang-tidy",), _ANALYSIS_PATTERN)


def _coverage(folder: PackageFolder) -> Iterator[Item]:
    settings = folder.find(*_COVERAGE)
    place = (
        folder.location(settings)
        if settings
        else folder.says(r"codecov|coveralls|lcov|gcov|--coverage", *folder.pipelines)
    )
    place = place or folder.says(r"codecov|coveralls|coverage", folder.declaration)
    if place:
        yield met("4.iii.a", "coverage is reported or declared", place)
    else:
        yield not_known("4.iii.a", "nothing in the repository measures it; the ROS build farm may")
    target = folder.says(r"^\s*target:|fail_under|threshold", settings)
    if target:
        yield met("4.iii.b", "a target of coverage is set", target)
    else:
        yield declared(
            folder, "4.iii.b", r"coverage (policy|target)|\d+ ?% .*coverage|coverage.*\d+ ?%", "a target of coverage"
        )


def _performance(folder: PackageFolder) -> Item:
    needed = [one for one in folder.needs() if one in _BENCHMARKS]
    files = [one for one in folder.result.files if "benchmark" in one.path.lower() or "performance" in one.path.lower()]
    if needed or files:
        what = f"depends on {needed[0]}" if needed else f"{len(files)} files of benchmarks"
        return met("4.iv.a", what, *(Location(one.path) for one in files[:3]))
    if place := folder.says(r"performance", folder.declaration):
        return not_known("4.iv.a", "no benchmark; the declaration mentions performance", place)
    return not_met("4.iv.a", "no benchmark, and no declaration that states why")


def _linters(
    folder: PackageFolder, number: str, packages: frozenset[str], files: tuple[str, ...], pattern: str
) -> Item:
    needed = [one for one in folder.needs() if one in packages]
    if needed:
        dependency = next(one for one in folder.package.dependencies if one.name == needed[0])
        return met(number, f"tests with {', '.join(needed)}", dependency.location)
    if place := folder.says(pattern, *folder.pipelines):
        return met(number, "a pipeline runs it", place)
    settings = folder.find(*files)
    if settings and (
        place := folder.says(pattern, settings) or (folder.location(settings) if number == "4.v.a" else None)
    ):
        return not_known(number, "settings exist; whether they are enforced cannot be determined", place)
    return not_met(number, "no linter among its dependencies, and no pipeline that runs one")
