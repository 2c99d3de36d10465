import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.launch.substitution_text import parse, words
from roslens.source.extract.launch_python.deferred import Scope, resolve
from roslens.source.extract.symbolic.text import Text


class Files:
    def package(self, name):
        return {"robot": "src/robot"}.get(name)

    def content(self, path):
        return {"name.txt": b"r3", "bytes.bin": b"\xff"}.get(path)


SCOPE = Scope(
    Files(),
    {"a": Text.of("1"), "b": Text.of("two"), "yes": Text.of("true")},
    {"HOME": "/h"},
    "src/robot/l/x.xml",
    turns={"i": Text.of("4")},
)


@pytest.mark.parametrize(
    ("written", "result"),
    [
        ("plain", "plain"),
        ("", ""),
        ("$(var a)-$(var b)", "1-two"),
        ("$(var $(var c 'b'))", "two"),
        ("$(var gone fallback)", "fallback"),
        ("$(var gone '')", ""),
        ("$(find-pkg-share robot)/config", "src/robot/config"),
        ("$(find-pkg-share gone)/config", "*/config"),
        ("$(env HOME)$(env GONE x)", "/h*"),
        ("$(eval '1 + $(var a)')", "2"),
        (r"$(eval '1 + int(\'$(var a)\') ')", "2"),
        (r"$(eval ' \'uas_\' + \'$(var b)\' ')", "uas_two"),
        ("$(eval \"'$(var b)' == 'two'\")", "True"),
        ("$(not $(var yes))", "false"),
        ("$(and $(var yes) $(not false))", "true"),
        ("$(or false $(equals $(var b) two))", "true"),
        ("$(not-equals $(var b) two)", "false"),
        ("$(if $(var yes) left right)", "left"),
        ("$(dirname)/y", "src/robot/l/y"),
        ("$(path-join a b ../c)", "a/c"),
        ("$(path-join a /b c)", "/b/c"),
        ("$(path-join $(find-pkg-prefix robot) share robot c.yaml)", "src/robot/c.yaml"),
        ("$(find-pkg-prefix robot)/share/robot/c.yaml", "src/robot/c.yaml"),
        ("$(find-pkg-prefix robot)/lib/robot/x", "*/lib/robot/x"),
        ("$(string-join . https://$(var b) ros org)", "https://two.ros.org"),
        ("$(string-join '' $(var a) b)", "1b"),
        ("$(string-join .)", "*"),
        ("$(any false $(var yes))", "true"),
        ("$(all $(var yes) false)", "false"),
        ("$(file-content name.txt)/x", "r3/x"),
        ("$(file-content gone.txt)", "*"),
        ("$(file-content bytes.bin)", "*"),
        ("$(index i)$(for-var i)", "44"),
        ("$(for-var other else)", "else"),
        ("$(for-var other)", "*"),
        ("$(launch_log_dir)/x", "*/x"),
        ("$(param name)", "*"),
        ("$(ament-index-resource rosidl_interfaces std_msgs)", "*"),
        ("$(anon n)", "n_*"),
        ("$(command 'ls -l')", "*"),
        ("$(exec-in-pkg a b)", "*"),
        ("$(nothing a)", "*"),
        ("$(var)", "*"),
        ("$(var a", "*"),
        ("it's $(var a) o'clock", "it's 1 o'clock"),
        ("\\$(var a)", "$(var a)"),
        ("$5", "$5"),
    ],
)
def test_substitutions(written, result):
    assert resolve(parse(written), SCOPE).pattern == result


def test_what_is_unknown_says_why():
    assert resolve(parse("$(nothing a)"), SCOPE).holes[0].reason == "unsupported substitution $(nothing a)"
    assert "never closed" in resolve(parse("$(var a"), SCOPE).holes[0].reason
    assert "too deep" in str(resolve(parse("$(not " * 50 + "true" + ")" * 50), SCOPE))
    assert "package gone" in str(resolve(parse("$(find-pkg-share gone)"), SCOPE).holes[0].reason)


@given(st.text(st.sampled_from("$()'\" varenvgotpkh-\\"), max_size=60))
def test_nothing_breaks_it(written):
    resolve(parse(written), SCOPE)


def words_of(written, **configurations):
    scope = Scope(Files(), {name: Text.of(value) for name, value in configurations.items()}, {}, "pkg/launch/a.xml")
    return [str(resolve(one, scope)) for one in words(written)]


@pytest.mark.parametrize(
    ("written", "found"),
    [
        ("", []),
        ("  ", []),
        ("a b", ["a", "b"]),
        ("/$(var topic) /said --depth 2", ["/a b", "/said", "--depth", "2"]),
        ("$(var topic)$(var topic)", ["a ba b"]),
        ("$(var topic) $(var topic)", ["a b", "a b"]),
        ("x $(var topic)y z", ["x", "a by", "z"]),
        ("x$(var topic) y", ["xa b", "y"]),
        ("--text 'a word' b", ["--text", "a word", "b"]),
        ("--ros-args -r a:=$(var topic)", ["--ros-args", "-r", "a:=a b"]),
    ],
)
def test_words_of_a_command_line(written, found):
    assert words_of(written, topic="a b") == found


def test_words_with_a_quote_that_is_never_closed():
    (one,) = words("a 'b")
    assert "quotation" in str(resolve(one, Scope(Files(), {}, {}, "")))
