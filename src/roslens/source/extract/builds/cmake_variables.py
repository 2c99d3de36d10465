"""Variables while CMake files are evaluated, and what is written with references to them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from roslens.source.extract.builds.cmake_condition import Word
from roslens.source.extract.builds.cmake_limits import MOST_LENGTH, Limits
from roslens.source.extract.builds.cmake_scope import Scope
from roslens.source.extract.builds.cmake_signals import ExhaustedError
from roslens.source.extract.builds.cmake_surroundings import NOT_ON_LINUX, may_be_foreign
from roslens.source.extract.builds.cmake_syntax import Argument, Reference, Template, template_of
from roslens.source.extract.builds.cmake_value import hole, is_unknown, items_of, reason_of


class Variables:
    """Variables of an evaluation of one package's CMake files.

    Attributes:
        scope: of the folder or function that is run.
        cache: variables of the cache.
        environment: variables of the environment that the files set.
        open: variables of the cache that the user may set otherwise.
        foreign: variables that were given to what is not evaluated.
        prefixes: how the variables begin that packages set which were looked for.
        bound: arguments of the macro that is run; None outside of macros.
        alternatives: what a value may be, or lack, by the hole that stands for it.
    """

    def __init__(self, limits: Limits) -> None:
        """Begin without any; what texts take counts against ``limits``."""
        self.scope = Scope()
        self.cache: dict[str, str] = {}
        self.environment: dict[str, str] = {}
        self.open: set[str] = set()
        self.foreign: set[str] = set()
        self.prefixes: set[str] = set()
        self.bound: dict[str, str] | None = None
        self.alternatives: dict[str, tuple[str, ...]] = {}
        self._limits = limits

    def get(self, name: str) -> str | None:
        """Return the value of a variable; None where it is not set. What others may have set is a hole."""
        known, value = self.scope.get(name)
        if value is not None:
            return value
        if name in self.cache:
            return self.cache[name]
        return hole(f"{name} of the build environment") if self.is_foreign(name) and not known else None

    def kept(self, name: str) -> str | None:
        """Return the value that the files read have given to a variable; None where they have not set it."""
        value = self.scope.get(name)[1]
        return self.cache.get(name) if value is None else value

    def is_foreign(self, name: str) -> bool:
        """Return whether a variable may be set by what is not evaluated."""
        return may_be_foreign(name, self.foreign, self.prefixes)

    def set(self, name: str, value: str | None) -> None:
        """Set a variable of the current scope."""
        if value is not None and len(value) > MOST_LENGTH:
            value = hole(f"{name} is too long")
        self.scope.set(name, value)

    def value(self, template: Template) -> str:
        """Return the value of a template."""
        if len(template) == 1 and isinstance(template[0], Reference):
            return self._referenced(template[0])
        value = "".join(part if isinstance(part, str) else self._referenced(part) for part in template)
        self._limits.spend(len(value))
        return value if len(value) <= MOST_LENGTH else hole("a string that is too long")

    def _referenced(self, reference: Reference) -> str:
        name = self.value(reference.name)
        if is_unknown(name):
            return hole(reason_of(name))
        if reference.of == "ENV":
            return self.environment.get(name, hole(f"environment {name}"))
        if reference.of == "CACHE":
            return self.cache.get(name, "")
        if self.bound is not None and reference.name == (name,) and name in self.bound:
            return self._replaced(self.bound[name])
        return self.get(name) or ""

    def _replaced(self, value: str) -> str:
        """Return the value of an argument of a macro: it is put into the text, and read as such."""
        if "$" not in value and "\\" not in value:
            return value
        bound, self.bound = self.bound, None
        found = self.value(template_of(value))
        self.bound = bound
        return found

    def expanded(self, arguments: Iterable[Argument]) -> list[str]:
        """Return the values of arguments; lists that are not quoted become several."""
        found: list[str] = []
        for argument in arguments:
            value = argument.literal if argument.literal is not None else self.value(argument.template)
            if argument.kind == "bare":
                if ";" in value:
                    self._limits.spend(len(value))
                found.extend(items_of(value))
            else:
                found.append(value)
        if len(found) > MOST_LENGTH:
            raise ExhaustedError("a command has too many arguments")
        return found

    def words(self, arguments: tuple[Argument, ...]) -> list[Word]:
        """Return the words of a condition."""
        found: list[Word] = []
        for argument in arguments:
            if argument.kind == "paren":
                found.append(Word(argument.written, paren=True))
            elif argument.kind == "bare":
                found.extend(Word(value, paren=value in ("(", ")")) for value in self.expanded((argument,)))
            else:
                found.append(Word(self.expanded((argument,))[0], quoted=True))
        return found

    def variable(self, name: str) -> tuple[str | None, bool]:
        """Return a variable's value, and whether the user may give it another: those are in capitals."""
        if name.startswith("ENV{"):
            return self.environment.get(name[4:-1], hole(f"environment {name[4:-1]}")), False
        if name.startswith("CACHE{"):
            return self.cache.get(name[6:-1]), name[6:-1] in self.open or name[6:-1] not in self.cache
        known, value = self.scope.get(name)
        if value is not None:
            return value, False
        if name in self.cache:
            return self.cache[name], name in self.open
        if known:
            return None, False
        if self.is_foreign(name):
            return hole(name), True
        return None, name.isidentifier() and name.isupper() and name not in NOT_ON_LINUX

    def matched(self, groups: Sequence[str]) -> None:
        """Set what a regular expression has matched, or that it has not."""
        filled = [number for number, group in enumerate(groups[:10]) if group]
        for number in range(10):
            if number in filled or self.scope.get(f"CMAKE_MATCH_{number}")[1] is not None:
                self.set(f"CMAKE_MATCH_{number}", groups[number] if number in filled else "")
        self.set("CMAKE_MATCH_COUNT", str(max(filled, default=0)))

    def either(self, condition: str) -> Callable[[str, list[str | None]], str | None]:
        """Return what makes one value of those of branches of which the first has a condition."""

        def made(name: str, values: list[str | None]) -> str | None:
            lists = [items_of(value or "") for value in values]
            every = dict.fromkeys(item for items in lists for item in items)
            shared = [item for item in every if all(item in items for items in lists)]
            rest = tuple(item for item in every if item not in shared)[:100]
            unknown = hole(f"{name} depends on {condition}")
            self.alternatives[unknown] = rest
            return ";".join([*shared, unknown])

        return made
