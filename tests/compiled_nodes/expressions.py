"""Random expressions of C++ over the variables and functions that are in scope."""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

TEXTS = ("a", "b", "scan", "cmd", "out/x", "n")
TYPES = {"int": "int", "bool": "bool", "text": "std::string", "list": "std::vector<std::string>",
         "options": "Options", "map": "std::map<std::string, std::string>", "mode": "Mode",
         "maybe": "std::optional<std::string>"}  # fmt: skip


@dataclass
class Scope:
    """What is known where code is written.

    Attributes:
        variables: names by kind, those that may be changed.
        constants: likewise, those that may not.
        functions: name, kind of the result, kinds of the parameters.
        node: how the node is written through which endpoints are made; empty where none is.
        returns: kind of what the function returns; empty of nothing, ``-`` where it must not be left.
        loops: how many loops are around.
    """

    variables: dict[str, list[str]] = field(default_factory=dict)
    constants: dict[str, list[str]] = field(default_factory=dict)
    functions: list[tuple[str, str, tuple[str, ...]]] = field(default_factory=list)
    node: str = ""
    returns: str = ""
    loops: int = 0

    def inner(self, **changed: object) -> Scope:
        """Return a scope inside of this one: what is declared there is not known here."""
        found = Scope(
            {kind: list(names) for kind, names in self.variables.items()},
            {kind: list(names) for kind, names in self.constants.items()},
            list(self.functions), self.node, self.returns, self.loops,
        )  # fmt: skip
        for name, value in changed.items():
            setattr(found, name, value)
        return found

    def add(self, kind: str, name: str, *, constant: bool = False) -> None:
        """Know a variable from here on."""
        (self.constants if constant else self.variables).setdefault(kind, []).append(name)


class Expressions:
    """Writes expressions."""

    def __init__(self, random: Random) -> None:
        """Draw from a source of chance."""
        self.random = random
        self.asked = 0

    def chance(self, part: float) -> bool:
        """Return true so often."""
        return self.random.random() < part

    def variable(self, scope: Scope, kind: str) -> str:
        """Return a variable of a kind that may be changed; empty where there is none."""
        names = list(scope.variables.get(kind, []))
        if kind == "text":
            names += [f"{one}.name" for one in scope.variables.get("options", [])]
        if kind == "int":
            names += [f"{one}.depth" for one in scope.variables.get("options", [])]
        if kind == "bool":
            names += [f"{one}.on" for one in scope.variables.get("options", [])]
        return self.random.choice(names) if names else ""

    def value(self, scope: Scope, kind: str, depth: int = 0) -> str:
        """Return an expression of a kind."""
        return str(getattr(self, f"_{kind}")(scope, depth))

    def _known(self, scope: Scope, kind: str) -> str:
        names = [self.variable(scope, kind), *scope.constants.get(kind, [])]
        names = [one for one in names if one]
        return self.random.choice(names) if names else ""

    def call(self, scope: Scope, kind: str, depth: int) -> str:
        """Return a call of a function that returns something of a kind; empty where there is none."""
        known = [one for one in scope.functions if one[1] == kind]
        if not known or depth > 2:
            return ""
        name, _, parameters = self.random.choice(known)
        given = [self._given(scope, one, depth) for one in parameters]
        return "" if None in given else f"{name}({', '.join(map(str, given))})"

    def _given(self, scope: Scope, kind: str, depth: int) -> str | None:
        if kind == "node":
            return scope.node or None
        if kind[-1] == "&":
            return self.variable(scope, kind[:-1]) or None
        return self.value(scope, kind, depth + 1)

    def unknown(self) -> str:
        """Return a question that nobody can answer from source."""
        self.asked += 1
        return f"ask({self.asked})"

    def _pick(self, scope: Scope, kind: str, depth: int, leaves: list[str], others: list[str]) -> str:
        known = self._known(scope, kind)
        if known and self.chance(0.5):
            return known
        called = self.call(scope, kind, depth) if self.chance(0.4) else ""
        if called:
            return called
        return self.random.choice(leaves if depth > 1 or not others or self.chance(0.5) else others)

    def _int(self, scope: Scope, depth: int) -> str:
        leaves = [str(self.random.randint(0, 4))] * 3 + ["number()"]
        others = []
        if depth < 2:
            one, other = (self._int(scope, depth + 2) for _ in range(2))
            others = [f"({one} + {other})", f"({one} - {other})", f"({one} * 2)", f"({one} % 3)",
                      f"({self._bool(scope, depth + 1)} ? {one} : {other})"]  # fmt: skip
            others += [f"static_cast<int>({name}.size())" for name in scope.variables.get("list", [])]
        return self._pick(scope, "int", depth, leaves, others)

    def _bool(self, scope: Scope, depth: int) -> str:
        leaves = ["true", "false", self.unknown(), self.unknown()]
        others = []
        if depth < 3:
            one, other = (self._bool(scope, depth + 2) for _ in range(2))
            number = self._int(scope, depth + 2)
            sign = self.random.choice(["==", "!=", "<", ">", "<=", ">="])
            others = [f"!{one}", f"({one} && {other})", f"({one} || {other})",
                      f"({number} {sign} {self._int(scope, depth + 2)})"] * 2  # fmt: skip
            text = self._known(scope, "text")
            if text:
                others += [f'({text} == "{self.random.choice(TEXTS)}")', f'({text} != "{self.random.choice(TEXTS)}")',
                           f"{text}.empty()", f"({text}.size() > 1)",
                           f'({text}.find("a") != std::string::npos)']  # fmt: skip
            others += [f"{name}.empty()" for name in scope.variables.get("list", [])]
            others += [f'({name}.count("{self.random.choice("ab")}") > 0)' for name in scope.variables.get("map", [])]
            others += [f"({name} == Mode::{self.random.choice('ABC')})" for name in scope.variables.get("mode", [])]
            others += [f"{name}.has_value()" for name in scope.variables.get("maybe", [])]
        return self._pick(scope, "bool", depth, leaves, others)

    def _text(self, scope: Scope, depth: int) -> str:
        plain = f'std::string("{self.random.choice(TEXTS)}")'
        leaves = [plain] * 5 + ["text()"]
        others = []
        if depth < 2:
            one, other = (self._text(scope, depth + 2) for _ in range(2))
            others = [f"({one} + {other})", f'({one} + "/z")', f"({self._bool(scope, depth + 1)} ? {one} : {other})",
                      f"std::to_string({self._int(scope, depth + 2)})"]  # fmt: skip
            others += [f"{name}.at({self.random.randint(0, 1)})" for name in scope.variables.get("list", [])]
            others += [f"{name}.back()" for name in scope.variables.get("list", []) if self.chance(0.0)]
            others += [f'{name}.at("{self.random.choice("ab")}")' for name in scope.variables.get("map", [])]
            others += [f"{name}.value_or({one})" for name in scope.variables.get("maybe", [])]
            text = self._known(scope, "text")
            if text:
                others += [f"{text}.substr(0, 1)", f'(std::string("p_") + {text})']
        return self._pick(scope, "text", depth, leaves, others)

    def _list(self, scope: Scope, depth: int) -> str:
        items = [self._text(scope, depth + 2) for _ in range(self.random.randint(0, 3))]
        return self._pick(scope, "list", 2, [f"std::vector<std::string>{{{', '.join(items)}}}"], [])

    def _map(self, scope: Scope, depth: int) -> str:
        items = [
            f'{{"{key}", {self._text(scope, depth + 2)}}}'
            for key in self.random.sample("ab", self.random.randint(0, 2))
        ]
        return f"std::map<std::string, std::string>{{{', '.join(items)}}}"

    def _options(self, scope: Scope, depth: int) -> str:
        return self._pick(scope, "options", depth, ["Options()", "Options{}"], [])

    def _mode(self, scope: Scope, depth: int) -> str:
        one, other = (f"Mode::{self.random.choice('ABC')}" for _ in range(2))
        return self._pick(scope, "mode", depth, [one], [f"({self._bool(scope, depth + 1)} ? {one} : {other})"])

    def _maybe(self, scope: Scope, depth: int) -> str:
        leaves = ["std::optional<std::string>()", f"std::optional<std::string>({self._text(scope, depth + 2)})"]
        return self._pick(scope, "maybe", depth, leaves, [])
