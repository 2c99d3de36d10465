"""A launch file in Python as rules see it: its calls of launch and launch_ros, and what sort of value each argument is.

A name stands for its value where one plain assignment binds it. Of everything else nothing is said: a class of the file
that is derived from ``Node``, a wrapper, ``**kwargs``.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from tree_sitter import Node

from roslens.source.rules.file_view import FileView
from roslens.source.rules.signatures.read_signatures import ENTITY, Signature, signature_of
from roslens.source.rules.views.python_names import PythonNames, Scope, text_of

MENTIONS = ("from launch", "import launch")
"""What each file holds that uses launch."""
LIBRARIES = frozenset({"launch", "launch_ros", "launch_xml", "launch_yaml"})
TEXT, NUMBER, TRUTH, NOTHING, LIST, TUPLE, DICTIONARY, SET, ITEMS, FUNCTION, CLASS = (
    "text", "number", "bool", "None", "list", "tuple", "dict", "set", "items", "function", "class",
)  # fmt: skip
"""Sorts of values; the kinds of classes of launch are others, and ``object`` is one of another class of it."""
OBJECT = "object"
_LITERALS = {
    "string": TEXT, "concatenated_string": TEXT, "integer": NUMBER, "float": NUMBER, "true": TRUTH, "false": TRUTH,
    "none": NOTHING, "list": LIST, "list_comprehension": LIST, "tuple": TUPLE, "dictionary": DICTIONARY,
    "dictionary_comprehension": DICTIONARY, "set": SET, "set_comprehension": SET, "lambda": FUNCTION,
    "comparison_operator": TRUTH, "not_operator": TRUTH,
}  # fmt: skip
_TEXTS = frozenset({
    "str", "os.path.join", "os.path.dirname", "os.path.abspath", "os.getenv", "os.environ.get",
    "ament_index_python.packages.get_package_share_directory", "ament_index_python.get_package_share_directory",
})  # fmt: skip
_OF_TYPES = {
    "list": LIST, "dict": DICTIONARY, "tuple": TUPLE, "set": SET, "int": NUMBER, "float": NUMBER, "bool": TRUTH,
}  # fmt: skip
_DEEPEST = 12


class LaunchCall(msgspec.Struct, frozen=True, eq=False):
    """A call of a class of launch.

    Attributes:
        node: of the call.
        signature: of the class.
        positional: arguments by position.
        keywords: arguments by name.
        names: the nodes of these names.
        is_whole: all arguments are written, none comes out of ``*`` or ``**``.
    """

    node: Node
    signature: Signature
    positional: tuple[Node, ...]
    keywords: dict[str, Node]
    names: dict[str, Node]
    is_whole: bool

    @property
    def name(self) -> str:
        """The name of the class, without its module."""
        return self.signature.name.rpartition(".")[2]

    def argument(self, name: str) -> Node | None:
        """Return an argument by the name of its parameter, however it is given."""
        if name in self.keywords:
            return self.keywords[name]
        places = self.signature.positional
        place = places.index(name) if name in places else len(self.positional)
        return self.positional[place] if place < len(self.positional) and "*" not in places[: place + 1] else None


class LaunchCode:
    """The code of a launch file.

    Attributes:
        view: of the file.
        names: of the file.
        imports: what each imported name means, by its full name.
        calls: of classes of launch, in order.
    """

    def __init__(self, view: FileView) -> None:
        """Read a file."""
        self.view = view
        self.names = PythonNames(view.root)
        self.imports = dict(_imports(view.root))
        self.calls: list[LaunchCall] = []
        self._by_node: dict[int, LaunchCall] = {}
        self.other_calls: list[Node] = []
        for node in _calls(view.root):
            call = self._call(node)
            if call is None:
                self.other_calls.append(node)
            else:
                self.calls.append(call)
                self._by_node[node.id] = call

    def call(self, node: Node | None) -> LaunchCall | None:
        """Return the call of a class of launch that a node is."""
        return None if node is None else self._by_node.get(node.id)

    def full_name(self, node: Node | None) -> str:
        """Return the full name that an expression means by an import; empty where it means something else."""
        written = text_of(node)
        head, dot, rest = written.partition(".")
        if node is None or node.type not in ("identifier", "attribute") or not written.replace(".", "").isidentifier():
            return ""
        scope = self.names.scope_of(node).finds(head)
        if scope is None:
            return "" if dot else written
        bound = scope.bound[head]
        meant = {self.imports.get(one.id, "") for one in bound}
        if len(meant) != 1 or "" in meant:
            return ""
        return f"{meant.pop()}{dot}{rest}"

    def value(self, node: Node | None, depth: int = 0) -> Node | None:
        """Return the expression that a value is written as: of a name, what it is assigned, where that is one."""
        while node is not None and node.type == "parenthesized_expression" and node.named_child_count == 1:
            node = node.named_children[0]
        if node is None or node.type != "identifier" or depth > _DEEPEST:
            return node
        scope = self.names.scope_of(node).finds(text_of(node))
        bound = scope.bound[text_of(node)] if scope is not None else []
        if len(bound) != 1 or bound[0].type != "assignment":
            return node
        left, right = bound[0].child_by_field_name("left"), bound[0].child_by_field_name("right")
        if left is None or left.type != "identifier" or right is None:
            return node
        return self.value(right, depth + 1)

    def sort(self, node: Node | None, depth: int = 0) -> str:
        """Return what sort of value an expression is; empty where that is not known."""
        found = self.value(node)
        if found is None or depth > _DEEPEST:
            return ""
        if found.type in _LITERALS:
            return self._of_literal(found)
        match found.type:
            case "call":
                return self._of_call(found)
            case "conditional_expression":
                sorts = {self.sort(one, depth + 1) for one in (found.named_children[0], found.named_children[-1])}
                return sorts.pop() if len(sorts) == 1 else ""
            case "binary_operator":
                sides = [self.sort(found.child_by_field_name(one), depth + 1) for one in ("left", "right")]
                same = sides[0] if sides[0] == sides[1] and sides[0] in (TEXT, LIST, TUPLE, NUMBER) else ""
                return LIST if LIST in sides and _operator(found) == "+" else same
            case "unary_operator":
                return self.sort(found.child_by_field_name("argument"), depth + 1)
            case "identifier" | "attribute":
                return CLASS if signature_of(self.full_name(found)) is not None else ""
        return ""

    def is_substitution(self, node: Node | None) -> bool:
        """Return whether an expression is an object of a substitution."""
        return self.sort(node) == "substitution"

    def items(self, node: Node | None) -> tuple[Node, ...]:
        """Return the items of a list or tuple that is written out, but for what is spread into it."""
        found = self.value(node)
        if found is None or found.type not in ("list", "tuple", "set"):
            return ()
        return tuple(one for one in found.named_children if one.type not in ("comment", "list_splat"))

    def pairs(self, node: Node | None) -> tuple[tuple[Node, Node], ...]:
        """Return keys and values of a dictionary that is written out."""
        found = self.value(node)
        pairs = [one for one in found.named_children if one.type == "pair"] if found is not None else []
        both = [(one.child_by_field_name("key"), one.child_by_field_name("value")) for one in pairs]
        return tuple((key, value) for key, value in both if key is not None and value is not None)

    def text(self, node: Node | None) -> str | None:
        """Return a text that is written out; None for what is none, or is made of other values."""
        found = self.value(node)
        if found is None or found.type not in ("string", "concatenated_string"):
            return None
        parts = found.named_children if found.type == "concatenated_string" else [found]
        if any(one.type == "interpolation" for part in parts for one in part.named_children):
            return None
        written = [one for part in parts for one in part.named_children if one.type == "string_content"]
        return "".join(text_of(one) for one in written)

    def _of_literal(self, node: Node) -> str:
        return _LITERALS[node.type]

    def _of_call(self, node: Node) -> str:
        call = self.call(node)
        if call is not None:
            return call.signature.kind or OBJECT
        function = node.child_by_field_name("function")
        name = self.full_name(function)
        if name in _TEXTS:
            return TEXT
        if name in _OF_TYPES:
            return _OF_TYPES[name]
        if function is not None and function.type == "attribute":
            of, called = function.child_by_field_name("object"), text_of(function.child_by_field_name("attribute"))
            if called == "items" and self.sort(of) == DICTIONARY:
                return ITEMS
            if called in ("perform", "format", "join", "lower", "strip") and self.sort(of) in ("substitution", TEXT):
                return TEXT
        return ""

    def _call(self, node: Node) -> LaunchCall | None:
        signature = signature_of(self.full_name(node.child_by_field_name("function")))
        arguments = node.child_by_field_name("arguments")
        if signature is None or arguments is None or arguments.type != "argument_list":
            return None
        keywords, names, positional, is_whole = {}, {}, [], True
        for one in arguments.named_children:
            if one.type == "keyword_argument":
                name, value = one.child_by_field_name("name"), one.child_by_field_name("value")
                if name is not None and value is not None:
                    keywords[text_of(name)], names[text_of(name)] = value, name
            elif one.type in ("list_splat", "dictionary_splat"):
                is_whole = False
            elif one.type != "comment":
                positional.append(one)
        return LaunchCall(node, signature, tuple(positional), keywords, names, is_whole)


def launch_code(view: FileView) -> LaunchCode | None:
    """Return the code of a file that uses launch, made once; None for one that has errors or uses none of it."""
    kept = view.kept.get(LaunchCode)
    if kept is None:
        is_other = view.root.has_error or not any(one.partition(".")[0] in LIBRARIES for _, one in _imports(view.root))
        kept = view.kept[LaunchCode] = "" if is_other else LaunchCode(view)
    return kept if isinstance(kept, LaunchCode) else None


def scope_at(code: LaunchCode, node: Node) -> Scope:
    """Return the scope around a node."""
    return code.names.scope_of(node)


def imported(node: Node) -> str:
    """Return the name that is imported by a part of an import, whatever it is called in the file."""
    return text_of(node.child_by_field_name("name") if node.type == "aliased_import" else node)


def _imports(root: Node) -> Iterator[tuple[int, str]]:
    """Yield the nodes of imported names, by their id, with their full names."""
    for node in _of_types(root, ("import_from_statement",)):
        module = text_of(node.child_by_field_name("module_name"))
        yield from ((one.id, f"{module}.{imported(one)}") for one in node.children_by_field_name("name"))
    for node in _of_types(root, ("import_statement",)):
        for one in node.children_by_field_name("name"):
            name = imported(one)
            yield one.id, name if one.type == "aliased_import" else name.partition(".")[0]


def _calls(root: Node) -> Iterator[Node]:
    return _of_types(root, ("call",))


def _of_types(root: Node, types: tuple[str, ...]) -> Iterator[Node]:
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if node.type in types:
            yield node
        waiting.extend(reversed(node.children))


def _operator(node: Node) -> str:
    return text_of(node.child_by_field_name("operator"))


def shown(node: Node, code: LaunchCode, most: int = 60) -> str:
    """Return the beginning of an expression on one line, as a message quotes it."""
    text = " ".join(code.view.text(node).split())
    return f"`{text}`" if len(text) <= most else f"`{text[: most - 1]}…`"


def in_words(sort: str) -> str:
    """Return a sort of value as a message says it."""
    names = {NUMBER: "a number", TRUTH: "a bool", NOTHING: "None", DICTIONARY: "a dictionary", ENTITY: "a description"}
    article = "an" if sort[:1] in "aeo" else "a"
    return names.get(sort, f"{article} {sort}")


def tested(node: Node) -> Iterator[Node]:
    """Yield the expressions whose truth a statement or operator asks for; none for other nodes."""
    match node.type:
        case "boolean_operator":
            yield from _operands(node)
        case "conditional_expression":
            yield from node.named_children[1:2] if node.named_child_count == 3 else ()
        case "not_operator":
            yield from node.children_by_field_name("argument")
        case "if_statement" | "elif_clause" | "while_statement":
            yield from node.children_by_field_name("condition")


def _operands(node: Node) -> Iterator[Node]:
    """Yield the operands of ``and`` and ``or`` that are tested: the last one only where the result is."""
    yield from node.children_by_field_name("left")
    parent = node.parent
    if parent is not None and node in tested(parent):
        yield from node.children_by_field_name("right")
