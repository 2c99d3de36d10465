"""Writes statements of CMake by chance: variables, lists, texts, paths, conditions, loops and functions."""

from __future__ import annotations

import random
from collections.abc import Callable

_WORDS = (
    "x",
    "y1",
    "Foo",
    "foo_bar",
    "0",
    "1",
    "2",
    "10",
    "1.10",
    "1.9",
    "1.9.0",
    "01",
    "ON",
    "off",
    "TRUE",
    "No",
    "N",
    "y",
    "IGNORE",
    "NOTFOUND",
    "lib-NOTFOUND",
    "a",
    "b",
    "c",
    "l1",
    "l2",
    "a-b",
    "src/one.cpp",
    "A.b.Cc",
    "-3",
    "0x10",
    "unset_one",
    "aXbXc",
    "f(",
    "v1.2.3-rc",
    "2.0",
    "1e3",
    "name@where",
    "/usr/lib",
    "x.tar.gz",
    "q]r",
    "[s",
)
_PATTERNS = (
    "[a-z]+",
    "^[A-Z]",
    "o+",
    "([a-z])([0-9])",
    "x$",
    ".",
    "^$",
    "\\\\.",
    "[^a-z]",
    "a|b",
    "(o)(b)?",
    "^.",
    "[0-9]*",
    "(.)(.)",
    "[.]",
    "X",
    "b+",
    "[a-c_-]+",
    "^(.*)[.]([a-z]+)$",
)
_SOUGHT, _PUT = ("x", "a", "1", ".", ";", '"o"'), ("z", '""', '"-"', "xx")
_JOINTS = ("-", "", ", ", ";")
_ASKED = (
    "p1",
    "ARGN",
    "${ARGC} GREATER 2",
    "ARGC GREATER 2",
    "DEFINED p1",
    "p1 STREQUAL x",
    '"${p1}" STREQUAL "x"',
    "DEFINED ARGV2",
)
_SOLID = ("[a-z]", "^.", "x", "(.)$")
_PARTS = ("FILENAME", "STEM", "EXTENSION", "PARENT_PATH", "ROOT_DIRECTORY", "RELATIVE_PART", "STEM LAST_ONLY",
          "EXTENSION LAST_ONLY")  # fmt: skip
_TEXT_TESTS = ("STREQUAL", "STRLESS", "STRGREATER", "STRLESS_EQUAL", "STRGREATER_EQUAL")
_PERHAPS_SET = ("a", "b", "unset_one", "ENV{MINE_a}", "CACHE{cached_a}", "cached_a", "l1", "nothing")
_TURNED = ("_", "<\\\\0>", "z")
_REPLACEMENTS = ("", "-", "<\\\\0>", "<\\\\0\\\\0>", "z", ";")


class Language:
    """Writes lines; it keeps the names of functions and targets that there are."""

    def __init__(self, seed: int) -> None:
        """Begin with nothing."""
        self.chance = random.Random(seed)
        self._lines: list[str] = []
        self._indent = 0
        self._labels = 0
        self._targets: dict[str, str] = {}
        self._names = 0
        self._depth = 0
        self._functions: list[str] = []

    # Pieces

    def _say(self, text: str) -> None:
        self._lines.append("  " * self._indent + text)

    def _tell(self, *values: str) -> None:
        self._labels += 1
        self._say(f"tell(t{self._labels} {' '.join(values)})")

    def _scalar(self) -> str:
        return self.chance.choice("abcdef")

    def _list(self) -> str:
        return self.chance.choice(("l1", "l2", "l3"))

    def _variable(self) -> str:
        return self._list() if self.chance.random() < 0.4 else self._scalar()

    def _fresh(self, stem: str) -> str:
        self._names += 1
        return f"{stem}{self._names}"

    def _word(self) -> str:
        return self.chance.choice(_WORDS)

    def _quoted(self) -> str:
        """Return exactly one argument."""
        kind = self.chance.randrange(9)
        if kind < 3:
            return f'"${{{self._variable()}}}"'
        if kind == 3:
            return f'"{self._word()} ${{{self._variable()}}}"'
        if kind == 4:
            return f'"${{{self._scalar()}}}${{{self._scalar()}}}_{self._word()}"'
        if kind == 5:
            return f'"${{${{pointer}}}}-{self._word()}"'
        if kind == 6:
            return self.chance.choice(
                (
                    "[[raw ${a} \\n]]",
                    "[=[x]]y]=]",
                    '"esc \\${a} \\"q\\" \\\\ end"',
                    '"a\\;b"',
                    '""',
                    '" pad "',
                    '"x;y;;z"',
                    '"tab\\tnew\\nline"',
                    '"cont\\\ninued"',
                    '"$a {b} $"',
                    '"\\@at\\@"',
                )
            )
        return f'"{self._word()}"'

    def _argument(self) -> str:
        """Return what may be any number of arguments."""
        kind = self.chance.randrange(10)
        if kind < 3:
            word = self._word()
            return f'"{word}"' if any(sign in word for sign in "()#") else word
        if kind < 5:
            return f"${{{self._variable()}}}"
        if kind == 5:
            return self.chance.choice(
                (
                    "p;q",
                    "u\\;v",
                    "w${a}w",
                    "${l1}z",
                    "a\\ b",
                    "${unset_one}",
                    "${${pointer}}",
                    'k="v w"',
                    "x${l2}y;z",
                    ";;",
                    "a;;b",
                )
            )
        return self._quoted()

    def _several(self, least: int = 0, most: int = 3) -> str:
        return " ".join(self._argument() for _ in range(self.chance.randint(least, most)))

    def _filled(self) -> str:
        """Write what makes sure that a list has three items; return its name."""
        name = self._list()
        self._say(f"list(APPEND {name} p Q r1)")
        return name

    # Variables

    def _set(self) -> None:
        name = self._variable()
        self._say(f"set({name} {self._several()})")
        self._tell(f'"${{{name}}}"')

    def _set_otherwise(self) -> None:
        name = self._scalar()
        kind = self.chance.randrange(7)
        if kind == 0:
            self._say(f'set(cached_{name} {self._quoted()} CACHE STRING "text")')
            self._tell(f'"${{cached_{name}}}"', f'"$CACHE{{cached_{name}}}"')
        elif kind == 1:
            self._say(f"set(ENV{{MINE_{name}}} {self._quoted()})")
            self._tell(f'"$ENV{{MINE_{name}}}"')
        elif kind == 2:
            self._say(f"unset({name})")
            self._tell(f'"[${{{name}}}]"')
        elif kind == 3:
            self._say(f"set(pointer {self.chance.choice(('a', 'l1', 'b'))})")
            self._tell('"${${pointer}}"')
        elif kind == 4:
            self._say(f'option(opt_{name} "text" {self.chance.choice(("ON", "OFF", ""))})')
            self._tell(f'"${{opt_{name}}}"')
        elif kind == 5:
            self._say(f'set(cached_{name} {self._quoted()} CACHE INTERNAL "text" FORCE)')
            self._tell(f'"${{cached_{name}}}"')
            self._say(f"unset(cached_{name} CACHE)")
        else:
            self._say(f"set(x_${{{name}}}_y 1)" if False else f"set(n_{name} )")
            self._tell(f'"<${{n_{name}}}>"')

    def _list_command(self) -> None:
        name = self._filled() if self.chance.random() < 0.8 else self._list()
        out = self._scalar()
        number = self.chance.choice((0, 1, 2, -1, -2))
        self._say(f"list(LENGTH {name} count)")
        guarded = [
            f"list(GET {name} {number} {out})",
            f"list(GET {name} 0 -1 {out})",
            f"list(SUBLIST {name} 1 -1 {out})",
            f"list(SUBLIST {name} 0 2 {out})",
            f"list(REMOVE_AT {name} {number})",
            f"list(REMOVE_AT {name} 0 1)",
            f"list(INSERT {name} {number} {self._quoted()} i2)",
            f"list(SUBLIST {name} 1 99 {out})",
            f"list(TRANSFORM {name} TOUPPER AT 0 {number})",
            f"list(TRANSFORM {name} APPEND _e FOR 0 2)",
            f"list(TRANSFORM {name} PREPEND w_ FOR 0 2 2)",
        ]
        free = [
            f"list(APPEND {name} {self._several()})",
            f"list(PREPEND {name} {self._several()})",
            f"list(REMOVE_ITEM {name} {self._several(1)})",
            f"list(REMOVE_DUPLICATES {name})",
            f"list(REVERSE {name})",
            f"list(SORT {name})",
            f"list(SORT {name} CASE INSENSITIVE)",
            f"list(SORT {name} ORDER DESCENDING)",
            f"list(SORT {name} COMPARE NATURAL)",
            f"list(SORT {name} COMPARE FILE_BASENAME)",
            f'list(JOIN {name} "{self.chance.choice(_JOINTS)}" {out})',
            f"list(FIND {name} {self._quoted()} {out})",
            f"list(LENGTH {name} {out})",
            f'list(FILTER {name} {self.chance.choice(("INCLUDE", "EXCLUDE"))} REGEX "{self.chance.choice(_PATTERNS)}")',
            f"list(TRANSFORM {name} {self.chance.choice(('TOUPPER', 'TOLOWER', 'STRIP', 'APPEND _s', 'PREPEND p/'))})",
            f"list(TRANSFORM {name} PREPEND {self._quoted()} OUTPUT_VARIABLE {out})",
            f'list(TRANSFORM {name} REPLACE "{self.chance.choice(_SOLID)}" "{self.chance.choice(_TURNED)}")',
            f'list(TRANSFORM {name} TOUPPER REGEX "^[a-m]")',
            f"list(POP_BACK {name} {out})",
            f"list(POP_FRONT {name} {out} g)",
            f"list(POP_BACK {name})",
            f"list(APPEND made_{name} {self._several()})",
        ]
        if self.chance.random() < 0.4:
            self._say("if(count GREATER 2)")
            self._say("  " + self.chance.choice(guarded))
            self._say("endif()")
        else:
            self._say(self.chance.choice(free))
        self._tell(f'"${{{name}}}"', f'"${{{out}}}"', f'"${{made_{name}}}"')

    def _string_command(self) -> None:
        out = self._scalar()
        value = self._quoted()
        pattern = f'"{self.chance.choice(_PATTERNS)}"'
        solid = self.chance.choice(('"[a-z]"', '"([a-z])([0-9])"', '"[0-9]+"', '"X"', '"^."', '"(a)(b)?"'))
        sought, put = self.chance.choice(_SOUGHT), self.chance.choice(_PUT)
        choices = [
            f"string(REPLACE {sought} {put} {out} {self._quoted()} {self._several()})",
            f'string(REGEX REPLACE {solid} "{self.chance.choice(_REPLACEMENTS)}" {out} {self._several(1)})',
            f"string(REGEX MATCH {pattern} {out} {self._several(1)})",
            f"string(REGEX MATCHALL {solid} {out} {self._several(1)})",
            f"string(TOUPPER {value} {out})",
            f"string(TOLOWER {value} {out})",
            f"string(STRIP {value} {out})",
            f"string(CONCAT {out} {self._several()})",
            f"string(APPEND {out} {self._several()})",
            f"string(PREPEND {out} {self._several()})",
            f'string(JOIN "{self.chance.choice(_JOINTS)}" {out} {self._several()})',
            f"string(LENGTH {value} {out})",
            f"string(SUBSTRING {value} 0 {self.chance.choice((1, 3, -1, 0))} {out})",
            f'string(SUBSTRING "abcdef${{a}}" {self.chance.randint(0, 5)} {self.chance.choice((-1, 1, 99))} {out})',
            f"string(FIND {value} {self.chance.choice('xo_.')} {out} {self.chance.choice(('', 'REVERSE'))})",
            f"string(REPEAT {value} {self.chance.randint(0, 3)} {out})",
            f"string(MAKE_C_IDENTIFIER {value} {out})",
            f"string(COMPARE {self._comparison()} {value} {self._quoted()} {out})",
            f"string(CONFIGURE {value} {out})",
            f'string(CONFIGURE "@a@ ${{b}} @unset_one@ \\${{c}}" {out} @ONLY)',
            f'string(CONFIGURE [[<@a@ ${{b}} "q">]] {out} {self.chance.choice(("", "@ONLY", "ESCAPE_QUOTES"))})',
            f"string(GENEX_STRIP {value} {out})",
            f"string(ASCII 65 66 97 {out})",
            f"string(HEX {value} {out})",
            f"string(MD5 {out} {value})",
            f"string(SHA1 {out} {value})",
        ]
        self._say(self.chance.choice(choices))
        self._tell(f'"${{{out}}}"')
        if self.chance.random() < 0.4:
            self._tell('"${CMAKE_MATCH_0}|${CMAKE_MATCH_1}|${CMAKE_MATCH_2}|${CMAKE_MATCH_COUNT}"')

    def _comparison(self) -> str:
        return self.chance.choice(("EQUAL", "NOTEQUAL", "LESS", "GREATER", "LESS_EQUAL", "GREATER_EQUAL"))

    def _math(self) -> None:
        one, two, three = (self.chance.randint(1, 40) for _ in range(3))
        shapes = (
            f"{one} + {two} * {three}",
            f"({one} - {two}) / {three}",
            f"-{one} / {two}",
            f"{one} % {two}",
            f"-{one} % {two}",
            f"{one} << 3",
            f"{one} | {two}",
            f"{one} & {two}",
            f"{one} ^ {two}",
            f"~{one}",
            f"0x{one:x} + 1",
            f"{one}*-{two}",
            f"{one} >> 1 + 1",
            f"({one}+{two})*({three}-{one})",
            f"-{one} >> 1",
            f"0{one % 8} + 8",
        )
        out = self._scalar()
        extra = self.chance.choice(("", "", " OUTPUT_FORMAT HEXADECIMAL", " OUTPUT_FORMAT DECIMAL"))
        self._say(f'math(EXPR {out} "{self.chance.choice(shapes)}"{extra})')
        self._tell(f'"${{{out}}}"')

    def _path_command(self) -> None:
        out = self._scalar()
        path = self.chance.choice(
            (
                '"src/one.cpp"',
                '"a.b.tar.gz"',
                '"/x/y.z/w"',
                '"dir/"',
                '"${CMAKE_CURRENT_SOURCE_DIR}/src/deep/../one.cpp"',
                '".hid"',
                '"x/.."',
                '"${a}"',
                '"/"',
                '"/x/y/"',
                '"x//y.e"',
                '"../up.c"',
                '""',
                '"a/./b"',
                '"x/y."',
            )
        )
        mode = self.chance.choice(
            (
                "NAME",
                "NAME_WE",
                "EXT",
                "LAST_EXT",
                "NAME_WLE",
                "DIRECTORY",
                "PATH",
                "ABSOLUTE",
                "REALPATH",
                'ABSOLUTE BASE_DIR "/base"',
            )
        )
        if self.chance.random() < 0.6:
            self._say(f"get_filename_component({out} {path} {mode})")
        else:
            self._say(f"set(path {path})")
            choice = self.chance.choice(
                (
                    f"cmake_path(GET path {self.chance.choice(_PARTS)} {out})",
                    f"cmake_path(APPEND path {self.chance.choice(('x', 'x y', '/abs', 'x/y'))})",
                    f"cmake_path(SET path NORMALIZE {path})",
                    f"cmake_path(REMOVE_FILENAME path OUTPUT_VARIABLE {out})",
                    f"cmake_path(REPLACE_EXTENSION path .new OUTPUT_VARIABLE {out})",
                    "cmake_path(NORMAL_PATH path)",
                    f"cmake_path(HAS_EXTENSION path {out})",
                    f"cmake_path(IS_ABSOLUTE path {out})",
                    f"cmake_path(ABSOLUTE_PATH path OUTPUT_VARIABLE {out})",
                    "cmake_path(APPEND_STRING path _more)",
                    f'cmake_path(RELATIVE_PATH path BASE_DIRECTORY "${{PROJECT_SOURCE_DIR}}" OUTPUT_VARIABLE {out})',
                )
            )
            self._say(choice)
        self._tell(f'"${{{out}}}"', '"${path}"')
        self._say(f"set({out} {self._quoted()})")

    def _glob(self) -> None:
        out = self._list()
        mode = self.chance.choice(("GLOB", "GLOB_RECURSE"))
        relative = self.chance.choice(
            (
                "",
                "RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ",
                "RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/src ",
                "CONFIGURE_DEPENDS ",
                "LIST_DIRECTORIES false ",
                "LIST_DIRECTORIES true ",
            )
        )
        patterns = (
            "src/*.cpp",
            "*.cpp",
            "src/*",
            "scripts/*",
            "src/d*/*.cpp",
            "src/[a-o]*.cpp",
            "src/t??.cpp",
            "none/*.x",
            "${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp",
            "${PROJECT_SOURCE_DIR}/src/*pp",
            "sub/*.cpp",
            "config/*",
            "*",
            "src/[^t]*.cpp",
            "src/one.cpp",
        )
        several = " ".join(self.chance.sample(patterns, self.chance.randint(1, 2)))
        self._say(f"file({mode} {out} {relative}{several})")
        self._tell(f'"${{{out}}}"')
        if not relative.startswith("RELATIVE"):
            # The two sides have folders of different names: what is done to those texts would differ.
            self._say(f"set({out} {self._several()})")

    def _file_command(self) -> None:
        out = self._scalar()
        self._say(
            self.chance.choice(
                (
                    f'file(RELATIVE_PATH {out} "${{PROJECT_SOURCE_DIR}}/src" "${{PROJECT_SOURCE_DIR}}/sub/x")',
                    f'file(TO_CMAKE_PATH "x/y" {out})',
                    f'file(READ "${{PROJECT_SOURCE_DIR}}/config/p.yaml" {out})',
                    f'file(STRINGS "${{PROJECT_SOURCE_DIR}}/config/p.yaml" {out})',
                    f"separate_arguments({out})",
                    f"separate_arguments({out} UNIX_COMMAND \"x y 'z w'\")",
                    f"set_property(GLOBAL PROPERTY mine {self._quoted()})",
                    f"get_property({out} GLOBAL PROPERTY mine)",
                    'configure_file("${PROJECT_SOURCE_DIR}/config/p.yaml" "${CMAKE_CURRENT_BINARY_DIR}/p.yaml")',
                    f'file(SIZE "${{PROJECT_SOURCE_DIR}}/top.cpp" {out})',
                )
            )
        )
        self._tell(f'"${{{out}}}"')

    # Conditions

    def _operand(self) -> str:
        kind = self.chance.randrange(6)
        if kind < 2:
            return self._scalar()
        if kind == 2:
            return f'"${{{self._scalar()}}}"'
        if kind == 3:
            return f'"{self._word()}"'
        word = self._word()
        return f'"{word}"' if "(" in word else word

    def _test(self) -> str:
        kind = self.chance.randrange(16)
        one, other = self._operand(), self._operand()
        if kind == 0:
            return self._operand()
        if kind == 1:
            return f'"${{{self._scalar()}}}"'
        if kind < 5:
            return f"{one} {self.chance.choice(_TEXT_TESTS)} {other}"
        if kind == 5:
            return f"{one} {self.chance.choice(('EQUAL', 'LESS', 'GREATER', 'LESS_EQUAL', 'GREATER_EQUAL'))} {other}"
        if kind < 8:
            operator = self.chance.choice(("EQUAL", "LESS", "GREATER", "LESS_EQUAL", "GREATER_EQUAL"))
            return f"{one} VERSION_{operator} {other}"
        if kind < 10:
            return f'{one} MATCHES "{self.chance.choice(_PATTERNS)}"'
        if kind == 10:
            return f"{one} IN_LIST {self._list()}"
        if kind == 11:
            return f"DEFINED {self.chance.choice(_PERHAPS_SET)}"
        if kind == 12:
            return f"TARGET {self.chance.choice([*self._targets, 'none'])}"
        if kind == 13:
            return f"COMMAND {self.chance.choice(['set', 'LIST', 'nothing_of_all', *self._functions])}"
        if kind == 14:
            path = self.chance.choice(("src/one.cpp", "src", "none.txt", "launch/a.launch"))
            return f'{self.chance.choice(("EXISTS", "IS_DIRECTORY"))} "${{PROJECT_SOURCE_DIR}}/{path}"'
        return f'IS_ABSOLUTE "{self.chance.choice(("/x", "x", "${CMAKE_CURRENT_SOURCE_DIR}"))}"'

    def _condition(self, depth: int = 0) -> str:
        test = self._test()
        if self.chance.random() < 0.2:
            test = f"NOT {test}"
        if depth < 2 and self.chance.random() < 0.15:
            test = f"({self._condition(depth + 1)})"
        while self.chance.random() < 0.35:
            joint = self.chance.choice(("AND", "OR"))
            more = self._test()
            test = f"{test} {joint} {self.chance.choice(('', '', 'NOT '))}{more}"
        return test

    def _inside(self, count: int = 2) -> None:
        self._indent += 1
        self._depth += 1
        for _ in range(self.chance.randint(1, count)):
            self._statement()
        self._depth -= 1
        self._indent -= 1

    def _if(self) -> None:
        self._say(f"if({self._condition()})")
        self._inside()
        while self.chance.random() < 0.3:
            self._say(f"elseif({self._condition()})")
            self._tell("elseif")
            self._inside()
        if self.chance.random() < 0.5:
            self._say("else()")
            self._tell("else")
            self._inside()
        self._say("endif()")

    def _check(self) -> None:
        self._say(f"if({self._condition()})")
        self._tell("yes")
        self._say("else()")
        self._tell("no")
        self._say("endif()")

    def _foreach(self) -> None:
        name = self.chance.choice(("a", "i", "j"))
        low, high = self.chance.randint(0, 3), self.chance.randint(0, 6)
        head = self.chance.choice(
            (
                f"{name} {self._several()}",
                f"{name} IN LISTS {self._list()} {self._list()}",
                f"{name} IN ITEMS {self._several()}",
                f"{name} IN LISTS {self._list()} ITEMS {self._several()}",
                f"{name} RANGE {high}",
                f"{name} RANGE {low} {low + high}",
                f"{name} RANGE {low} {low + high} 2",
                f"{name} IN ZIP_LISTS l1 l2",
                "i j IN ZIP_LISTS l1 l2",
            )
        )
        self._say(f"foreach({head})")
        self._tell(f'"${{{name}}}"', f'"${{{name}_0}}|${{{name}_1}}"', '"${j}"')
        if self.chance.random() < 0.3:
            self._say(f"if({self._condition()})")
            self._say(f"  {self.chance.choice(('break()', 'continue()'))}")
            self._say("endif()")
        self._inside(1)
        self._say("endforeach()")
        self._tell(f'"[${{{name}}}]"')

    def _while(self) -> None:
        counter = self._fresh("w")
        self._say(f"set({counter} 0)")
        self._say(f"while({counter} LESS {self.chance.randint(1, 3)})")
        self._say(f'  math(EXPR {counter} "${{{counter}}} + 1")')
        self._tell(f'"${{{counter}}}"')
        self._inside(1)
        self._say("endwhile()")

    # Functions

    def _define(self) -> None:
        kind = self.chance.choice(("function", "macro"))
        name = self._fresh(f"do_{kind[0]}")
        self._say(f"{kind}({name} p1 p2)")
        self._indent += 1
        self._tell('"${p1}"', '"${p2}"', '"${ARGN}"', '"${ARGV}"', '"${ARGC}"', '"${ARGV0}"', '"${ARGV2}"')
        self._tell('"${extra}"', "${ARGN}")
        self._parse(kind)
        if kind == "function" and self.chance.random() < 0.5:
            self._say(f"set({self._variable()} {self._several()} PARENT_SCOPE)")
        if self.chance.random() < 0.4:
            self._say(f"foreach(it {self.chance.choice(('${ARGN}', 'IN LISTS ARGN', 'IN ITEMS ${ARGN} z'))})")
            self._tell('"${it}"')
            self._say("endforeach()")
        if self.chance.random() < 0.4:
            self._say(f"if({self.chance.choice(_ASKED)})")
            self._tell("yes")
            if kind == "function" and self.chance.random() < 0.5:
                self._say(self.chance.choice(("  return()", "  set(a changed)\n  return(PROPAGATE a)")))
            self._say("endif()")
        self._inside(1)
        self._indent -= 1
        self._say(f"end{kind}()")
        self._functions.append(name)
        self._call(name)

    def _parse(self, kind: str) -> None:
        form = self.chance.randrange(4)
        if form == 0:
            self._say('cmake_parse_arguments(got "QUIET;LOUD" "ONE;OTHER" "MANY;MORE" ${ARGN})')
        elif form == 1 and kind == "function":
            self._say('cmake_parse_arguments(PARSE_ARGV 2 got "QUIET;LOUD" "ONE;OTHER" "MANY;MORE")')
        elif form == 2:
            self._say('cmake_parse_arguments(got "QUIET" "ONE" "MANY" ${p1} ${ARGN})')
        else:
            return
        self._tell('"${got_QUIET}|${got_LOUD}"', '"${got_ONE}|${got_OTHER}"', '"${got_MANY}|${got_MORE}"')
        self._tell('"${got_UNPARSED_ARGUMENTS}|${got_KEYWORDS_MISSING_VALUES}"')
        for word in ("got_ONE", "got_MANY", "got_QUIET"):
            self._say(f"if(DEFINED {word})")
            self._tell("defined")
            self._say("endif()")

    def _call(self, name: str) -> None:
        keywords = (
            "QUIET",
            "ONE v",
            "MANY v w",
            "OTHER",
            "MORE ${l1}",
            'ONE "x;y"',
            'MANY ""',
            "LOUD",
            "MANY u ONE w MANY t",
            "ONE",
        )
        more = " ".join(self.chance.sample(keywords, self.chance.randint(0, 3)))
        self._say(f"{name}({self._quoted()} {self._quoted()} {self._several(0, 2)} {more})")
        self._tell('"${a}"', '"${l1}"', '"${got_ONE}"')

    def _again(self) -> None:
        if self._functions and self._depth == 0:
            name = self.chance.choice(self._functions)
            if self.chance.random() < 0.3:
                self._say(f"cmake_language(CALL {name} {self._quoted()} {self._quoted()} {self._several(0, 1)})")
            else:
                self._call(name)

    def _language(self) -> None:
        kind = self.chance.randrange(5)
        name = self._variable()
        if kind == 0:
            self._say(f"cmake_language(CALL set {name} {self._several()})")
        elif kind == 1:
            self._say(f'cmake_language(EVAL CODE "set({name} ${{count}} evaluated)")')
        elif kind == 2:
            self._say(f"cmake_language(EVAL CODE [[set({name} ${{a}} raw)]])")
        elif kind == 3:
            self._say(
                f"block({self.chance.choice(('', 'SCOPE_FOR VARIABLES', f'PROPAGATE {name}', 'SCOPE_FOR POLICIES'))})"
            )
            self._say(f"  set({name} {self._several()})")
            self._say("  set(b inside)")
            self._tell('"${b}"')
            self._say("endblock()")
            self._tell('"${b}"')
        else:
            self._say(
                self.chance.choice(
                    (
                        "#[[ set(a comment)\n]]",
                        "# set(a comment",
                        "#[==[\nset(b no)\n]==]",
                        "set(c #[[inside]] d # end\n)",
                    )
                )
            )
        self._tell(f'"${{{name}}}"')

    def _statement(self) -> None:
        if self._depth > 3:
            self._set()
            return
        kinds: list[tuple[int, Callable[[], None]]] = [
            (5, self._set),
            (3, self._set_otherwise),
            (6, self._list_command),
            (6, self._string_command),
            (2, self._math),
            (3, self._path_command),
            (2, self._glob),
            (1, self._file_command),
            (6, self._check),
            (3, self._if),
            (4, self._foreach),
            (1, self._while),
            (2, self._again),
            (3, self._language),
        ]
        if self._depth == 0:
            kinds.append((3, self._define))
        self.chance.choices([one for _, one in kinds], [weight for weight, _ in kinds])[0]()
