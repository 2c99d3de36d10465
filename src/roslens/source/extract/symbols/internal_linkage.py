"""Names of C++ that mean something else in every file: what several sources define, each for itself.

Programs of one package often define a class ``Node`` or a constant ``TOPIC`` each in its own source. No file sees that
of another one, so each means its own; what a header defines is meant by all that do not. Of several headers that define
a name, the one is meant that a file includes, directly or not. Of several that one path may mean, as packages have
headers of one name each, it is that of its own package, else of one that its package depends on, else the nearest.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from roslens.source.extract.ir.program import Program
from roslens.source.extract.symbols.included_files import HEADERS, Needs, Packages, including, reached


def _where(names: Iterable[tuple[str, str]]) -> dict[str, set[str]]:
    """Return the files in which each name is defined."""
    found: dict[str, set[str]] = {}
    for name, path in names:
        found.setdefault(name, set()).add(path)
    return found


def own_names(
    programs: Mapping[str, Program], packages: Packages = MappingProxyType({}), needs: Needs = MappingProxyType({})
) -> dict[str, dict[str, str]]:
    """Return, by path, the qualified names that mean something else in a file, and the file that defines what it is."""
    included = {line.strip('<>"').rpartition("/")[2] for one in programs.values() for line, _ in one.includes}
    cpp = {path: program for path, program in programs.items() if program.language != "python"}
    classes = _where((one.qualified_name, path) for path, program in cpp.items() for one in program.classes)
    variables = _where((name, path) for path, program in cpp.items() for name, _ in program.variables())
    found: dict[str, dict[str, str]] = {}
    for name, paths in (*classes.items(), *variables.items()):
        sources = [path for path in paths if not path.endswith(HEADERS) and path.rpartition("/")[2] not in included]
        # What a header declares without a value, a source may define for all.
        if len(paths) > 1 and (name in classes or len(sources) == len(paths)):
            for path in sources:
                found.setdefault(path, {})[name] = path
    several = {
        name: headers
        for name, paths in (*classes.items(), *variables.items())
        if len(headers := sorted(path for path in paths if path.endswith(HEADERS))) > 1
    }
    if several:
        _by_header(including(programs, packages, needs), several, found)
    return found


def _by_header(
    including: Mapping[str, set[str]], several: Mapping[str, Sequence[str]], found: dict[str, dict[str, str]]
) -> None:
    """Add what files mean by the names that several headers define; the first means what all others do."""
    seen: dict[str, set[str]] = {}
    for header in {header for headers in several.values() for header in headers}:
        seen[header] = reached(header, including)
    for name, headers in several.items():
        for header in headers[1:]:
            others = [seen[other] for other in headers if other != header]
            for path in seen[header]:
                if path == header or not any(path in other for other in others):
                    found.setdefault(path, {}).setdefault(name, header)
