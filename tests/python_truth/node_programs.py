"""Makes up small programs of rclpy: conditions, loops, functions, classes and texts, with inputs that nobody knows.

What is unknown comes from the module ``outside``. Each endpoint is made on a line of its own, so that what is said of a
line can be held against what runs made there.
"""

from __future__ import annotations

from python_truth.node_values import Values

HEAD = """\
import copy
import os
import functools
import dataclasses
import enum
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, QoSReliabilityPolicy, QoSDurabilityPolicy
from std_msgs.msg import String
from std_srvs.srv import Empty
from outside import ask, number, text, risky, context, left
"""
TAIL = """\
def main():
    rclpy.init()
    node = Main()
    rclpy.spin(node)


main()
"""
_CALLBACK = "lambda _message: None"
Lines = list[str]


def _inside(lines: Lines) -> Lines:
    return [f"    {line}" for line in lines or ["pass"]]


class Maker(Values):
    """Makes up one program."""

    def block(self, deep: int, most: int = 4) -> Lines:
        """Return statements one after the other; what they define is known in them only."""
        before = {kind: list(names) for kind, names in self.known.items()}
        lines: Lines = []
        for _ in range(self.draw.randrange(1, most + 1)):
            lines += self.statement(deep)
        self.known = before
        return lines

    def statement(self, deep: int) -> Lines:
        """Return one statement, with what is inside of it."""
        if self.makes and self.chance(0.35):
            return self._endpoint()
        if deep > 2 or self.chance(0.5):
            return self.draw.choice((self._assigned, self._assigned, self._changed, self._called, self._set_again))(
                deep
            )
        found = (
            self._if,
            self._if,
            self._if,
            self._for,
            self._for,
            self._while,
            self._try,
            self._with,
            self._match,
            self._inner,
            self._leaves,
            self._leaves,
        )
        return self.draw.choice(found)(deep)

    def _endpoint(self) -> Lines:
        name = self.value("text", 1)
        quality = (self.held("quality") if self.chance(0.6) else None) or self._quality(0)
        made = self.draw.choice(
            (
                f"self.create_publisher(String, {name}, {quality})",
                f"self.create_subscription(String, {name}, {_CALLBACK}, {quality})",
                f"self.create_service(Empty, {name}, lambda request, answer: answer)",
                f'self.declare_parameter({name}, "")',
            )
        )
        return [made]

    def _assigned(self, deep: int) -> Lines:
        kind = self.draw.choice(("text", "text", "truth", "count", "texts", "texts", "table", "quality"))
        value = self._shared(kind) or (self.value(kind, 1) if kind != "quality" else self._profile())
        if self.in_node and self.chance(0.3):
            name = self.fresh("m")
            if deep == 0:
                self.members.setdefault(kind, []).append(name)
            return [f"self.{name} = {value}"]
        name = self.fresh("v")
        self.keep(kind, name)
        if self.chance(0.1):
            other = self.fresh("v")
            self.keep(kind, other)
            return [f"{name} = {other} = {value}"]
        return [f"{name} = {value}"]

    def _shared(self, kind: str) -> str:
        """Return a list or table that has a name already, as it is or as a copy of it; nothing of other kinds."""
        name = self.held(kind) if kind in ("texts", "table") and self.chance(0.3) else None
        if name is None or name.startswith("CONSTANT"):
            return ""
        return self.draw.choice((name, name, f"{name}.copy()", f"copy.copy({name})", f"copy.deepcopy({name})"))

    def _profile(self) -> str:
        made = self._quality(0)
        return made if made.startswith("QoS") else f"QoSProfile(depth={made})"

    def _set_again(self, deep: int) -> Lines:
        kind = self.draw.choice(("text", "truth", "count", "texts"))
        name = self.held(kind)
        if name is None or name.startswith("CONSTANT"):
            return self._assigned(deep)
        if kind == "text" and self.chance(0.4):
            return [f"{name} += {self.value('text', 1)}"]
        if kind == "count" and self.chance(0.4):
            return [f"{name} {self.draw.choice(('+', '-', '*'))}= {self.value('count', 1)}"]
        return [f"{name} = {self.value(kind, 1)}"]

    def _changed(self, deep: int) -> Lines:
        """Change a list, table or profile in place."""
        kind = self.draw.choice(("texts", "texts", "table", "quality"))
        name = self.held(kind)
        if name is None or name.startswith("CONSTANT"):
            return self._assigned(deep)
        if kind == "quality":
            return [
                self.draw.choice(
                    (
                        f"{name}.depth = {self.value('count', 1)}",
                        f"{name}.reliability = QoSReliabilityPolicy.BEST_EFFORT",
                        f"{name}.durability = QoSDurabilityPolicy.TRANSIENT_LOCAL",
                    )
                )
            ]
        s = self.value("text", 1)
        if kind == "table":
            return [
                self.draw.choice(
                    (
                        f"{name}[{self.word()}] = {s}",
                        f"{name}.update({self.value('table', 2)})",
                        f"{name}.pop({self.word()}, None)",
                        f"{name}.setdefault({self.word()}, {s})",
                        f"{name}[{s}] = {self.word()}",
                        f"{name} |= {self.value('table', 2)}",
                    )
                )
            ]
        return [
            self.draw.choice(
                (
                    f"{name}.append({s})",
                    f"{name}.append({s})",
                    f"{name}.insert(0, {s})",
                    f"{name}.extend({self.value('texts', 2)})",
                    f"{name} += {self.value('texts', 2)}",
                    f"{name}.reverse()",
                    f"{name}.sort()",
                    f"{name}.pop()",
                    f"{name}.clear()",
                    f"{name}[0] = {s}",
                    f"del {name}[0]",
                    f"{name}[:] = [{s}]",
                )
            )
        ]

    def _called(self, deep: int) -> Lines:
        found = self.methods.get("none", []) if self.makes else []
        if not found:
            return self._assigned(deep)
        name, given = self.draw.choice(found)
        return [f"self.{name}({', '.join(self.value(one, 1) for one in given)})"]

    def _if(self, deep: int) -> Lines:
        lines = [f"if {self.value('truth')}:", *_inside(self.block(deep + 1, 3))]
        while self.chance(0.25):
            lines += [f"elif {self.value('truth')}:", *_inside(self.block(deep + 1, 2))]
        if self.chance(0.45):
            lines += ["else:", *_inside(self.block(deep + 1, 3))]
        return lines

    def _for(self, deep: int) -> Lines:
        before = {kind: list(names) for kind, names in self.known.items()}
        name = self.fresh("i")
        over = self.draw.choice(
            (
                lambda: (name, self.value("texts", 1), [("text", name)]),
                lambda: (name, self.value("texts", 1), [("text", name)]),
                lambda: (f"n, {name}", f"enumerate({self.value('texts', 1)})", [("text", name), ("count", "n")]),
                lambda: (f"{name}, w", f"{self.value('table', 1)}.items()", [("text", name), ("text", "w")]),
                lambda: (name, f"range({self.value('count', 1)})", [("count", name)]),
                lambda: (
                    f"{name}, w",
                    f"zip({self.value('texts', 1)}, {self.value('texts', 1)})",
                    [("text", name), ("text", "w")],
                ),
                lambda: (
                    f"{name}, w",
                    f"[({self.word()}, {self.word()}), ({self.word()}, {self.word()})]",
                    [("text", name), ("text", "w")],
                ),
            )
        )()
        for kind, made in over[2]:
            self.keep(kind, made)
        self.loops += 1
        lines = [f"for {over[0]} in list({over[1]}):" if self.chance(0.3) else f"for {over[0]} in {over[1]}:"]
        if ".append" not in lines[0]:
            lines += _inside(self.block(deep + 1, 3))
        self.loops -= 1
        self.known = before
        if self.chance(0.2):
            lines += ["else:", *_inside(self.block(deep + 1, 2))]
        return lines

    def _while(self, deep: int) -> Lines:
        before = {kind: list(names) for kind, names in self.known.items()}
        self.loops += 1
        if self.chance(0.5):
            lines = ["while ask():", *_inside(self.block(deep + 1, 3))]
        else:
            name = self.fresh("n")
            lines = [
                f"{name} = 0",
                f"while {name} < {self.value('count', 2)}:",
                f"    {name} += 1",
                *_inside(self.block(deep + 1, 3)),
            ]
        self.loops -= 1
        self.known = before
        if self.chance(0.2):
            lines += ["else:", *_inside(self.block(deep + 1, 2))]
        return lines

    def _try(self, deep: int) -> Lines:
        body = self.block(deep + 1, 3)
        body.insert(self.draw.randrange(len([1 for line in body if not line.startswith(" ")]) and 1), "risky()")
        lines = ["try:", *_inside(body if self.chance(0.5) else [*body[1:], "risky()"])]
        handled = self.chance(0.85)
        if handled:
            lines += [
                self.draw.choice(("except RuntimeError:", "except Exception as error:")),
                *_inside(self.block(deep + 1, 2)),
            ]
            if self.chance(0.3):
                lines += ["else:", *_inside(self.block(deep + 1, 2))]
        if not handled or self.chance(0.3):
            loops, self.loops = self.loops, 0
            lines += ["finally:", *_inside(self.block(3, 2))]
            self.loops = loops
        return lines

    def _with(self, deep: int) -> Lines:
        if self.chance(0.5):
            return ["with context():", *_inside(self.block(deep + 1, 2))]
        before = {kind: list(names) for kind, names in self.known.items()}
        name = self.fresh("w")
        self.keep("text", name)
        lines = [f"with context() as {name}:", *_inside(self.block(deep + 1, 2))]
        self.known = before
        return lines

    def _match(self, deep: int) -> Lines:
        lines = [f"match {self.value('text', 1)}:"]
        for _ in range(self.draw.randrange(1, 3)):
            pattern = self.draw.choice(
                (self.word(), f"{self.word()} | {self.word()}", f"str() if {self.value('truth', 1)}")
            )
            lines += _inside([f"case {pattern}:", *_inside(self.block(deep + 1, 2))])
        if self.chance(0.5):
            lines += _inside(["case _:", *_inside(self.block(deep + 1, 2))])
        return lines

    def _inner(self, _deep: int) -> Lines:
        """A function inside of a function, that reads what is around it."""
        name, given = self.fresh("f"), self.fresh("p")
        loops, self.loops = self.loops, 0
        before = {kind: list(names) for kind, names in self.known.items()}
        self.keep("text", given)
        value = self.value("text", 1)
        lines = [
            f"def {name}({given}={self.word()}):",
            f"    if {self.value('truth', 1)}:",
            f"        return {self.word()}",
            f"    return {value}",
        ]
        if self.chance(0.4):
            lines = [f"{name} = lambda {given}={self.word()}: {value}"]
        self.known, self.loops = before, loops
        made = self.fresh("v")
        call = self.draw.choice(
            (f"{name}()", f"{name}({self.value('text', 1)})", f"functools.partial({name}, {self.word()})()")
        )
        self.keep("text", made)
        return [*lines, f"{made} = {call}"]

    def _leaves(self, deep: int) -> Lines:
        condition = self.value("truth", 1)
        if self.loops and self.chance(0.75):
            lines = [f"if {condition}:", f"    {self.draw.choice(('break', 'continue'))}"]
            return [lines[0], *_inside(self.block(3, 1)), lines[1]] if self.chance(0.3) else lines
        if self.makes:
            return [f"if {condition}:", "    left()", "    return"] if deep and self.chance(0.3) else self._if(deep)
        return self._if(deep)

    # Definitions

    def function(self, kind: str, *, of_node: bool) -> Lines:
        """Return a function that returns a type, or for ``none`` a method that makes endpoints."""
        outer, self.known, self.loops = self.known, {}, 0
        self.in_node, self.makes = of_node, kind == "none"
        name = self.fresh("make_" if kind == "none" else f"get_{kind}_")
        given = [self.draw.choice(("text", "text", "truth", "texts", "count")) for _ in range(self.draw.randrange(3))]
        names = [self.fresh("p") for _ in given]
        for one, parameter in zip(given, names, strict=True):
            self.keep(one, parameter)
        defaults = [f"={self._default(one)}" if self.chance(0.2) else "" for one in given]
        for place in range(len(defaults) - 1):
            defaults[place + 1] = defaults[place + 1] or (
                f"={self._default(given[place + 1])}" if defaults[place] else ""
            )
        parameters = ", ".join((["self"] if of_node else []) + [a + b for a, b in zip(names, defaults, strict=True)])
        body: Lines = []
        for _ in range(self.draw.randrange(1, 4)):
            body += self._returning(kind) if kind != "none" and self.chance(0.5) else self.statement(1)
        if kind != "none" and (kind != "perhaps" or self.chance(0.5)):
            body.append(f"return {self.value(kind, 1)}")
        where = self.methods if of_node else self.functions
        where.setdefault(kind, []).append((name, given))
        self.known, self.in_node, self.makes = outer, False, False
        return [f"def {name}({parameters}):", *_inside(body)]

    def _default(self, kind: str) -> str:
        return {"text": self.word(), "truth": "False", "count": "2", "texts": '["d"]'}[kind]

    def _returning(self, kind: str) -> Lines:
        value = self.value(kind, 1)
        return self.draw.choice(
            (
                [f"if {self.value('truth', 1)}:", f"    return {value}"],
                [
                    f"for {(name := self.fresh('r'))} in {self.value('texts', 1)}:",
                    f"    if {name} == {self.word()}:",
                    f"        return {value}",
                ],
                ["try:", "    risky()", f"    return {value}", "except RuntimeError:", "    pass"],
                ["while ask():", f"    return {value}"],
                [f"if {self.value('truth', 1)}:", f"    return {value}", "else:", *_inside(self.block(2, 1))],
            )
        )


def program(seed: int) -> str:
    """Return the program of a seed."""
    maker = Maker(seed)
    parts: list[Lines] = []
    for _ in range(maker.draw.randrange(1, 3)):
        constant = maker.draw.choice(("text", "texts", "table", "truth"))
        parts.append([f"{(name := maker.fresh('CONSTANT_'))} = {maker.value(constant, 2)}"])
        maker.keep(constant, name)
    constants = {kind: list(names) for kind, names in maker.known.items()}
    for _ in range(maker.draw.randrange(3)):
        parts.append(maker.function(maker.draw.choice(("text", "truth", "texts", "perhaps")), of_node=False))
    methods: Lines = []
    for kind in maker.draw.sample(("text", "truth", "texts", "none", "none", "none"), maker.draw.randrange(1, 4)):
        methods += ["", *maker.function(kind, of_node=True)]
    maker.known = constants
    maker.in_node = maker.makes = True
    body: Lines = ['super().__init__("main")']
    for _ in range(maker.draw.randrange(4, 9)):
        body += maker.statement(0)
    body += maker._endpoint()
    parts.append(["class Main(Node):", *_inside(["def __init__(self):", *_inside(body), *methods])])
    whole = "\n\n\n".join("\n".join(lines) for lines in parts)
    return f"{HEAD}\n\n{whole}\n\n\n{TAIL}"
