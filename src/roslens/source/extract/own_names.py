"""Names of C++ that mean something else in every file: what several sources define, each for itself.

Programs of one package often define a class ``Node`` or a constant ``TOPIC`` each in its own source. No file sees that
of another one, so each means its own; what a header defines is meant by all that do not.
"""

from __future__ import annotations

from collections.abc import Mapping

from roslens.source.extract.program import Assign, Name, Program

_HEADERS = (".h", ".hpp", ".hh", ".hxx")


def own_names(programs: Mapping[str, Program]) -> dict[str, frozenset[str]]:
    """Return, by path, the qualified names that a source defines for itself because other files define them too."""
    included = {line.strip('<>"').rpartition("/")[2] for one in programs.values() for line, _ in one.includes}
    classes: dict[str, set[str]] = {}
    variables: dict[str, set[str]] = {}
    for path, program in programs.items():
        if program.language != "python":
            for one in program.classes:
                classes.setdefault(one.qualified_name, set()).add(path)
            for statement in program.body:
                if isinstance(statement, Assign) and isinstance(statement.target, Name):
                    variables.setdefault(statement.target.name, set()).add(path)
    found: dict[str, set[str]] = {}
    for name, paths in (*classes.items(), *variables.items()):
        sources = [path for path in paths if not path.endswith(_HEADERS) and path.rpartition("/")[2] not in included]
        # What a header declares without a value, a source may define for all.
        if len(paths) > 1 and (name in classes or len(sources) == len(paths)):
            for path in sources:
                found.setdefault(path, set()).add(name)
    return {path: frozenset(names) for path, names in found.items()}
