"""Random statements of C++: what sets variables, decides, repeats, leaves, and makes endpoints."""

from __future__ import annotations

from random import Random

from compiled_nodes.expressions import TYPES, Expressions, Scope

_STRING = "std_msgs::msg::String"


class Statements:
    """Writes statements, one a line."""

    def __init__(self, random: Random) -> None:
        """Draw from a source of chance."""
        self.random = random
        self.of = Expressions(random)
        self._named = 0

    def name(self, prefix: str) -> str:
        """Return a name that nothing else has."""
        self._named += 1
        return f"{prefix}{self._named}"

    def padding(self) -> list[str]:
        """Return statements that only compute, long enough that a function is not short."""
        one = self.name("pad")
        return [f"double {one} = 0.5;", f"for (int k = 0; k < 3; ++k) {{ {one} += k * 0.25; }}",
                 f"if ({one} > 100.0) {{ {one} = {one} / 2.0; }}", f"{one} = {one} * {one} + 1.0;"]  # fmt: skip

    def body(self, scope: Scope, count: int, depth: int = 0) -> list[str]:
        """Return so many statements."""
        lines: list[str] = []
        for _ in range(count):
            lines += self.statement(scope, depth)
        return lines

    def block(self, scope: Scope, depth: int, **changed: object) -> list[str]:
        """Return statements in a scope of their own, indented."""
        inner = self.body(scope.inner(**changed), self.random.randint(1, 2), depth + 1)
        return [f"  {one}" for one in inner]

    def statement(self, scope: Scope, depth: int) -> list[str]:
        """Return one statement."""
        kinds = {"declare": 3, "assign": 5, "change": 2, "call": 2, "leave": 1}
        if scope.node:
            kinds["endpoint"] = 4
        if depth < 3:
            kinds |= {"branch": 4, "switch": 1, "loop": 2, "attempt": 1, "lambda_": 1, "alias": 1}
        chosen = self.random.choices(list(kinds), list(kinds.values()))[0]
        return list(getattr(self, f"_{chosen}")(scope, depth))

    def _declare(self, scope: Scope, _depth: int) -> list[str]:
        kind = self.random.choice(["int", "bool", "text", "text", "list", "options", "map", "mode", "maybe"])
        name, value = self.name(kind[0]), self.of.value(scope, kind)
        scope.add(kind, name)
        way = self.random.randrange(5)
        if way == 0 and kind in ("text", "options", "list"):
            return [f"{TYPES[kind]} {name};"]
        if way == 1:
            return [f"auto {name} = {value};"]
        if way == 2 and kind == "text":
            return [f"std::string {name}({value});"]
        if way == 3 and kind in ("text", "bool", "int") and self.of.chance(0.5):
            return [f"static {TYPES[kind]} {name} = {value};"]
        return [f"{TYPES[kind]} {name} = {value};"]

    def _assign(self, scope: Scope, _depth: int) -> list[str]:
        kind = self.random.choice(["int", "bool", "text", "text", "text", "options", "mode", "maybe", "list"])
        name = self.of.variable(scope, kind)
        if not name:
            return self._declare(scope, 0)
        if kind in ("text", "int") and self.of.chance(0.25):
            return [f"{name} += {self.of.value(scope, kind, 1)};"]
        if kind == "int" and self.of.chance(0.3):
            return [self.random.choice([f"++{name};", f"{name}++;", f"--{name};"])]
        return [f"{name} = {self.of.value(scope, kind)};"]

    def _change(self, scope: Scope, _depth: int) -> list[str]:
        kind = self.random.choice(["list", "map", "text", "maybe"])
        name, value = self.of.variable(scope, kind), self.of.value(scope, "text", 1)
        if not name:
            return self._declare(scope, 0)
        key = self.random.choice("ab")
        ways = {
            "list": [f"{name}.push_back({value});", f"{name}.emplace_back({value});", f"{name}.clear();",
                     f"if (!{name}.empty()) {{ {name}.pop_back(); }}",
                     f"if (!{name}.empty()) {{ {name}[0] = {value}; }}",
                     f"{name}.insert({name}.begin(), {value});"],
            "map": [f'{name}["{key}"] = {value};', f'{name}.erase("{key}");', f'{name}.insert({{"{key}", {value}}});',
                    f'{name}.emplace("{key}", {value});'],
            "text": [f"{name}.append({value});", f"{name}.clear();", f'{name} = "/" + {name};',
                     f"{name}.insert(0, {value});"],
            "maybe": [f"{name}.reset();", f"{name} = std::nullopt;", f"{name}.emplace({value});"],
        }  # fmt: skip
        return [self.random.choice(ways[kind])]

    def _call(self, scope: Scope, _depth: int) -> list[str]:
        kind = self.random.choice(["", "", "", "bool", "int", "text"])
        called = self.of.call(scope, kind, 0)
        return [f"{called};"] if called else self._assign(scope, 0)

    def _leave(self, scope: Scope, depth: int) -> list[str]:
        if scope.loops and self.of.chance(0.6):
            word = self.random.choice(["break", "continue"])
            return [f"if ({self.of.value(scope, 'bool')}) {{ {word}; }}"]
        if self.of.chance(0.15):
            return [f'if ({self.of.value(scope, "bool")}) {{ throw std::runtime_error("x"); }}']
        if scope.returns == "-":
            return self._assign(scope, depth)
        leave = f"return {self.of.value(scope, scope.returns)};" if scope.returns else "left(); return;"
        return [f"if ({self.of.value(scope, 'bool')}) {{ {leave} }}"]

    def _endpoint(self, scope: Scope, _depth: int) -> list[str]:
        name = self.of.value(scope, "text")
        quality = self.random.choice(
            ["10", "10", self.of.value(scope, "int", 1), f"rclcpp::QoS({self.of.value(scope, 'int', 1)})",
             "rclcpp::QoS(3).best_effort()", "rclcpp::SensorDataQoS()"]
        )  # fmt: skip
        node = scope.node
        arrow = "" if node == "this" else f"{node}->"
        what = self.random.randrange(8)
        if what == 0:
            empty = f"[](const std::shared_ptr<{_STRING}>) {{}}"
            return [f"{arrow}create_subscription<{_STRING}>({name}, {quality}, {empty});"]
        if what == 1:
            kind = self.random.choice(["bool", "int", "text"])
            given, value = self.name("set"), self.of.value(scope.inner(functions=[]), kind, 2)
            scope.add(kind, given)
            return [f"{TYPES[kind]} {given} = {arrow}declare_parameter<{TYPES[kind]}>({name}, {value});"]
        return [f"{arrow}create_publisher<{_STRING}>({name}, {quality});"]

    def _branch(self, scope: Scope, depth: int) -> list[str]:
        lines = [f"if ({self.of.value(scope, 'bool')}) {{", *self.block(scope, depth)]
        if self.of.chance(0.2):
            lines += [f"}} else if ({self.of.value(scope, 'bool')}) {{", *self.block(scope, depth)]
        if self.of.chance(0.4):
            lines += ["} else {", *self.block(scope, depth)]
        return [*lines, "}"]

    def _switch(self, scope: Scope, depth: int) -> list[str]:
        mode = self.of.chance(0.5)
        lines = [f"switch ({self.of.value(scope, 'mode' if mode else 'int')}) {{"]
        for label in self.random.sample(["Mode::A", "Mode::B", "Mode::C"] if mode else ["0", "1", "2"], 2):
            lines += [f"case {label}: {{", *self.block(scope, depth, loops=0)]
            lines += ["}"] if self.of.chance(0.3) else ["break; }"]
        if self.of.chance(0.5):
            lines += ["default: {", *self.block(scope, depth, loops=0), "}"]
        return [*lines, "}"]

    def _loop(self, scope: Scope, depth: int) -> list[str]:
        counter, inner = self.name("c"), scope.inner(loops=scope.loops + 1)
        way = self.random.randrange(6)
        if way == 0:
            inner.add("text", counter, constant=True)
            over = self.of.value(scope, "list")
            inner.variables["list"] = [one for one in inner.variables.get("list", []) if one != over]
            head = [f"for (const std::string & {counter} : {over}) {{"]
        elif way == 1 and scope.variables.get("map"):
            name = self.random.choice(scope.variables["map"])
            inner.add("text", f"{counter}.second", constant=True)
            head = [f"for (const auto & {counter} : std::map<std::string, std::string>({name})) {{"]
        elif way == 2:
            inner.add("int", counter, constant=True)
            question = self.of.unknown()
            head = [f"int {counter} = 0;", f"while ({counter} < 3 && {question}) {{", f"  ++{counter};"]
        elif way == 3:
            inner.add("int", counter, constant=True)
            lines = self.block(inner, depth)
            return [
                f"int {counter} = 0;",
                "do {",
                f"  ++{counter};",
                *lines,
                f"}} while ({counter} < {self.random.randint(1, 3)});",
            ]
        else:
            inner.add("int", counter, constant=True)
            end = self.random.choice(["2", "3", "0", self.of.value(scope, "int", 2)])
            limit = self.name("end")
            also = f" && {counter} < 5" if self.of.chance(0.3) else ""
            head = f"for (int {counter} = 0; {counter} < {limit}{also}; ++{counter}) {{"
            return [f"const int {limit} = {end};", head, *self.block(inner, depth), "}"]
        return [*head, *self.block(inner, depth), "}"]

    def _attempt(self, scope: Scope, depth: int) -> list[str]:
        lines = ["try {", *self.block(scope, depth)]
        if self.of.chance(0.7):
            lines += ["  risk();", *self.block(scope, depth)]
        return [*lines, "} catch (const std::exception & error) {", "  left();", *self.block(scope, depth), "}"]

    def _lambda_(self, scope: Scope, depth: int) -> list[str]:
        name = self.name("run")
        capture = "&" if self.of.chance(0.7) else "=, this" if scope.node == "this" else "="
        kind = self.random.choice(["text", "bool", ""])
        inner = scope.inner(returns=kind, loops=0)
        if capture != "&":
            inner.constants = {one: [*inner.constants.get(one, []), *inner.variables.get(one, [])]
                               for one in {*inner.constants, *inner.variables}}  # fmt: skip
            inner.variables = {}
        lines = [f"  {one}" for one in self.body(inner, self.random.randint(1, 2), depth + 1)]
        last = [f"  return {self.of.value(inner, kind)};"] if kind else []
        scope.functions.append((name, kind, ()))
        result = TYPES[kind] if kind else "void"
        return [
            f"auto {name} = [{capture}]() -> {result} {{",
            *lines,
            *last,
            "};",
            *([f"{name}();"] if self.of.chance(0.5) else []),
        ]

    def _alias(self, scope: Scope, _depth: int) -> list[str]:
        kind = self.random.choice(["text", "text", "options", "int", "bool", "list"])
        name = self.of.variable(scope, kind)
        if not name:
            return self._declare(scope, 0)
        other = self.name("ref")
        if self.of.chance(0.3):
            return [f"{TYPES[kind]} * {other} = &{name};", f"*{other} = {self.of.value(scope, kind)};"]
        scope.add(kind, other)
        return [f"{TYPES[kind]} & {other} = {name};"]
