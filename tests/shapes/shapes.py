"""The worst shapes of each grammar that is read: what nests, what repeats, what is long, what is never closed.

A shape makes content of about so many bytes. Mutations of real files hardly ever come to these.
"""

from __future__ import annotations

from collections.abc import Callable

Shape = Callable[[int], bytes]


def repeated(unit: str, before: str = "", after: str = "") -> Shape:
    """Return the shape of one unit again and again."""

    def make(size: int) -> bytes:
        room = max(0, size - len(before) - len(after))
        return f"{before}{unit * (room // len(unit.encode()))}{after}".encode()

    return make


def nested(begin: str, end: str, inside: str = "", before: str = "", after: str = "") -> Shape:
    """Return the shape of one unit within itself."""

    def make(size: int) -> bytes:
        depth = max(0, size - len(before) - len(after) - len(inside)) // (len(begin) + len(end))
        return f"{before}{begin * depth}{inside}{end * depth}{after}".encode()

    return make


def numbered(unit: str, before: str = "", after: str = "") -> Shape:
    """Return the shape of units that all differ: ``{}`` in them is a number."""

    def make(size: int) -> bytes:
        pieces, length, number = [before], len(before) + len(after), 0
        while length < size:
            piece = unit.replace("{}", str(number))
            pieces.append(piece)
            length += len(piece)
            number += 1
        return "".join([*pieces, after]).encode()

    return make


_CPP: dict[str, Shape] = {
    "blanks": repeated(" ", "int", "x = {\n"),
    "blanks behind a bracket": repeated(" ", "int x[", "\n"),
    "blanks in a directive": repeated(" ", "#define A(", "\n"),
    "blanks in a comment": repeated(" ", "// roslens: ignore[", "\n"),
    "lines that go on": repeated("\\\n", "#define A ", "\n"),
    "nested parentheses": nested("(", ")", "1", "int x = ", ";"),
    "nested braces": nested("{", "}", before="void f()"),
    "nested templates": nested("a<", ">", "int", "", " x;"),
    "nested lambdas": nested("[]{return ", ";}();", "1", "auto x = ", ";"),
    "else if": repeated("else if(a){}", "void f(){if(a){}", "}"),
    "ternaries": repeated("a?b:", "int x = ", "c;"),
    "unclosed parentheses": repeated("("),
    "unclosed braces": repeated("{"),
    "unclosed templates": repeated("a<b,", "auto x = "),
    "unclosed comments": repeated("/*"),
    "unclosed strings": repeated('"a\n'),
    "markup": repeated("<!--"),
    "statements in one function": repeated("x=y;", "void f(){", "}"),
    "declarations in one function": numbered("int a{}=0;", "void f(){", "}"),
    "cases": numbered("case {}:", "void f(int a){switch(a){", "}}"),
    "enumerators": numbered("a{},", "enum E{", "};"),
    "members": numbered("int a{};", "class A{", "};"),
    "parameters": numbered("int a{},", "void f(", "int z);"),
    "arguments": repeated("a,", "int x = f(", "a);"),
    "functions": numbered("int f{}(int a){return a;}\n"),
    "classes": numbered("class A{}:public B{}{};\n"),
    "derived classes": numbered("class A{} : public A0 {};\n", "class A0 {};\n"),
    "templates": numbered("template<class T{}> class A{};\n"),
    "operators": repeated("a+", "int x = ", "a;"),
    "calls in a row": repeated(".f()", "auto x = a", ";"),
    "shifts": repeated("<<a", "void f(){std::cout", ";}"),
    "stars": repeated("*", "int ", "x;"),
    "names in names": repeated("A::", "", "x y;"),
    "one long name": repeated("a", "int ", ";"),
    "one long number": repeated("9", "int x = ", ";"),
    "one long string": repeated("a", 'const char* x = "', '";'),
    "one long comment": repeated("a ", "/* ", " */"),
    "lines of comment": repeated("// a\n"),
    "comments that silence": numbered("// NOLINT(a{})\n"),
    "blocks that silence": repeated("// NOLINTBEGIN\n"),
    "conditions": repeated("#if A\n"),
    "branches": repeated("#elif A\n", "#if A\n", "#endif\n"),
    "macros": numbered("#define A{} A\n"),
    "macros of macros": numbered("#define A{} B{} B{}\n"),
    "includes": numbered('#include "a{}.h"\n'),
    "raw strings": repeated('R"a('),
    "attributes": repeated("[[a]]", "", " int x;"),
    "publishers": numbered('auto p{} = n.advertise<std_msgs::String>("t{}", 1);\n', "void f(ros::NodeHandle n){", "}"),
    "one string made of others": repeated(
        "s = s + s;", 'void f(ros::NodeHandle n){std::string s="a";', "n.advertise<A>(s, 1);}"
    ),
    "branches that join": repeated(
        'if (a) s = "b" + s; else s = "c" + s;',
        "void f(ros::NodeHandle n, bool a){std::string s;",
        "n.advertise<A>(s, 1);}",
    ),
    "zero bytes": repeated("\0"),
    "control characters": repeated("\x0c\x0b\x1b"),
    "letters beyond ASCII": repeated("é"),
    "backslashes at the end of lines": repeated("\\\n"),
}
_PYTHON: dict[str, Shape] = {
    "blanks": repeated(" ", "x =", "(\n"),
    "blanks behind a bracket": repeated(" ", "x = [", "\n"),
    "blanks in a comment": repeated(" ", "# roslens: ignore[", "\n"),
    "lines that go on": repeated("\\\n", "x = ", "\n"),
    "nested parentheses": nested("(", ")", "1", "x = "),
    "nested brackets": nested("[", "]", "1", "x = "),
    "nested tables": nested("{1:", "}", "1", "x = "),
    "nested lambdas": repeated("lambda:", "x = ", "1"),
    "nested blocks": lambda size: b"".join(b" " * depth + b"if a:\n" for depth in range(int((2 * size) ** 0.5))),
    "unclosed parentheses": repeated("("),
    "unclosed strings": repeated('"""a'),
    "else if": repeated("elif a:\n pass\n", "if a:\n pass\n"),
    "statements in one function": repeated(" x=y\n", "def f():\n"),
    "functions": numbered("def f{}(a):\n return a\n"),
    "classes": numbered("class A{}(B{}):\n pass\n"),
    "methods": numbered(" def f{}(self):\n  pass\n", "class A:\n"),
    "parameters": numbered("a{},", "def f(", "z):\n pass\n"),
    "arguments": repeated("a,", "f(", "a)\n"),
    "operators": repeated("a+", "x = ", "a\n"),
    "powers": repeated("9**", "x = ", "9\n"),
    "comparisons": repeated("a<", "x = ", "a\n"),
    "calls in a row": repeated(".f()", "x = a", "\n"),
    "decorators": repeated("@a\n", "", "def f():\n pass\n"),
    "imports": numbered("import a{}\n"),
    "stars": repeated("*", "f(", "a)\n"),
    "not": repeated("not ", "x = ", "a\n"),
    "for in a list": repeated(" for a in b", "x = [a", "]\n"),
    "texts with values": repeated("{a}", 'x = f"', '"\n'),
    "one long name": repeated("a", "", " = 1\n"),
    "one long number": repeated("9", "x = ", "\n"),
    "one long string": repeated("a", 'x = "', '"\n'),
    "one string doubled": repeated("s = s + s\n", "s = 'a'\n"),
    "lines of comment": repeated("# a\n"),
    "comments that silence": numbered("# noqa: A{}\n"),
    "publishers": numbered(" n.create_publisher(String, 't{}', 1)\n", "def f(n):\n"),
    "launch nodes": numbered(
        " Node(package='p', executable='e{}'),\n",
        "from launch_ros.actions import Node\ndef generate_launch_description():\n return LaunchDescription([\n",
        "])\n",
    ),
    "tabs and blanks": repeated("\t ", "", "x\n"),
    "backslashes at the end of lines": repeated("\\\n"),
    "zero bytes": repeated("\0"),
    "letters beyond ASCII": repeated("é"),
}
_CMAKE: dict[str, Shape] = {
    "blanks": repeated(" ", "set(a", "\n"),
    "blanks before a bracket": repeated(" ", "set", "(a b)\n"),
    "blanks in a text": repeated(" ", 'set(a "${b', '")\n'),
    "nested conditions": nested("if(A)\n", "endif()\n"),
    "nested loops": nested("foreach(a 1 2)\n", "endforeach()\n"),
    "loops over long lists": lambda size: b"foreach(a " + b"x " * (size // 4) + b")\nset(b ${b} ${a})\nendforeach()\n",
    "nested parentheses": nested("(", ")", before="if", after="\nendif()\n"),
    "nested references": nested("${", "}", "a", "set(b ", ")\n"),
    "unclosed parentheses": repeated("set("),
    "unclosed strings": repeated('set(a "\n'),
    "unclosed brackets": repeated("[==["),
    "unclosed conditions": repeated("if(A)\n"),
    "commands": repeated("set(a b)\n"),
    "variables": numbered("set(a{} b)\n"),
    "a list that grows": repeated("list(APPEND a b)\n"),
    "a list that doubles": repeated("set(a ${a} ${a})\n", "set(a b)\n"),
    "a string that doubles": repeated('set(a "${a}${a}")\n', "set(a b)\n"),
    "targets": numbered("add_executable(a{} a{}.cpp)\n"),
    "sources": numbered("a{}.cpp ", "add_executable(a ", ")\n"),
    "links": numbered("target_link_libraries(a b{})\n", "add_executable(a a.cpp)\n"),
    "libraries that link each other": numbered("add_library(l{} a.cpp)\ntarget_link_libraries(l{} l0)\n"),
    "conditions": repeated("A AND ", "if(", "A)\nendif()\n"),
    "not": repeated("NOT ", "if(", "A)\nendif()\n"),
    "branches": repeated("elseif(A)\n", "if(A)\n", "endif()\n"),
    "functions": numbered("function(f{})\nendfunction()\nf{}()\n"),
    "functions that call the one before": numbered("function(f{})\nf0()\nendfunction()\n"),
    "a function that calls itself": repeated("f()\n", "function(f)\nf()\nf()\nendfunction()\n"),
    "a loop without end": repeated("set(a b)\n", "while(TRUE)\n", "endwhile()\n"),
    "expressions for math": repeated("9*", 'math(EXPR a "', '9")\n'),
    "patterns": repeated("(a*)*", 'string(REGEX MATCH "', f'b" x "{"a" * 200}")\n'),
    "replacements": repeated('string(REPLACE "a" "aa" x "${x}")\n', 'set(x "a")\n'),
    "includes of itself": repeated("include(CMakeLists.txt)\n"),
    "subfolders": numbered("add_subdirectory(a{})\n"),
    "generator expressions": nested("$<", ">", "a", "set(b ", ")\n"),
    "one long word": repeated("a", "set(b ", ")\n"),
    "comments": repeated("# a\n"),
    "zero bytes": repeated("\0"),
}
_XML_HEAD = (
    "<package format='3'><name>arm</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@b.org'>a</maintainer><license>MIT</license>"
)
_MANIFEST: dict[str, Shape] = {
    "blanks": repeated(" ", f"{_XML_HEAD}<depend", "></package>"),
    "blanks in a text": repeated(" ", f"{_XML_HEAD}<depend>a", "b</depend></package>"),
    "blanks in a condition": repeated(" ", f'{_XML_HEAD}<depend condition="$A', '">a</depend></package>'),
    "nested elements": nested("<a>", "</a>", before="<package>", after="</package>"),
    "unclosed elements": repeated("<a>"),
    "unclosed tags": repeated("<a "),
    "unclosed comments": repeated("<!--"),
    "unclosed texts": repeated("<![CDATA["),
    "many elements": repeated("<a/>", _XML_HEAD, "</package>"),
    "dependencies": numbered("<depend>a{}</depend>", _XML_HEAD, "</package>"),
    "one dependency": repeated("<depend>a</depend>", _XML_HEAD, "</package>"),
    "conditions": numbered('<depend condition="$A == {}">a</depend>', _XML_HEAD, "</package>"),
    "one long condition": repeated("$A == 1 and ", f'{_XML_HEAD}<depend condition="', '$A == 1">a</depend></package>'),
    "a condition of parentheses": nested(
        "(", ")", "$A == 1", f'{_XML_HEAD}<depend condition="', '">a</depend></package>'
    ),
    "attributes": numbered('a{}="b" ', f"{_XML_HEAD}<depend ", ">a</depend></package>"),
    "attributes of the root": numbered('a{}="b" ', "<package ", "/>"),
    "one long attribute": repeated("a", f'{_XML_HEAD}<depend a="', '">a</depend></package>'),
    "one long text": repeated("a ", f"{_XML_HEAD}<a>", "</a></package>"),
    "texts apart": repeated("a<b/>", f"{_XML_HEAD}<a>", "</a></package>"),
    "entities": repeated("&amp;", f"{_XML_HEAD}<a>", "</a></package>"),
    "declared entities": numbered('<!ENTITY a{} "b">', "<!DOCTYPE a [", "]><package/>"),
    "namespaces": numbered('xmlns:a{}="b" ', "<package ", "/>"),
    "maintainers": numbered("<maintainer email='a@b.org'>a{}</maintainer>", _XML_HEAD, "</package>"),
    "versions": repeated("1.", "<package><name>a</name><version>", "1</version></package>"),
    "exports": numbered("<a{} b='c'/>", f"{_XML_HEAD}<export>", "</export></package>"),
    "placeholders": repeated("{{", _XML_HEAD, "</package>"),
    "zero bytes": repeated("\0"),
    "letters beyond ASCII": repeated("é"),
}
_LAUNCH: dict[str, Shape] = {
    "blanks": repeated(" ", "<launch><node", "/></launch>"),
    "blanks in a substitution": repeated(" ", '<launch><arg name="b" value="$(arg', 'a"/></launch>'),
    "blanks in a text": repeated(" ", '<launch><node pkg="p" type="t" exec="t" name="n" args="a', 'b"/></launch>'),
    "nested groups": nested("<group>", "</group>", before="<launch>", after="</launch>"),
    "unclosed groups": repeated("<group>", "<launch>"),
    "nodes": numbered('<node pkg="p" type="t" exec="t" name="n{}"/>', "<launch>", "</launch>"),
    "arguments": numbered('<arg name="a{}" default="b"/>', "<launch>", "</launch>"),
    "arguments of each other": numbered('<arg name="a{}" default="$(arg a0)$(var a0)"/>', "<launch>", "</launch>"),
    "an argument that doubles": repeated(
        '<arg name="a" value="$(arg a)$(arg a)"/><let name="a" value="$(var a)$(var a)"/>',
        '<launch><arg name="a" default="b"/><let name="a" value="b"/>',
        "</launch>",
    ),
    "nested substitutions": nested("$(arg ", ")", "a", '<launch><arg name="b" value="', '"/></launch>'),
    "unclosed substitutions": repeated("$(", '<launch><arg name="b" value="', '"/></launch>'),
    "an expression": repeated("1+", '<launch><arg name="b" value="$(eval ', '1)"/></launch>'),
    "powers": repeated("9**", '<launch><arg name="b" value="$(eval ', '9)"/></launch>'),
    "an expression of parentheses": nested("(", ")", "1", '<launch><arg name="b" value="$(eval ', ')"/></launch>'),
    "includes of itself": repeated(
        '<include file="$(find pkg)/launch/a.launch"/><include file="$(find-pkg-share pkg)/launch/a.launch.xml"/>',
        "<launch>",
        "</launch>",
    ),
    "conditions": repeated('<group if="$(arg a)">', '<launch><arg name="a"/>', "</launch>"),
    "remaps": numbered('<remap from="a{}" to="b"/>', "<launch>", '<node pkg="p" type="t" exec="t" name="n"/></launch>'),
    "remaps for many nodes": numbered(
        '<remap from="a{}" to="b"/><node pkg="p" type="t" exec="t" name="n{}"/>', "<launch>", "</launch>"
    ),
    "parameters": numbered('<param name="a{}" value="b"/>', "<launch>", '<node pkg="p" type="t" name="n"/></launch>'),
    "rosparam": nested("[", "]", "1", "<launch><rosparam>a: ", "</rosparam></launch>"),
    "attributes": numbered('a{}="b" ', "<launch><node ", "/></launch>"),
    "a long namespace": repeated("a/", '<launch><group ns="', '"/></launch>'),
    "a long command": repeated("a ", '<launch><param name="a" command="', '"/></launch>'),
    "unclosed comments": repeated("<!--"),
    "declared entities": numbered('<!ENTITY a{} "b">', "<!DOCTYPE a [", "]><launch/>"),
    "zero bytes": repeated("\0"),
}
_ROBOT: dict[str, Shape] = {
    "nested elements": nested("<a>", "</a>", before="<robot>", after="</robot>"),
    "links": numbered('<link name="a{}"/>', '<robot name="r">', "</robot>"),
    "macros": numbered(
        '<xacro:macro name="m{}" params="a"><xacro:m0 a="1"/></xacro:macro>', '<robot xmlns:xacro="x">', "</robot>"
    ),
    "macros that double": numbered(
        '<xacro:macro name="m{}"><xacro:m1/><xacro:m1/></xacro:macro>', '<robot xmlns:xacro="x">', "<xacro:m2/></robot>"
    ),
    "a macro that calls itself": repeated(
        "<xacro:m/>", '<robot xmlns:xacro="x"><xacro:macro name="m"><xacro:m/><xacro:m/></xacro:macro>', "</robot>"
    ),
    "properties": numbered('<xacro:property name="p{}" value="${p0}"/>', '<robot xmlns:xacro="x">', "</robot>"),
    "includes of itself": repeated('<xacro:include filename="robot.xacro"/>', '<robot xmlns:xacro="x">', "</robot>"),
    "plugins": numbered(
        '<gazebo><plugin name="p{}" filename="libgazebo_ros_camera.so"/></gazebo>', "<robot>", "</robot>"
    ),
    "attributes": numbered('a{}="b" ', "<robot ", "/>"),
    "unclosed elements": repeated("<a>"),
}
_YAML: dict[str, Shape] = {
    "nested lists": nested("[", "]", before="a: "),
    "nested tables": nested("{a: ", "}", "1"),
    "indented tables": lambda size: b"".join(b" " * depth + b"a:\n" for depth in range(int((2 * size) ** 0.5))),
    "lists in lists": repeated("- ", "", "a\n"),
    "unclosed lists": repeated("["),
    "unclosed strings": repeated('"a\n'),
    "keys": numbered("a{}: b\n"),
    "one key": repeated("a: b\n"),
    "values": repeated("1, ", "a: [", "1]\n"),
    "parameters": numbered("    a{}: b\n", "n:\n  ros__parameters:\n"),
    "nodes": numbered("n{}:\n  ros__parameters:\n    a: 1\n"),
    "aliases": lambda size: (
        b"a0: &a0 [x]\n"
        + b"".join(b"a%d: &a%d [*a%d, *a%d]\n" % (n, n, n - 1, n - 1) for n in range(1, max(2, size // 25)))
    ),
    "one alias": repeated("*a, ", "a: &a 1\nb: [", "1]\n"),
    "merges": repeated("<<: *a\n", "a: &a {b: 1}\n"),
    "complex keys": nested("? ", "", "a", "", "\n"),
    "tags": repeated("!a ", "a: ", "b\n"),
    "documents": repeated("---\na: 1\n"),
    "one long number": repeated("9", "a: ", "\n"),
    "one long exponent": repeated("9", "a: 1e", "\n"),
    "sexagesimal": repeated(":59", "a: 1", "\n"),
    "one long string": repeated("a", "a: ", "\n"),
    "one block": repeated(" a\n", "a: |\n"),
    "one long key": repeated("a", "", ": 1\n"),
    "blanks": repeated(" ", "a:", "*b: [\n"),
    "blanks behind a dash": repeated(" ", "-", "[\n"),
    "comments": repeated("# a\n"),
    "letters beyond ASCII": repeated("é"),
    "zero bytes": repeated("\0"),
}
_INTERFACE: dict[str, Shape] = {
    "fields": numbered("int32 a{}\n"),
    "constants": numbered("int32 A{}=1\n"),
    "one name": repeated("int32 a\n"),
    "bounds": repeated("9", "string[", "] a\n"),
    "bounds of texts": repeated("9", "string<=", "[2] a\n"),
    "brackets": repeated("[]", "int32", " a\n"),
    "unclosed brackets": repeated("[", "int32", " a\n"),
    "values of a list": repeated("1,", "int32[] a [", "1]\n"),
    "one long number": repeated("9", "int32 A=", "\n"),
    "one long float": repeated("9", "float64 A=1e", "\n"),
    "one long name": repeated("a", "int32 ", "\n"),
    "one long type": repeated("a/", "", "A b\n"),
    "one long text": repeated("a", 'string A="', '"\n'),
    "quotes": repeated('"', "string A=", "\n"),
    "sections": repeated("---\n"),
    "comments": repeated("# a\n"),
    "comments behind": numbered("int32 a{} # a # a # a\n"),
    "blanks": repeated(" ", "int32", "a\n"),
    "blanks before nothing": repeated(" ", "int32 a", "?\n"),
    "blanks in a bracket": repeated(" ", "int32[", " a = [\n"),
    "annotations": repeated("@a(b=1)", "module a{struct A{", "long a;};};"),
    "modules": nested("module a{", "};", "struct A{long a;};"),
    "sequences": nested("sequence<", ">", "long", "struct A{", " a;};"),
    "members": numbered("long a{};", "struct A{", "};"),
    "zero bytes": repeated("\0"),
}
_TOML: dict[str, Shape] = {
    "nested lists": nested("[", "]", before="a = "),
    "nested tables": nested("{a=", "}", "1", "a = "),
    "unclosed lists": repeated("[", "a = "),
    "keys": numbered("a{} = 1\n"),
    "tables": numbered("[a{}]\n"),
    "dotted keys": repeated("a.", "", "a = 1\n"),
    "dotted tables": repeated("a.", "[", "a]\n"),
    "tables below each other": lambda size: b"".join(
        b"[" + b".".join([b"a"] * depth) + b"]\nb=1\n" for depth in range(1, int(size**0.5))
    ),
    "lists of tables": repeated("[[ignore]]\n"),
    "values": repeated("1,", "a = [", "1]\n"),
    "one long number": repeated("9", "a = ", "\n"),
    "one long string": repeated("a", 'a = "', '"\n'),
    "escapes": repeated("\\n", 'a = "', '"\n'),
    "unclosed strings": repeated('a = """\n'),
    "patterns": repeated("*", '[workspace]\nignore = ["', 'a"]\n'),
    "accepted": numbered('[[accepted]]\nfingerprint = "{}"\nreason = "r"\n'),
    "comments": repeated("# a\n"),
    "one long key": repeated("a", "", " = 1\n"),
    "blanks": repeated(" ", "fail_on =", '"x"\n'),
    "blanks behind a bracket": repeated(" ", 'engine = """\n[', '\n"""\nfail_on = "x"\n'),
    "blanks before nothing": repeated(" ", 'engine = """\na', '\n"""\nfail_on = "x"\n'),
}
_DOCUMENT: dict[str, Shape] = {
    "versions": numbered("1.0.{} (2020-01-01)\n------------------\n* a\n"),
    "underlines": repeated("-"),
    "bullets": repeated("* a\n"),
    "nested bullets": lambda size: b"".join(b" " * depth + b"* a\n" for depth in range(int((2 * size) ** 0.5))),
    "links": repeated("[a](b) "),
    "brackets": repeated("["),
    "images": repeated("![a"),
    "stars": repeated("*"),
    "one long line": repeated("a "),
    "headings": numbered("# a{}\n"),
    "quotes": repeated("> "),
    "tables": repeated("|a"),
    "digits": repeated("1."),
    "blank lines": repeated(" \n"),
    "blanks": repeated(" ", "1.0.0", "(\n---\n* a\n"),
    "blanks behind a bracket": repeated(" ", "[", "\n"),
}

SHAPES = {
    "C++": _CPP,
    "Python": _PYTHON,
    "CMake": _CMAKE,
    "package.xml": _MANIFEST,
    "launch files": _LAUNCH,
    "robot descriptions": _ROBOT,
    "YAML": _YAML,
    "messages": _INTERFACE,
    "TOML": _TOML,
    "documents": _DOCUMENT,
}
