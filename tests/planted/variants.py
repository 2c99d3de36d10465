"""The same mistake as different people write it: other names, other surroundings, other layout.

A variant has a number; from it follow names, surroundings and layout, so that twenty of them are twenty different
texts. What is between quotation marks stays as it is.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection

import tree_sitter_cpp
import tree_sitter_python
from tree_sitter import Language, Node, Parser

VARIANTS = 20
UNFIT: dict[str, tuple[frozenset[str], str]] = {
    **dict.fromkeys(
        ("node.endpoint_in_callback", "node.log_in_fast_path", "node.parameter_in_callback", "node.publish_too_early"),
        (frozenset({"_in_a_branch"}), "what stands in a condition may run once: it is let be on purpose"),
    ),
    "python.work_on_import": (frozenset({"_if", "_def"}), "inside of a function or a condition it is no mistake"),
    "node.spin_missing_python": (frozenset({"_def"}), "inside of a function that nothing calls, nothing runs"),
    "cpp.misleading_indentation": (frozenset({"_line_by_line"}), "the layout is the mistake"),
}
"""Surroundings and layouts by the names of their functions in which the example of a rule is no mistake, and why."""
_CPP, _PYTHON = (Parser(Language(one.language())) for one in (tree_sitter_cpp, tree_sitter_python))
_CLASSES = ("Gripper", "Planner", "LidarDriver", "DockingServer", "BatteryMonitor")
_QUOTED = re.compile(r'("(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\')')
_OWN = frozenset({"main", "argc", "argv", "self", "cls", "nh", "node", "rclcpp", "ros", "std"})
_HOOK = re.compile(r"on[A-Z_]|__|operator|~")
"""Names that a framework calls."""


def variant(text: str, syntax: str, number: int, rule: str = "") -> str:
    """Return a text that breaks a rule in another form; number 0 is as it is written.

    Args:
        text: that breaks it.
        syntax: ``cpp`` or ``python``.
        number: of the variant.
        rule: id, for what does not fit it.
    """
    unfit = UNFIT.get(rule, (frozenset(), ""))[0]
    if syntax == "python":
        return _python(text, number, unfit)
    text = renamed(text, "cpp", number) if number % 2 else text
    head, body = split(text)
    around = _AROUND_CPP[number % len(_AROUND_CPP)]
    layout = _LAYOUT_CPP[(number // 2) % len(_LAYOUT_CPP)]
    around = _alone if around.__name__ in unfit else around
    layout = _as_written if layout.__name__ in unfit else layout
    return head + layout(around(body, number))


def split(text: str) -> tuple[str, str]:
    """Return the includes that a text begins with, and the rest."""
    lines = text.splitlines(keepends=True)
    count = next((at for at, line in enumerate(lines) if not line.startswith("#include")), len(lines))
    return "".join(lines[:count]), "".join(lines[count:])


def renamed(text: str, syntax: str, number: int) -> str:
    """Return a text with other names for what it declares itself: classes, functions, members, variables."""
    root = (_CPP if syntax == "cpp" else _PYTHON).parse(text.encode()).root_node
    names = _declared_cpp(root) if syntax == "cpp" else _declared_python(root)
    fresh: dict[str, str] = {}
    for name in sorted(names):
        if name in _OWN or _HOOK.match(name) or len(name) < 2:
            continue
        if name[0].isupper():
            fresh[name] = f"{_CLASSES[(number + len(fresh)) % len(_CLASSES)]}{len(fresh) or ''}"
        else:
            fresh[name] = (
                f"front_{name}" if number % 3 else f"{name.rstrip('_')}_two{'_' if name.endswith('_') else ''}"
            )
    if not fresh:
        return text
    words = re.compile(rf"(?<![\w.>/<\"-])(?:{'|'.join(map(re.escape, fresh))})\b(?!\s*[./]h)")
    kept = re.compile(r"^\s*(?:#include|import|from)\b.*$", re.MULTILINE)
    spared = [match.span() for match in kept.finditer(text)]
    parts, at = [], 0
    for match in _QUOTED.finditer(text):
        parts.append(_replace(text, at, match.start(), words, fresh, spared))
        parts.append(match[0])
        at = match.end()
    return "".join((*parts, _replace(text, at, len(text), words, fresh, spared)))


def _replace(
    text: str, start: int, end: int, words: re.Pattern[str], fresh: dict[str, str], spared: list[tuple[int, int]]
) -> str:
    out, at = [], start
    for match in words.finditer(text, start, end):
        if any(a <= match.start() < b for a, b in spared):
            continue
        out.append(text[at : match.start()])
        out.append(fresh[match[0]])
        at = match.end()
    return "".join((*out, text[at:end]))


def _declared_cpp(root: Node) -> set[str]:
    """Return the names that are declared and used in one way only, so that a text can be renamed by words."""
    found: set[str] = set()
    members = {one.text.decode() for one in _below(root, "field_identifier") if one.text}
    for node in _below(root, "class_specifier", "struct_specifier", "function_declarator", "init_declarator"):
        part = node.child_by_field_name("name") or node.child_by_field_name("declarator")
        if node.type in ("class_specifier", "struct_specifier") and node.child_by_field_name("body") is None:
            continue
        if part is not None and part.type in ("identifier", "type_identifier") and part.text:
            found.add(part.text.decode())
        if part is not None and part.type == "qualified_identifier" and node.type == "function_declarator":
            scope = part.child_by_field_name("scope")
            if scope is not None and scope.type == "namespace_identifier" and scope.text:
                found.add(scope.text.decode())
    plain = {one.text.decode() for one in _below(root, "identifier") if one.text}
    found |= {one for one in members | plain if one.endswith("_")}
    called = {one.text.decode() for one in _below(root, "type_identifier", "namespace_identifier") if one.text}
    return {one for one in found if one not in members or one.endswith("_")} - ({"std"} & called)


def _declared_python(root: Node) -> set[str]:
    found = set()
    for node in _below(root, "class_definition", "function_definition"):
        name = node.child_by_field_name("name")
        if name is not None and name.text:
            found.add(name.text.decode())
    for node in _below(root, "assignment"):
        left = node.child_by_field_name("left")
        if left is not None and left.type == "identifier" and left.text:
            found.add(left.text.decode())
    attributes = {one.text.decode().rpartition(".")[2] for one in _below(root, "attribute") if one.text}
    keywords = {one.children[0].text.decode() for one in _below(root, "keyword_argument") if one.children[0].text}
    return found - attributes - keywords


def _below(node: Node, *kinds: str) -> list[Node]:
    found, waiting = [], [node]
    while waiting:
        one = waiting.pop()
        found += [one] if one.type in kinds else []
        waiting += one.children
    return found


def _alone(body: str, number: int) -> str:
    return body


def _in_namespace(body: str, number: int) -> str:
    return body if "main(" in body else f"namespace robot_{number}\n{{\n{body}}}  // namespace robot_{number}\n"


def _in_two_namespaces(body: str, number: int) -> str:
    return body if "main(" in body else f"namespace a_{number} {{\nnamespace b {{\n{body}}}\n}}\n"


def _between(body: str, number: int) -> str:
    before = f"static int ticks_{number}(int from) {{ return from + {number}; }}\n"
    return f"{before}{body}struct After{number} {{ double x = 0.0; }};\n"


def _with_statements(body: str, number: int) -> str:
    return _in_bodies(body, f"\nint turns_{number} = 0;\n(void)turns_{number};\n", "")


def _in_a_branch(body: str, number: int) -> str:
    return _in_bodies(body, f"\nif (ready_{number}) {{\n", "\n}\n")


def _in_bodies(text: str, before: str, after: str) -> str:
    """Return a text with something at the beginning and the end of each outermost body of a function."""
    root = _CPP.parse(text.encode()).root_node
    content = text.encode()
    spans = []
    for node in _below(root, "function_definition"):
        body = node.child_by_field_name("body")
        if body is not None and body.type == "compound_statement" and body.named_child_count:
            spans.append((body.start_byte + 1, body.end_byte - 1))
    for start, end in sorted(spans, reverse=True):
        if any(a < start and end < b for a, b in spans):
            continue
        content = content[:start] + before.encode() + content[start:end] + after.encode() + content[end:]
    return content.decode()


_AROUND_CPP: tuple[Callable[[str, int], str], ...] = (
    _alone,
    _in_namespace,
    _with_statements,
    _between,
    _in_a_branch,
    _in_two_namespaces,
)


def _as_written(text: str) -> str:
    return text


def _line_by_line(text: str) -> str:
    """Return a text with a statement a line, as formatters write it."""
    return _at_depth(text, lambda char, depth: f"{char}\n" if char in "{;}" and depth == 0 else char)


def _argument_by_argument(text: str) -> str:
    """Return a text with each argument on a line of its own."""
    return _at_depth(text, lambda char, depth: f"{char}\n    " if char == "," and depth > 0 else char)


def _wide(text: str) -> str:
    """Return a text with white space inside of parentheses."""
    return _at_depth(text, lambda char, depth: {"(": "( ", ")": " )"}.get(char, char))


def _with_tabs(text: str) -> str:
    return "".join(f"\t{line}" if line.strip() and not line.startswith("#") else line for line in text.splitlines(True))


_LAYOUT_CPP: tuple[Callable[[str], str], ...] = (
    _as_written,
    _line_by_line,
    _argument_by_argument,
    _wide,
    _with_tabs,
)


def _at_depth(text: str, change: Callable[[str, int], str]) -> str:
    """Return a text changed character by character, by how many parentheses are open; directives and quotes stay."""
    out, depth = [], 0
    for line in text.splitlines(keepends=True):
        if line.lstrip().startswith(("#", "//", "*", "/*")):
            out.append(line)
            continue
        for part in _QUOTED.split(line):
            if _QUOTED.fullmatch(part):
                out.append(part)
                continue
            code, comment, rest = part.partition("//")
            for char in code:
                depth += char == "("
                out.append(change(char, depth))
                depth -= char == ")"
            out.append(comment + rest)
    return "".join(out)


def _python(text: str, number: int, unfit: Collection[str]) -> str:
    text = text if text.endswith("\n") else f"{text}\n"
    text = renamed(text, "python", number) if number % 2 else text
    lines = text.splitlines(keepends=True)
    count = next((at for at, line in enumerate(lines) if not re.match(r"(?:import|from)\s(?!.*\*)", line)), len(lines))
    head, body = "".join(lines[:count]), "".join(lines[count:])
    if not body.strip():
        return text
    around = _AROUND_PYTHON[number % len(_AROUND_PYTHON)]
    if around.__name__ in unfit or (around is _def and re.search(r"^from .* import \*", body, re.MULTILINE)):
        around = _between_assignments
    body = around(body, number)
    if number % 4 == 3 and '"' not in body and "\\" not in body:
        body = re.sub(r"'([^'\n]*)'", r'"\1"', body)
    return head + body


def _if(body: str, number: int) -> str:
    return f"if READY_{number}:\n{_indented(body)}"


def _def(body: str, number: int) -> str:
    return f"def planted_{number}():\n{_indented(body)}"


def _try(body: str, number: int) -> str:
    return f"try:\n{_indented(body)}finally:\n    print({number})\n"


def _between_assignments(body: str, number: int) -> str:
    return f"COUNT_{number} = 0\n{body}\nAFTER_{number} = COUNT_{number}\n"


_AROUND_PYTHON: tuple[Callable[[str, int], str], ...] = (_alone, _if, _def, _try, _between_assignments)


def _indented(text: str) -> str:
    return "".join(f"    {line}" if line.strip() else line for line in text.splitlines(keepends=True))
