"""Each kind of macro is dealt with in place: same length, same line breaks."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.settings import MacroSettings
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()
PIECES = (
    "class MY_EXPORT A { }; ", "BOOST_FOREACH(int a, b) ", "PLUGINLIB_EXPORT_CLASS(a, b)\n", "foreach(a, b) { }", "\n",
    "\r\n", "emit a();", "connect(a, SIGNAL(b(int)));", "EXPECT_THROW(A a(1), B);", "signals:", "public slots:", "(",
    ")", '"', "'", ",", ";", "#if 0\n", "#define ", "__attribute__((x))", "Q_OBJECT\n",
    '#ifdef __cplusplus\nextern "C" {\n#endif\n',
    "f(a) int a; {", "x", " = delete;", "typeid(int)", "va_arg(a, int)",
)  # fmt: skip


def shape(content):
    return len(content), [place for place, byte in enumerate(content) if byte in b"\n\r"]


@settings(max_examples=300, deadline=None)
@given(st.lists(st.sampled_from(PIECES), max_size=20).map("".join))
def test_positions_hold(text):
    content = text.encode()
    blanked = MACROS.blank(content)
    assert shape(blanked) == shape(content)
    assert shape(MACROS.repair(blanked)) == shape(content)


@pytest.mark.parametrize(
    ("source", "blanked"),
    [
        ("class MY_EXPORT A;", "class A;"),
        ("int x = MY_EXPORT;", "int x = MY_EXPORT;"),
        ("#define MY_EXPORT extern", "#define MY_EXPORT extern"),
        ("__attribute__((unused)) int a;", "int a;"),
        ("PLUGINLIB_EXPORT_CLASS(a::B, c::D)\nint x;", "int x;"),
        ("PLUGINLIB_EXPORT_CLASS(a, b);", "PLUGINLIB_EXPORT_CLASS(a, b);"),
        ("BOOST_FOREACH(int a, b) f(a);", "for (int a: b) f(a);"),
        ("BOOST_FOREACH(a, b) f(a);", "for(int a: b) f(a);"),
    ],
)
def test_blanked_in_every_file(source, blanked):
    assert "".join(MACROS.blank(source.encode()).decode().split()) == "".join(blanked.split())


@pytest.mark.parametrize(
    ("source", "repaired"),
    [
        ("foreach(int a, b) f(a);", "for (int a: b) f(a);"),
        ("emit done(1);", "done(1);"),
        ("connect(a, SIGNAL(b(int)));", "connect(a, SIGNAL());"),
        ("EXPECT_THROW(A a(1), B);", "{A a(1);};"),
        ("public slots:", "public:"),
        ("\nsignals:", "public:"),
        ("friend class a::B;", "friend a::B;"),
        ("void f() = delete;", "void f();"),
        ("MOCK_METHOD(std::string, name, (), (const, override));", "MOCK_METHOD();"),
        ("return decltype(a.b()){};", "return T{};"),
        ("auto f(A a) -> decltype(a.b(), c());", "auto f(A a) -> auto;"),
        ("auto g = typename A::Goal();", "auto g = A::Goal();"),
        (
            "template <typename T, typename std::enable_if<B, T>::type * = nullptr> class C;",
            "template <typename T, std::enable_if<B, T>::type> class C;",
        ),
        ("using Ts::operator()...;", ";"),
        ("operator++();", "f();"),
        ("// An end.\ntemplate <class T> void f();", "// An end.\ntemplate <class T> void f();"),
        ("// An end.\noperator++();", "// An end.\nf();"),
        ("a->template f<T>();", "a->f<T>();"),
        ("extern template void A<B>::f(\n  C);", ";"),
        ("class VISIBLE_HERE A : public B {};", "class A : public B {};"),
        ("TEST_F(Wheels, 3_wheels) {}", "TEST_F(Wheels, n_wheels) {}"),
        ("bind((bool(A::B::*)(const C &))&A::B::f)", "bind(&A::B::f)"),
        ("const_forEach(Map, &m_.get(1)) { f(); }", "for(;;) { f(); }"),
        ("std::for_each(a, b, c) {}", "std::for_each(a, b, c) {}"),
        ("A_PUBLISHER_PTR(Path) pub_;", "A_PUBLISHER_PTR pub_;"),
        ("f(const A_SHARED_PTR(Path) & path);", "f(const A_SHARED_PTR & path);"),
        ('print("%" PRId64 " of %" PRIuFAST8, a);', 'print("%" " of %", a);'),
        ("int PRIx32 = 3;", "int PRIx32 = 3;"),
    ],
)
def test_repaired_where_a_file_has_faults(source, repaired):
    assert "".join(MACROS.repair(source.encode()).decode().split()) == "".join(repaired.split())


def test_settings_of_a_project():
    macros = load_macros(MacroSettings(blank=("MY_[A-Z]+X",), statement=("REGISTER",)))
    assert macros.blank(b"int MY_FOOX(1) f(); REGISTER(a)\n;").split() == b"int f(); REGISTER(a) ;".split()
    assert macros.blank(b"REGISTER(a)\nint b;").split() == b"int b;".split()
    assert macros.version != MACROS.version


@pytest.mark.parametrize("name", ["(", "a*", "(?=a)a", r"(a)\1"])
def test_a_name_that_is_no_pattern(name):
    with pytest.raises(ValueError, match="name of a macro"):
        load_macros(MacroSettings(blank=(name,)))


@settings(max_examples=300, deadline=None)
@given(
    st.lists(
        st.sampled_from(
            ("Foo & foo", "(bar);", "(b->c());", " ", "\n", "const A<int> &", "x", "::type", ">", "* = nullptr", "*=0 ")
        ),
        max_size=12,
    ).map("".join)
)
def test_what_a_rewrite_needs_is_wherever_its_pattern_is(text):
    needing = [row for row in MACROS._rewrites if row.needs is not None]
    assert len(needing) == 2
    for row in needing:
        assert row.pattern.search(text.encode()) is None or row.needs.search(text.encode())
