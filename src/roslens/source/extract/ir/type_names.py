"""What a written type of C++ names: its class without pointers, and its template arguments."""

from __future__ import annotations

from functools import lru_cache

_SMART = frozenset(
    {"std.shared_ptr", "std.unique_ptr", "std.weak_ptr", "boost.shared_ptr", "boost.scoped_ptr", "boost.weak_ptr",
     "std.optional", "boost.optional", "std.reference_wrapper", "std.atomic", "shared_ptr", "unique_ptr", "weak_ptr"}
)  # fmt: skip
POINTER_NAMES = frozenset({"SharedPtr", "WeakPtr", "UniquePtr", "ConstSharedPtr", "ConstWeakPtr", "ConstUniquePtr"})
NUMBER_TYPES = frozenset(
    {"int", "double", "float", "bool", "size_t", "unsigned", "long", "short", "uint8_t", "uint16_t", "uint32_t",
     "uint64_t", "int8_t", "int16_t", "int32_t", "int64_t"}
)  # fmt: skip
"""Names of types of C++ that are numbers, or are taken as such."""
_QUALIFIERS = frozenset(
    {"const", "constexpr", "static", "inline", "mutable", "typename", "struct", "class", "volatile"}
)


@lru_cache(maxsize=50_000)
def dotted(written: str) -> str:
    """Return a C++ type or name with ``.`` between scopes and without template arguments."""
    depth, kept = 0, []
    for sign in written:
        depth += (sign == "<") - (sign == ">")
        if not depth and sign != ">":
            kept.append(sign)
    return "".join(kept).replace("::", ".").strip(" .&*")


@lru_cache(maxsize=50_000)
def type_name(written: str) -> tuple[str, str]:
    """Return the class that a declared type means, without smart pointers, and its template arguments."""
    text = " ".join(word for word in written.replace("&", " ").replace("*", " ").split() if word not in _QUALIFIERS)
    for _ in range(5):
        head, bracket, rest = text.partition("<")
        inside = rest.rpartition(">")[0]
        name = dotted(head)
        if bracket and name in _SMART:
            text = " ".join(word for word in _first(inside).split() if word not in _QUALIFIERS)
            continue
        tail = rest.rpartition(">")[2]
        if tail.startswith("::"):
            return _pointed(f"{name}{tail.replace('::', '.')}".strip(" .")), inside
        return _pointed(name.strip()), inside
    return dotted(text), ""


def _pointed(name: str) -> str:
    """Return the class that a smart pointer declared in it points to: ``rclcpp.Node.SharedPtr``."""
    head, _, last = name.rpartition(".")
    return head if head and last in POINTER_NAMES else name


def _first(arguments: str) -> str:
    depth = 0
    for place, sign in enumerate(arguments):
        depth += (sign in "<(") - (sign in ">)")
        if sign == "," and not depth:
            return arguments[:place]
    return arguments


def type_arguments(written: str) -> list[str]:
    """Return template arguments one by one."""
    found, depth, begin = [], 0, 0
    for place, sign in enumerate(written):
        depth += (sign in "<(") - (sign in ">)")
        if sign == "," and not depth:
            found.append(written[begin:place].strip())
            begin = place + 1
    last = written[begin:].strip()
    return [*found, last] if last else found


@lru_cache(maxsize=20_000)
def scopes(scope: str) -> tuple[str, ...]:
    """Return what may stand before a name in a scope, the innermost first: ``a.b.``, ``a.`` and nothing."""
    found = []
    while scope:
        found.append(f"{scope}.")
        scope = scope.rpartition(".")[0]
    return (*found, "")
