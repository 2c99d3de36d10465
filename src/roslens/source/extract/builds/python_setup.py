"""What a Python package installs, read from setup.py, setup.cfg and pyproject.toml; nothing is run.

``setup.py`` is read from its syntax tree: names that are assigned at the top, constants, concatenation,
``os.path.join``, ``glob`` over the package's files, and comprehensions over constants.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterable, Iterator
from posixpath import join, normpath

import msgspec

from roslens.source.extract.builds.cmake_commands import matching
from roslens.source.extract.facts.files import joined
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.python_expression import Plain, UnknownError, evaluate

_MOST_ITEMS = 2_000
_MOST_DEPTH = 30
_PARAMETERS = "generate_parameter_module"


class EntryPoint(msgspec.Struct, frozen=True):
    """A program: its name and ``module:function``."""

    name: str
    entry: str
    evidence: Evidence


class Setup(msgspec.Struct, frozen=True):
    """What a package installs.

    Attributes:
        programs: entry points of console programs.
        scripts: files that are installed as programs, relative to the package.
        data: folders that are installed to, and the files there, relative to the package.
        folders: in which packages lie, by name; of all others at the empty one.
        script_folder: where programs are installed, as written; empty where nothing is said.
        unresolved: what could not be read.
        parameters: modules that declare parameters, each with the file it is made of, relative to the package.
    """

    programs: tuple[EntryPoint, ...] = ()
    scripts: tuple[tuple[str, Evidence], ...] = ()
    data: tuple[tuple[str, tuple[str, ...]], ...] = ()
    folders: tuple[tuple[str, str], ...] = ()
    script_folder: str = ""
    unresolved: tuple[Unresolved, ...] = ()
    parameters: tuple[tuple[str, str], ...] = ()


def read_setup_script(content: bytes, path: str, listing: Iterable[str]) -> Setup:
    """Return what a setup.py installs.

    Args:
        content: of the file.
        path: of the file relative to the root of the workspace.
        listing: files of the package, relative likewise.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(content)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        line = getattr(error, "lineno", None) or 1
        return Setup(unresolved=(Unresolved("setup.py", Evidence(path, line), f"it is no Python: {error}"),))
    return _Script(path, frozenset(listing)).read(tree)


class _Script:
    def __init__(self, path: str, listing: frozenset[str]) -> None:
        self._path = path
        self._folder = path.rpartition("/")[0]
        self._listing = listing
        self._assigned: dict[str, ast.expr] = {}
        self._unresolved: list[Unresolved] = []
        self._values: dict[str, Plain] = {}
        self._count = 0

    def read(self, tree: ast.Module) -> Setup:
        call: ast.Call | None = None
        parameters: list[tuple[str, str]] = []
        for statement in _statements(tree.body):
            if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
                target = statement.targets[0]
                match target:
                    case ast.Name():
                        self._assigned[target.id] = statement.value
                    case ast.Subscript(value=ast.Name()):
                        self._fail(statement.value, UnknownError("a part of a variable is set"))
            calls = [one for one in ast.walk(statement) if isinstance(one, ast.Call)]
            parameters += [pair for one in calls if _called(one) == _PARAMETERS for pair in self._parameters(one)]
            call = next((one for one in calls if _called(one) == "setup"), call)
        if call is None:
            return Setup(unresolved=tuple(self._unresolved), parameters=tuple(parameters))
        keywords = self._keywords(call, 0)
        programs: list[EntryPoint] = []
        for group, value in self._pairs(keywords.get("entry_points")):
            if group in ("console_scripts", "gui_scripts"):
                programs.extend(self._programs(value))
        scripts = [
            (text, self._evidence(node))
            for node in self._elements(keywords.get("scripts"))
            for text in self._texts(node)
        ]
        data = [pair for node in self._elements(keywords.get("data_files")) for pair in self._data(node)]
        folders = [
            (key, text) for key, value in self._pairs(keywords.get("package_dir")) for text in self._texts(value)
        ]
        return Setup(
            tuple(programs), tuple(scripts), tuple(data), tuple(folders), "", tuple(self._unresolved),
            tuple(parameters),
        )  # fmt: skip

    def _parameters(self, call: ast.Call) -> Iterator[tuple[str, str]]:
        """Yield module and file of ``generate_parameter_module(name, file)``."""
        given = {"module_name": 0, "yaml_file": 1}
        named = {one.arg: one.value for one in call.keywords}
        nodes = [named.get(name, call.args[place] if place < len(call.args) else None) for name, place in given.items()]
        texts = [self._texts(node) if node is not None else [] for node in nodes]
        if all(len(one) == 1 for one in texts):
            yield texts[0][0], normpath(texts[1][0])

    def _evidence(self, node: ast.expr) -> Evidence:
        return Evidence(self._path, getattr(node, "lineno", 1), getattr(node, "col_offset", 0) + 1)

    def _fail(self, node: ast.expr, error: UnknownError) -> None:
        try:
            text = ast.unparse(node)[:200]
        except (RecursionError, ValueError):
            text = "an expression"
        self._unresolved.append(Unresolved(text, self._evidence(node), str(error)))

    def _keywords(self, call: ast.Call, depth: int) -> dict[str, ast.expr]:
        found: dict[str, ast.expr] = {}
        for keyword in call.keywords:
            if keyword.arg is not None:
                found[keyword.arg] = keyword.value
                continue
            value = self._meaning(keyword.value)
            match value:
                case ast.Call() if depth < 5 and _called(value) in ("generate_distutils_setup", "dict"):
                    found.update(self._keywords(value, depth + 1))
                case ast.Dict():
                    found.update(
                        (key.value, one)
                        for key, one in zip(value.keys, value.values, strict=True)
                        if isinstance(key, ast.Constant) and isinstance(key.value, str)
                    )
                case _:
                    self._fail(keyword.value, UnknownError("what it gives to setup() is unknown"))
        return found

    def _meaning(self, node: ast.expr) -> ast.expr:
        for _ in range(_MOST_DEPTH):
            if not isinstance(node, ast.Name) or node.id not in self._assigned or node.id in self._values:
                break
            node = self._assigned[node.id]
        return node

    def _elements(self, node: ast.expr | None, depth: int = 0) -> Iterator[ast.expr]:
        """Yield the elements of a list as expressions; what is no list in the end is yielded itself."""
        if node is None:
            return
        node = self._meaning(node)
        self._count += 1
        if self._count > _MOST_ITEMS or depth > _MOST_DEPTH:
            self._fail(node, UnknownError("it has too many parts"))
            return
        match node:
            case ast.List() | ast.Tuple():
                for item in node.elts:
                    match item:
                        case ast.Starred():
                            yield from self._elements(item.value, depth + 1)
                        case _:
                            yield item
            case ast.BinOp(op=ast.Add()):
                yield from self._elements(node.left, depth + 1)
                yield from self._elements(node.right, depth + 1)
            case ast.ListComp() | ast.GeneratorExp():
                yield from self._comprehended(node, depth)
            case ast.Constant() if node.value is None:
                return
            case _:
                yield node

    def _comprehended(self, node: ast.ListComp | ast.GeneratorExp, depth: int) -> Iterator[ast.expr]:
        loop = node.generators[0]
        if len(node.generators) > 1 or loop.ifs or not isinstance(loop.target, ast.Name):
            self._fail(node, UnknownError("the comprehension is not evaluated"))
            return
        name = loop.target.id
        before = self._values.get(name)
        for item in list(self._elements(loop.iter, depth + 1)):
            for text in self._texts(item):
                self._values[name] = text
                try:
                    value = self._text(node.elt)
                except UnknownError as error:
                    self._fail(node.elt, error)
                    break
                yield ast.copy_location(ast.Constant(value), node.elt)
        if before is None:
            self._values.pop(name, None)
        else:
            self._values[name] = before

    def _pairs(self, node: ast.expr | None) -> Iterator[tuple[str, ast.expr]]:
        if node is None:
            return
        found = self._meaning(node)
        if not isinstance(found, ast.Dict):
            self._fail(node, UnknownError("it is no dictionary that is written here"))
            return
        for key, value in zip(found.keys, found.values, strict=True):
            if key is not None:
                for text in self._texts(key):
                    yield text, value

    def _programs(self, node: ast.expr) -> Iterator[EntryPoint]:
        for element in self._elements(node):
            for text in self._texts(element):
                for line in text.splitlines():
                    if program := _program(line, self._evidence(element)):
                        yield program

    def _texts(self, node: ast.expr) -> list[str]:
        """Return the text of an expression, or the texts of a list of files."""
        try:
            node = self._meaning(node)
            match node:
                case ast.Call() if _called(node) in ("glob", "iglob", "rglob") and node.args:
                    return self._globbed(self._text(node.args[0]))
                case ast.Call() if _called(node) in ("find_packages", "find_namespace_packages"):
                    return []
            return [self._text(node)]
        except UnknownError as error:
            self._fail(node, error)
            return []

    def _globbed(self, pattern: str) -> list[str]:
        prefix = f"{self._folder}/" if self._folder else ""
        deep = "**" in pattern
        wanted = joined(self._folder, pattern.replace("**/", ""))
        found = matching(wanted, self._listing, frozenset(), deep=deep)
        return [path[len(prefix) :] for path in sorted(found) if path.startswith(prefix)]

    def _text(self, node: ast.expr, depth: int = 0) -> str:
        node = self._meaning(node)
        if depth > _MOST_DEPTH:
            raise UnknownError("it is nested too deep")
        match node:
            case ast.Constant(value=str(written)):
                return written
            case ast.BinOp(op=ast.Add()):
                return self._short(self._text(node.left, depth + 1) + self._text(node.right, depth + 1))
            case ast.JoinedStr():
                return self._short("".join(self._piece(part, depth) for part in node.values))
            case ast.Call() if _called(node) == "join" and ast.unparse(node.func) in ("os.path.join", "join"):
                return self._short(join("", *(self._text(part, depth + 1) for part in node.args)))
            case ast.Call() if _called(node) == "format" and isinstance(node.func, ast.Attribute):
                return self._formatted(node, node.func.value, depth)
        names = {name: value.value for name, value in self._assigned.items() if isinstance(value, ast.Constant)}
        plain = {name: value for name, value in names.items() if isinstance(value, (str, int, float))}
        value = evaluate(ast.unparse(node), {**plain, **self._values})
        if not isinstance(value, str):
            raise UnknownError("it is no text")
        return value

    def _piece(self, part: ast.expr, depth: int) -> str:
        if not isinstance(part, ast.FormattedValue):
            return self._text(part, depth + 1)
        if part.format_spec is not None or part.conversion not in (-1, ord("s")):
            raise UnknownError("a format is not evaluated")
        return self._text(part.value, depth + 1)

    def _formatted(self, node: ast.Call, receiver: ast.expr, depth: int) -> str:
        given = iter([self._text(part, depth + 1) for part in node.args])
        named = {one.arg: self._text(one.value, depth + 1) for one in node.keywords if one.arg}

        def filled(match: re.Match[str]) -> str:
            value = named.get(match[1]) if match[1] else next(given, None)
            if value is None:
                raise UnknownError("a format is not evaluated")
            return value

        return self._short(re.sub(r"\{(\w*)\}", filled, self._text(receiver, depth + 1)))

    @staticmethod
    def _short(text: str) -> str:
        if len(text) > 10_000:
            raise UnknownError("it makes a text that is too long")
        return text

    def _data(self, node: ast.expr) -> Iterator[tuple[str, tuple[str, ...]]]:
        node = self._meaning(node)
        if not isinstance(node, (ast.Tuple, ast.List)) or len(node.elts) != 2:
            self._fail(node, UnknownError("it is no pair of a folder and files"))
            return
        for folder in self._texts(node.elts[0]):
            files = [text for element in self._elements(node.elts[1]) for text in self._texts(element)]
            yield normpath(folder), tuple(normpath(one) for one in files)


def _statements(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    for statement in body:
        match statement:
            case ast.If() | ast.Try():
                yield from _statements(statement.body)
            case ast.FunctionDef():
                yield from statement.body
            case _:
                yield statement


def _called(node: ast.Call) -> str:
    called = node.func
    return called.id if isinstance(called, ast.Name) else called.attr if isinstance(called, ast.Attribute) else ""


def _program(line: str, evidence: Evidence) -> EntryPoint | None:
    name, equals, entry = line.partition("=")
    if not equals or not name.strip() or line.lstrip().startswith("#"):
        return None
    return EntryPoint(name.strip(), entry.partition("[")[0].replace(" ", ""), evidence)


_SECTION = re.compile(r"\[([^\]]+)\]")


def read_setup_config(content: bytes, path: str) -> Setup:
    """Return what a setup.cfg installs; ``path`` is that of the file."""
    programs: list[EntryPoint] = []
    scripts: list[tuple[str, Evidence]] = []
    section = key = folder = ""
    for number, line in enumerate(content.decode("utf-8-sig", "replace").splitlines(), 1):
        if heading := _SECTION.match(line.strip()):
            section, key = heading[1].strip(), ""
            continue
        if not line.strip() or line.lstrip()[0] in "#;":
            continue
        value = line.strip()
        if not line[0].isspace():
            name, _, value = line.partition("=")
            key, value = name.strip().replace("-", "_"), value.strip()
        if section == "install" and key == "install_scripts" and value:
            folder = value
        elif section == "options.entry_points" and key == "console_scripts":
            if program := _program(value, Evidence(path, number)):
                programs.append(program)
        elif section == "options" and key == "scripts" and value:
            scripts.extend((one, Evidence(path, number)) for one in value.replace(",", " ").split())
    return Setup(tuple(programs), tuple(scripts), script_folder=folder)


def read_pyproject(content: bytes, path: str) -> Setup:
    """Return the programs of a pyproject.toml; ``path`` is that of the file."""
    if b"scripts" not in content:
        return Setup()
    import tomli

    text = content.decode("utf-8", "replace")
    try:
        project = tomli.loads(text).get("project", {})
    except (tomli.TOMLDecodeError, RecursionError) as error:
        return Setup(unresolved=(Unresolved("pyproject.toml", Evidence(path, 1), f"it is no TOML: {error}"),))
    given = project if isinstance(project, dict) else {}
    points = given.get("entry-points")
    tables = [given.get("scripts"), points.get("console_scripts") if isinstance(points, dict) else None]
    programs: list[EntryPoint] = []
    for table in tables:
        for name, entry in table.items() if isinstance(table, dict) else ():
            if isinstance(entry, str):
                where = re.search(rf"(?m)^\s*[\"']?{re.escape(name)}[\"']?\s*=", text)
                line = text.count("\n", 0, where.end()) + 1 if where else 1
                programs.append(EntryPoint(name, entry.partition("[")[0].replace(" ", ""), Evidence(path, line)))
    return Setup(tuple(programs))
