"""Launch files in Python that launch cannot take: no Python, or no ``generate_launch_description`` that has a value."""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterator
from difflib import get_close_matches

from roslens.source.extract.facts.refusal import Refusal

ENTRY = "generate_launch_description"
_OTHER_ENTRY = "generate_test_description"
_NEWER = re.compile(
    r"""\b[rR]?[fFtT][rR]?['"]|\bexcept\s*\*|\b(?:def|class)\s+\w+\s*\[|^\s*type\s+\w|\bmatch\b|\bcase\b"""
)
"""What a later Python may read that this one does not."""
_NEAR = 0.9


def syntax_refusal(content: bytes) -> Refusal | None:
    """Return where a file is no Python; None where it is, or where a later Python may read it."""
    match _parsed(content)[1]:
        case SyntaxError() as error:
            return _of_syntax(error, content)
        case ValueError() as error:
            return Refusal(1, 1, str(error) or type(error).__name__, "Python that can be parsed")
    return None


def _of_syntax(error: SyntaxError, content: bytes) -> Refusal | None:
    line = error.lineno or 1
    lines = content.decode("utf-8", "replace").splitlines()
    text = lines[line - 1] if line <= len(lines) else ""
    if _NEWER.search(text):
        return None
    quoted = f" at {text.strip()[:60]!r}" if text.strip() else ""
    return Refusal(line, max(error.offset or 1, 1), f"{error.msg}{quoted}", "Python that can be parsed")


def description_refusal(content: bytes) -> Refusal | None:
    """Return what launch misses in a file that can be parsed: the function that it calls, or what that returns."""
    tree = _parsed(content)[0]
    if tree is None:
        return None
    named = dict(_named(tree.body))
    if "*" in named or _OTHER_ENTRY in named:
        return None
    match named.get(ENTRY):
        case None:
            return _missing(named)
        case ast.FunctionDef(decorator_list=[]) | ast.AsyncFunctionDef(decorator_list=[]) as entry:
            return _of_function(entry)
    return None


def _parsed(content: bytes) -> tuple[ast.Module | None, Exception | None]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(content), None
    except (RecursionError, MemoryError):
        return None, None
    except (SyntaxError, ValueError) as error:
        return None, error


def _named(body: list[ast.stmt]) -> Iterator[tuple[str, ast.stmt]]:
    """Yield what statements outside of functions and classes name, ``*`` for what nobody can tell."""
    for statement in body:
        match statement:
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
                yield name, statement
            case ast.Import(names=names) | ast.ImportFrom(names=names):
                yield from ((one.asname or one.name, statement) for one in names)
            case ast.Assign() | ast.AnnAssign() | ast.Expr():
                yield from ((name, statement) for name in _stored(statement))
            case _:
                yield from _named(_inside(statement))


def _stored(statement: ast.stmt) -> Iterator[str]:
    for one in ast.walk(statement):
        match one:
            case ast.Name(id="globals" | "exec" | "setattr"):
                yield "*"
            case ast.Name(id=name, ctx=ast.Store()):
                yield name


def _inside(statement: ast.stmt) -> list[ast.stmt]:
    """Return the statements in those that have several: of conditions, loops, handlers of exceptions."""
    blocks = (getattr(statement, field, []) for field in ("body", "orelse", "finalbody"))
    handled = (one.body for one in getattr(statement, "handlers", []))
    return [one for block in (*blocks, *handled) for one in block]


def _missing(named: dict[str, ast.stmt]) -> Refusal:
    functions = {name: one for name, one in named.items() if type(one) in (ast.FunctionDef, ast.AsyncFunctionDef)}
    near = get_close_matches(ENTRY, functions, 1, _NEAR)
    if near:
        place = functions[near[0]]
        return Refusal(place.lineno, place.col_offset + 1, f"no function {ENTRY}, but {near[0]!r}", f"def {ENTRY}()")
    return Refusal(1, 1, f"no function {ENTRY}", f"def {ENTRY}() that returns a LaunchDescription")


def _of_function(entry: ast.FunctionDef | ast.AsyncFunctionDef) -> Refusal | None:
    needed = [*entry.args.posonlyargs, *entry.args.args]
    needed = needed[: len(needed) - len(entry.args.defaults)]
    if needed:
        what = f"{ENTRY} takes {', '.join(one.arg for one in needed)}, and launch calls it without arguments"
        return Refusal(entry.lineno, entry.col_offset + 1, what, f"def {ENTRY}()")
    if any(map(_gives_or_ends, _own(entry.body))):
        return None
    return Refusal(entry.lineno, entry.col_offset + 1, f"{ENTRY} returns nothing", "return LaunchDescription([…])")


def _gives_or_ends(node: ast.AST) -> bool:
    match node:
        case ast.Return(value=value):
            return value is not None
        case ast.Raise() | ast.Yield() | ast.YieldFrom():
            return True
    return False


def _own(body: list[ast.stmt]) -> Iterator[ast.AST]:
    """Yield what stands in statements, but for what inner functions and classes have."""
    waiting: list[ast.AST] = list(body)
    while waiting:
        one = waiting.pop()
        yield one
        match one:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef() | ast.Lambda():
                continue
        waiting.extend(ast.iter_child_nodes(one))
