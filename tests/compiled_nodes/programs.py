"""Random nodes: functions, classes and members around statements, each in a namespace of its own."""

from __future__ import annotations

from random import Random

from compiled_nodes.expressions import TYPES, Scope
from compiled_nodes.statements import Statements

_VERBS = (
    "check",
    "compute",
    "init_names",
    "setup",
    "update",
    "find",
    "load_all",
    "prepare",
    "reset_state",
    "create_all",
)


class Maker:
    """Writes one program."""

    def __init__(self, seed: int, name: str) -> None:
        """Begin a program in a namespace of this name; equal seeds make equal programs."""
        self.random = Random(seed)
        self.write = Statements(self.random)
        self.of = self.write.of
        self.namespace = name

    def program(self) -> str:
        """Return the program."""
        outer = Scope()
        lines = [
            f"namespace {self.namespace} {{",
            "enum class Mode { A, B, C };",
            *self._options(),
            *self._globals(outer),
        ]
        for _ in range(self.random.randint(0, 3)):
            lines += self._function(outer)
        lines += self._shape(outer)
        lines += self._node(outer)
        return "\n".join([*lines, f"}}  // namespace {self.namespace}"]) + "\n"

    def _options(self) -> list[str]:
        return ["struct Options {", '  std::string name = "o";', "  int depth = 3;", "  bool on = false;", "};"]

    def _globals(self, scope: Scope) -> list[str]:
        lines = ['const std::string kName = "kept";', "constexpr int kDepth = 2;", "constexpr bool kOn = true;"]
        scope.add("text", "kName", constant=True)
        scope.add("int", "kDepth", constant=True)
        scope.add("bool", "kOn", constant=True)
        if self.of.chance(0.3):
            kind = self.random.choice(["text", "int", "bool"])
            value = {"text": '"g"', "int": "1", "bool": "false"}[kind]
            lines.append(f"static {TYPES[kind]} g_{kind} = {value};")
            scope.add(kind, f"g_{kind}")
        return lines

    def _parameters(self, inner: Scope, node: bool) -> tuple[str, tuple[str, ...]]:
        written, kinds = [], []
        if node:
            written.append("rclcpp::Node * owner")
            kinds.append("node")
            inner.node = "owner"
        for number in range(self.random.randint(0, 2)):
            kind = self.random.choice(["text", "int", "bool", "text&", "int&", "options&", "options", "list&", "list"])
            name = f"given{number}"
            if kind[-1] == "&":
                written.append(f"{TYPES[kind[:-1]]} & {name}")
            else:
                written.append(f"const std::string & {name}" if kind == "text" else f"{TYPES[kind]} {name}")
            inner.add(kind.rstrip("&"), name, constant=kind == "text")
            kinds.append(kind)
        return ", ".join(written), tuple(kinds)

    def _function(self, scope: Scope, member: bool = False, before: str = "", after: str = "") -> list[str]:
        kind = self.random.choice(["text", "bool", "int", "", "", "options", "list", "maybe"])
        name = self.write.name(self.random.choice(_VERBS) + "_")
        inner = scope.inner(returns=kind)
        parameters, kinds = self._parameters(inner, not member and self.of.chance(0.3))
        lines = self.write.padding() if self.of.chance(0.45) else []
        lines += self.write.body(inner, self.random.randint(1, 4))
        if kind:
            lines.append(f"return {self.of.value(inner, kind)};")
        scope.functions.append((name, kind, kinds))
        head = f"{before}{TYPES[kind] if kind else 'void'} {name}({parameters}){after} {{"
        return [head, *(f"  {one}" for one in lines), "}"]

    def _shape(self, scope: Scope) -> list[str]:
        """Return a class with a virtual method, and one that overrides it."""
        if not self.of.chance(0.4):
            return []
        one, other = self.of.value(scope, "text", 1), self.of.value(scope, "text", 1)
        flag = self.of.value(scope, "bool", 2)
        methods = [f"{name}().{method}" for name in ("Shape", "Round") for method in ("title", "whole")]
        scope.functions += [(one, "text", ()) for one in methods]
        return [
            "struct Shape {", "  virtual ~Shape() {}", f"  virtual std::string title() {{ return {one}; }}",
            '  std::string whole() { return title() + "/w"; }', "};", "struct Round : public Shape {",
            f"  std::string title() override {{ if ({flag}) {{ return Shape::title(); }} return {other}; }}", "};",
        ]  # fmt: skip

    def _node(self, scope: Scope) -> list[str]:
        members = scope.inner(node="this", returns="")
        fields = []
        values = {
            "text": '"m"',
            "int": "1",
            "bool": "false",
            "options": "",
            "list": "",
            "mode": "Mode::A",
            "maybe": "",
            "map": "",
        }
        for kind in self.random.sample(list(values), self.random.randint(2, 5)):
            name = f"{kind}_"
            fields.append(f"  {TYPES[kind]} {name}{' = ' + values[kind] if values[kind] else ''};")
            members.add(kind, name)
        based = self.of.chance(0.3)
        lines = []
        if based:
            lines += ["class Root : public rclcpp::Node {", "public:",
                      f'  Root() : rclcpp::Node("{self.namespace}") {{', *self._inside(scope), "    hook();", "  }",
                      "  virtual void hook() {", *self._inside(scope), "  }", "};"]  # fmt: skip
        methods: list[str] = []
        for _ in range(self.random.randint(0, 4)):
            methods += self._function(members, member=True)
        if based:
            inner = members.inner()
            methods += ["void hook() override {", *(f"  {one}" for one in self.write.body(inner, 2)), "}"]
            members.functions.append(("hook", "", ()))
        body = self.write.body(members.inner(), self.random.randint(3, 7))
        base = "Root()" if based else f'rclcpp::Node("{self.namespace}")'
        lines += [f"class Talker : public {'Root' if based else 'rclcpp::Node'} {{", "public:",
                  f"  Talker() : {base} {{", *(f"    {one}" for one in body), "  }",
                  *(f"  {one}" for one in methods), *fields, "};"]  # fmt: skip
        return lines

    def _inside(self, scope: Scope) -> list[str]:
        return [f"    {one}" for one in self.write.body(scope.inner(node="this"), 1)]


def program(seed: int, name: str) -> str:
    """Return the program of a seed, without includes."""
    return Maker(seed, name).program()
