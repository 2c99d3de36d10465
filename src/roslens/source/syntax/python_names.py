"""Names in Python source: of callees, types, parameters, bases and decorators, and the access that they imply."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

_NAME = re.compile(r"[^\W\d]\w*(?:\s*\.\s*[^\W\d]\w*)*")
_LAST_NAME = re.compile(r"[^\W\d]\w*\Z")
_PLAIN_NAME = re.compile(r"[^\W\d]\w*(?:\.[^\W\d]\w*)*")
_CLASS_LIKE = re.compile(r"_*[A-Z]")
_LITERAL = re.compile(r"\bLiteral\s*\[[^\]]*\]")

_NOT_CLASSES_WORDS = (
    "None True False int float complex bool str bytes bytearray memoryview object type list dict set frozenset tuple "
    "range slice basestring unicode long file self cls "
    "Any AnyStr Annotated Awaitable Callable ClassVar Concatenate Coroutine Collection Container Counter DefaultDict "
    "Deque Dict Final FrozenSet Generator Generic Hashable Iterable Iterator AsyncIterable AsyncIterator "
    "AsyncGenerator List Literal LiteralString Mapping MutableMapping MutableSequence MutableSet Never NewType "
    "NoReturn NotRequired Optional OrderedDict ParamSpec Protocol Required Reversible Self Sequence Set Sized "
    "Text Tuple Type TypeAlias TypeGuard TypeVar TypedDict Union Unpack"
)
NOT_CLASSES = frozenset(_NOT_CLASSES_WORDS.split())
"""Names in annotations that name no class of a project: built-in types and what ``typing`` builds types with."""

_PARAMETER_FIELDS = {"default_parameter": "name", "typed_default_parameter": "name"}
_NO_PARAMETERS = frozenset({"comment", "keyword_separator", "positional_separator", "ERROR"})


def text_of(name: bytes) -> str:
    """Return ``name`` as text; bytes that are no UTF-8 stay recognisable."""
    return name.decode("utf-8", "backslashreplace")


def callee_name(written: bytes, bound: frozenset[str]) -> str:
    """Return the name of a callee without its receiver, or nothing where it has no name.

    Args:
        written: what stands before the parentheses (its end, where it is long).
        bound: names that imports and classes of the file bind; a path that starts with one is kept
            (``rospy.Publisher``), since a module or a class is no receiver.
    """
    text = text_of(written)
    if _PLAIN_NAME.fullmatch(text):
        root, dot, _ = text.partition(".")
        if not dot or root in bound:
            return text
    match = _LAST_NAME.search(text)
    return match[0] if match else ""


def is_class_like(name: str) -> bool:
    """Whether a callee's name looks like a class: capitalised, not written in capitals throughout."""
    last = name.rpartition(".")[2]
    return _CLASS_LIKE.match(last) is not None and not (last.isupper() and len(last) > 1) and last not in NOT_CLASSES


def annotated(annotation: bytes) -> Iterator[str]:
    """Yield the class-like names in an annotation, those in quotes too, without built-in and ``typing`` names."""
    for match in _NAME.finditer(_LITERAL.sub("", text_of(annotation))):
        name = "".join(match[0].split())
        if name.rpartition(".")[2] not in NOT_CLASSES:
            yield name


def access_of(name: str) -> str:
    """Return the access that the underscores of a member's name stand for."""
    if name.startswith("__"):
        return "public" if name.endswith("__") and len(name) > 4 else "private"
    return "protected" if name.startswith("_") else "public"


def decorator_name(written: bytes) -> str:
    """Return the name in a decorator: ``app.route`` for ``@app.route("/")``."""
    text = text_of(written).lstrip("@ \t")
    match = _NAME.match(text)
    return "".join(match[0].split()) if match else " ".join(text.split())[:80]


def parameter_names(definition: Node) -> tuple[str, ...]:
    """Return the parameters of a function as written, without types and defaults but with their stars."""
    parameters = definition.child_by_field_name("parameters")
    if parameters is None:
        return ()
    names = []
    for node in parameters.named_children:
        if node.type in _NO_PARAMETERS:
            continue
        field = _PARAMETER_FIELDS.get(node.type)
        named = node.child_by_field_name(field) if field else node
        if node.type == "typed_parameter":
            named = node.named_child(0)
        if named is not None and named.text:
            names.append("".join(text_of(named.text).split()))
    return tuple(names)


def base_names(definition: Node) -> tuple[str, ...]:
    """Return the bases of a class as written, without type arguments, keywords and what is called."""
    bases = definition.child_by_field_name("superclasses")
    if bases is None:
        return ()
    names = []
    for node in bases.named_children:
        if node.type in {"identifier", "attribute", "subscript", "call"} and node.text:
            match = _NAME.match(text_of(node.text))
            if match:
                names.append("".join(match[0].split()))
    return tuple(names)


def definition_name(definition: Node) -> str:
    """Return the name of a function or class."""
    name = definition.child_by_field_name("name")
    return text_of(name.text) if name is not None and name.text else ""
