"""Makes up expressions of Python: texts, truth values, numbers, lists and tables, with parts that nobody knows."""

from __future__ import annotations

import random
from collections.abc import Callable

_WORDS = ("scan", "odom", "cmd_vel", "front", "rear", "a_b", "left_arm", "x", "tf")


class Values:
    """Makes up expressions by their type.

    Attributes:
        draw: where chance comes from.
        known: variables by their type, at the place that is written.
        functions: of the module by what they return, with the types of their parameters.
        methods: likewise, of the node.
        members: of the node by their type.
        loops: how many loops are around.
    """

    def __init__(self, seed: int) -> None:
        self.draw = random.Random(seed)
        self.known: dict[str, list[str]] = {}
        self.functions: dict[str, list[tuple[str, list[str]]]] = {}
        self.methods: dict[str, list[tuple[str, list[str]]]] = {}
        self.members: dict[str, list[str]] = {}
        self.loops = 0
        self._made = 0
        self.in_node = False
        self.makes = False

    # Names

    def fresh(self, stem: str) -> str:
        self._made += 1
        return f"{stem}{self._made}"

    def keep(self, kind: str, name: str) -> None:
        self.known.setdefault(kind, []).append(name)

    def chance(self, of: float) -> bool:
        return self.draw.random() < of

    def one(self, *makers: Callable[[], str]) -> str:
        return self.draw.choice(makers)()

    def word(self) -> str:
        return f'"{self.draw.choice(_WORDS)}"'

    def held(self, kind: str) -> str | None:
        """Return a variable, member or call of a function of a type; None where there is none."""
        found = list(self.known.get(kind, ()))
        if self.in_node:
            found += [f"self.{name}" for name in self.members.get(kind, ())]
        return self.draw.choice(found) if found else None

    def called(self, kind: str, deep: int) -> str | None:
        """Return a call of a function of this program that returns a type."""
        found = [(name, given) for name, given in self.functions.get(kind, ())]
        if self.in_node:
            found += [(f"self.{name}", given) for name, given in self.methods.get(kind, ())]
        if not found:
            return None
        name, given = self.draw.choice(found)
        return f"{name}({', '.join(self.value(one, deep + 1) for one in given)})"

    # Values

    def value(self, kind: str, deep: int = 0) -> str:
        """Return an expression of a type."""
        if self.chance(0.45 if deep else 0.3) and (name := self.held(kind)) is not None:
            return name
        if deep < 3 and self.chance(0.15) and (call := self.called(kind, deep)) is not None:
            return call
        return str(getattr(self, f"_{kind}")(deep))

    def _text(self, deep: int) -> str:
        if deep > 2 or self.chance(0.35):
            return self.word()
        if self.chance(0.12):
            return "text()"
        s = lambda: self.value("text", deep + 1)  # noqa: E731
        return self.one(
            lambda: f'f"{{{self.held("text") or "text()"}}}/{self.draw.choice(_WORDS)}"',
            lambda: f"{s()} + {self.word()}",
            lambda: f'"%s_%s" % ({s()}, {s()})',
            lambda: f'"{{}}/{{}}".format({s()}, {s()})',
            lambda: f'"{{0}}_{{1}}_{{0}}".format({s()}, {s()})',
            lambda: f"({s()} if {self.value('truth', deep + 1)} else {s()})",
            lambda: f"({s()} or {self.word()})",
            lambda: f"({s()} and {self.word()})",
            lambda: f'{s()}.replace("o", "0")',
            lambda: f"{s()}.upper()",
            lambda: f'("/" + {s()}).lstrip("/")',
            lambda: f'{s()}.split("_")[{self.draw.choice((0, -1))}]',
            lambda: f"{s()}[{self.draw.choice(('1:', ':2', '0', '-1', '::-1', ':-1'))}]",
            lambda: f'"_".join({self.value("texts", deep + 1)})',
            lambda: f"{self.value('table', deep + 1)}.get({s()}, {s()})",
            lambda: f"{self.value('texts', deep + 1)}[{self.draw.choice((0, -1, 1))}]",
            lambda: f"os.path.join({s()}, {s()})",
            lambda: f"os.path.basename({s()})",
            lambda: f"str({self.value('count', deep + 1)})",
            lambda: f'f"t{{{self.value("count", 3)}:02d}}"',
            lambda: f"next(iter({self.value('texts', deep + 1)}), {s()})",
            lambda: f"max({self.value('texts', deep + 1)}, key=len)",
        )

    def _truth(self, deep: int) -> str:
        if self.chance(0.3):
            return "ask()"
        if deep > 2:
            return self.draw.choice(("True", "False", "ask()"))
        t = lambda: self.value("truth", deep + 1)  # noqa: E731
        return self.one(
            lambda: self.draw.choice(("True", "False")),
            lambda: f"not {t()}",
            lambda: f"({t()} and {t()})",
            lambda: f"({t()} or {t()})",
            lambda: f"{self.value('text', deep + 1)} {self.draw.choice(('==', '!='))} {self.word()}",
            lambda: f"{self.value('text', deep + 1)} in {self.value('texts', deep + 1)}",
            lambda: f"{self.value('text', deep + 1)} not in {self.value('table', deep + 1)}",
            lambda: f'{self.value("text", deep + 1)}.startswith("{self.draw.choice("soc")}")',
            lambda: f"{self.value('count', deep + 1)} {self.draw.choice(('>', '<=', '=='))} {self.draw.randrange(4)}",
            lambda: f"len({self.value('texts', deep + 1)}) > {self.draw.randrange(3)}",
            lambda: f"bool({self.value('texts', deep + 1)})",
            lambda: f"({self.value('truth', deep + 1)} if {t()} else {t()})",
            lambda: f"{self.value('perhaps', deep + 1)} is {self.draw.choice(('', 'not '))}None",
            lambda: f"any({self.fresh_in('texts', deep)})",
            lambda: f"isinstance({self.value('text', deep + 1)}, str)",
            lambda: f"0 < {self.value('count', deep + 1)} <= 2",
        )

    def fresh_in(self, kind: str, deep: int) -> str:
        """Return a generator expression over a list."""
        name = self.fresh("g")
        return f"{name} == {self.word()} for {name} in {self.value(kind, deep + 1)}"

    def _perhaps(self, deep: int) -> str:
        return self.one(
            lambda: f"({self.value('text', deep + 1)} if ask() else None)",
            lambda: f"{self.value('table', deep + 1)}.get({self.word()})",
        )

    def _count(self, deep: int) -> str:
        if deep > 2 or self.chance(0.4):
            return str(self.draw.randrange(1, 5))
        c = lambda: self.value("count", deep + 1)  # noqa: E731
        return self.one(
            lambda: "number()",
            lambda: f"len({self.value('texts', deep + 1)})",
            lambda: f"({c()} + {c()})",
            lambda: f"({c()} * 2 - 1)",
            lambda: f"({c()} if {self.value('truth', deep + 1)} else {c()})",
            lambda: f"max({c()}, {c()})",
            lambda: f"({c()} or 3)",
            lambda: f"({c()} % 3)",
            lambda: f"int({c()} / 2)",
        )

    def _texts(self, deep: int) -> str:
        if deep > 2 or self.chance(0.35):
            return f"[{', '.join(self.word() for _ in range(self.draw.randrange(1, 4)))}]"
        ls = lambda: self.value("texts", deep + 1)  # noqa: E731
        name = self.fresh("e")
        return self.one(
            lambda: f'[f"{{{name}}}_raw" for {name} in {ls()}]',
            lambda: f"[{name} for {name} in {ls()} if {name} != {self.word()}]",
            lambda: f"[{name} for {name} in {ls()} if ask()]",
            lambda: f"sorted({ls()})",
            lambda: f"list(reversed({ls()}))",
            lambda: f"({ls()} + {ls()})",
            lambda: f"list({self.value('table', deep + 1)}.values())",
            lambda: f"list({self.value('table', deep + 1)})",
            lambda: f'{self.value("text", deep + 1)}.split("_")',
            lambda: f"{ls()}[1:]",
            lambda: f"[*{ls()}, {self.value('text', deep + 1)}]",
            lambda: f'[f"{{{name}}}{{n}}" for n, {name} in enumerate({ls()})]',
            lambda: f"[{name} + other for {name}, other in zip({ls()}, {ls()})]",
            lambda: f"[{name} for {name}, _ in sorted({self.value('table', deep + 1)}.items())]",
            lambda: f'[f"c{{{name}}}" for {name} in range({self.value("count", deep + 1)})]',
            lambda: f"({ls()} if {self.value('truth', deep + 1)} else {ls()})",
            lambda: f"({ls()} or [{self.word()}])",
            lambda: f"list(map(str.upper, {ls()}))",
            lambda: f"list(filter(None, {ls()}))",
            lambda: f"[{name} for {name} in sorted(set({ls()}))]",
            lambda: f"list(dict.fromkeys({ls()}))",
            lambda: f"list(({self.value('text', deep + 1)},))",
        )

    def _table(self, deep: int) -> str:
        def plain() -> str:
            pairs = (f"{self.word()}: {self.value('text', deep + 2)}" for _ in range(self.draw.randrange(1, 4)))
            return f"{{{', '.join(pairs)}}}"

        if deep > 2 or self.chance(0.5):
            return plain()
        name = self.fresh("k")
        return self.one(
            lambda: f"dict(a={self.value('text', deep + 1)}, b={self.word()})",
            lambda: f'{{{name}: {name} + "_v" for {name} in {self.value("texts", deep + 1)}}}',
            lambda: f"{{**{self.value('table', deep + 1)}, {self.word()}: {self.value('text', deep + 1)}}}",
            lambda: f"dict(zip({self.value('texts', deep + 1)}, {self.value('texts', deep + 1)}))",
        )

    def _quality(self, deep: int) -> str:
        if self.chance(0.4):
            return str(self.draw.randrange(1, 20))
        given = [f"depth={self.value('count', 1)}"]
        if self.chance(0.6):
            given.append(f"reliability=QoSReliabilityPolicy.{self.draw.choice(('RELIABLE', 'BEST_EFFORT'))}")
        if self.chance(0.4):
            given.append(f"durability=QoSDurabilityPolicy.{self.draw.choice(('VOLATILE', 'TRANSIENT_LOCAL'))}")
        return f"QoSProfile({', '.join(given)})"
