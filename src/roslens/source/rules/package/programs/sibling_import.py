"""Rule ``package.sibling_import``: an installed program imports a module beside it by a name that only scripts have."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from posixpath import dirname

from roslens.intake.file_budget import file_budget
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.python_tree import python_tree

_IMPORT = re.compile(
    rb"^[ \t]*(?:from[ \t]+(\.*)([\w.]*)[ \t]+import[ \t]*(?:\(([\w.,\s]*)|([\w., \t]*))|import[ \t]+([\w., \t]+))",
    re.MULTILINE,
)
_PATH = b"sys.path"


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each import of a module of the package that a console script cannot find, in what its scripts import."""
    if view.package.build_type != "ament_python" or not view.setup.programs:
        return
    from roslens.source.extract.builds.python_setup_targets import module_file

    folders = dict(view.setup.folders)

    def file_of(module: str) -> str | None:
        return module_file(view.folder, module, folders, view.by_path)

    started = [(one.entry.partition(":")[0].strip(), one.name) for one in view.setup.programs]
    waiting = [(path, module, name) for module, name in started if (path := file_of(module)) is not None]
    known = {path for path, _, _ in waiting}
    while waiting:
        path, module, program = waiting.pop()
        for name, match in _imported(path, module, view):
            target = file_of(name)
            if target is None:
                yield from _missing(name, match, path, module, program, view)
            elif target not in known:
                known.add(target)
                waiting.append((target, name, program))


def _imported(path: str, module: str, view: PackageView) -> Iterator[tuple[str, re.Match[bytes]]]:
    """Yield the modules that a file may import, and how; none of a file that says where modules are looked for."""
    text = view.read(path)
    if _PATH not in text:
        for match in _IMPORT.finditer(text):
            for name in _modules(match, module, is_package=path.endswith("/__init__.py")):
                yield name, match


def _missing(
    name: str, match: re.Match[bytes], path: str, module: str, program: str, view: PackageView
) -> Iterator[Hit]:
    text, sibling = view.read(path), _sibling(name, path, module, view)
    if sibling is None or not _names(match, view.read(sibling), text, name):
        return
    line = text.count(b"\n", 0, match.start() + len(match[0]) - len(match[0].lstrip())) + 1
    if _is_statement(text, line, path):
        yield _hit(name, module, program, path, line)


def _modules(match: re.Match[bytes], module: str, *, is_package: bool) -> Iterator[str]:
    """Yield the modules that a statement imports, by their whole names."""
    dots, source, inside, beside, plain = (part.decode() if part else "" for part in match.groups())
    if plain:
        for part in plain.split(","):
            yield part.split(" as ")[0].strip()
        return
    around = module if is_package else module.rpartition(".")[0]
    for _ in dots[1:]:
        around = around.rpartition(".")[0]
    whole = ".".join(part for part in (around if dots else "", source) if part)
    if source:
        yield whole
    for part in (inside or beside).split(","):
        if name := part.split(" as ")[0].strip():
            yield f"{whole}.{name}"


def _sibling(name: str, path: str, module: str, view: PackageView) -> str | None:
    """Return the file beside another one that a name without dots means when that one is run as a script."""
    if "." in name or "." not in module or name in sys.stdlib_module_names:
        return None
    if any(one.name in (name, f"python3-{name}") for one in view.package.dependencies):
        return None
    beside = f"{dirname(path)}/{name}.py"
    return beside if beside in view.by_path and beside != path else None


def _names(match: re.Match[bytes], sibling: bytes, text: bytes, name: str) -> bool:
    """Return whether what is imported, or read of the module, is in the file beside it: it may be another's name."""
    if match[5] is None:
        listed = match[3] or match[4] or b""
        wanted = [part.split(b" as ")[0].strip() for part in listed.split(b",") if part.strip()]
        return bool(wanted) and all(_defines(sibling, one) for one in wanted)
    read = set(re.findall(rb"\b" + re.escape(name.encode()) + rb"\.(\w+)", text))
    return bool(read) and all(_defines(sibling, one) for one in read)


def _defines(text: bytes, name: bytes) -> bool:
    word = re.escape(name)
    return (
        re.search(
            rb"^(?:(?:async[ \t]+)?def|class)[ \t]+" + word + rb"\b|^" + word + rb"[ \t]*[:=]", text, re.MULTILINE
        )
        is not None
    )


def _is_statement(text: bytes, line: int, path: str) -> bool:
    """Return whether an import stands at a line of the module itself: not in a text, nor where something catches it."""
    with file_budget(path):
        tree = python_tree(text)
    return tree is not None and any(
        isinstance(one, (ast.Import, ast.ImportFrom)) and one.lineno == line for one in tree.body
    )


def _hit(name: str, module: str, program: str, path: str, line: int) -> Hit:
    whole = f"{module.rpartition('.')[0]}.{name}"
    message = (
        f"module {name!r} is found only by a script that lies beside it: program {program!r}, which is installed, ends "
        f"with a ModuleNotFoundError; expected {whole!r}"
    )
    return Hit("package.sibling_import", message, line, context=name, path=path)


RULE = PackageRule(
    id="package.sibling_import",
    title="Module beside a program imported without its package",
    finds="A module that a `console_scripts` entry of an `ament_python` package runs, or imports, and that imports a "
    "module of the same package by its last name alone: `from scale import …` instead of `from arm_driver.scale "
    "import …`. Files that change `sys.path`, modules of Python or of a declared dependency, and names that the file "
    "beside does not define are left out.",
    why="`python3 node.py` finds the module, since the folder of the script is searched; the installed program lies "
    "elsewhere and ends with a ModuleNotFoundError when the robot starts it.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("python", "install"),
    bad="from scale import scaled",
    good="from arm_driver.scale import scaled",
    found=found,
)
