"""One library at one revision: its modules, and the classes that they define, as the source writes them."""

from __future__ import annotations

import ast
import subprocess
from pathlib import Path

import msgspec

MOST_BASES = 8


class Module(msgspec.Struct):
    """A module: what its names mean (full names), and the classes that it defines."""

    name: str
    is_package: bool
    names: dict[str, str] = {}
    classes: dict[str, ast.ClassDef] = {}


def read_library(clone: Path, revision: str, package: str) -> dict[str, Module]:
    """Return the modules of a package of a clone at a revision, by their full name.

    Raises:
        subprocess.CalledProcessError: the revision has no such package.
    """
    listed = _git(clone, "ls-tree", "-r", "--name-only", revision, f"{package}/{package}").splitlines()
    found: dict[str, Module] = {}
    for path in listed:
        if path.endswith(".py"):
            module = _module(path, package)
            module_tree = ast.parse(_git(clone, "show", f"{revision}:{path}"))
            found[module.name] = module
            _fill(module, module_tree)
    return found


def _git(clone: Path, *arguments: str) -> str:
    done = subprocess.run(("git", "-C", clone, *arguments), check=True, capture_output=True, text=True)
    return done.stdout


def _module(path: str, package: str) -> Module:
    parts = path.removesuffix(".py").split("/")[1:]
    is_package = parts[-1] == "__init__"
    return Module(".".join(parts[:-1] if is_package else parts) or package, is_package)


def _fill(module: Module, tree: ast.Module) -> None:
    for one in tree.body:
        match one:
            case ast.ImportFrom():
                base = _base(module, one.level, one.module or "")
                for alias in one.names:
                    module.names[alias.asname or alias.name] = f"{base}.{alias.name}"
            case ast.Import():
                for alias in one.names:
                    known = alias.name if alias.asname else alias.name.partition(".")[0]
                    module.names[alias.asname or known] = known
            case ast.ClassDef():
                module.classes[one.name] = one
                module.names[one.name] = f"{module.name}.{one.name}"
            case ast.FunctionDef() | ast.AsyncFunctionDef():
                module.names[one.name] = f"{module.name}.{one.name}"
            case ast.Assign():
                for target in one.targets:
                    if isinstance(target, ast.Name):
                        module.names[target.id] = f"{module.name}.{target.id}"


def _base(module: Module, level: int, written: str) -> str:
    if not level:
        return written
    parts = module.name.split(".")
    above = parts if module.is_package else parts[:-1]
    above = above[: len(above) - level + 1]
    return ".".join([*above, written] if written else above)


def definition(modules: dict[str, Module], full: str) -> tuple[Module, ast.ClassDef] | None:
    """Return the module and the class that a full name leads to, through imports."""
    for _ in range(MOST_BASES):
        home, _, name = full.rpartition(".")
        module = modules.get(home)
        if module is None:
            return None
        if name in module.classes:
            return module, module.classes[name]
        if module.names.get(name, full) == full:
            return None
        full = module.names[name]
    return None


def bases(modules: dict[str, Module], module: Module, node: ast.ClassDef) -> list[str]:
    """Return the full names of the classes that a class is derived from."""
    found = []
    for base in node.bases:
        written = ast.unparse(base)
        head, _, rest = written.partition(".")
        full = module.names.get(head, head)
        found.append(f"{full}.{rest}" if rest else full)
    return found
