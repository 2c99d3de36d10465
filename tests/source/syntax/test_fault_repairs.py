"""C++ that the grammar does not read as it is written: each form parses, and its functions are reported."""

import pytest

from roslens.source.syntax.cpp import parse_cpp, tree_of_cpp
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()
FORMS = {
    "trailing macros": (
        (
            "class A { void f() X_OVERRIDE; int g() const X_NOEXCEPT;\n bool h(int) X_FINAL X_OVERRIDE { return a; }\n"
            "  void k() REQUIRES(mu_) { x(); } int v_ GUARDED(mu_); };\nvoid m(int a, int b DEFAULT(0));\n"
            "int n(int x) PURE { return x; }"
        ),
        ["A::h", "A::k", "n"],
    ),
    "a macro behind the name of a class": ("class B X_FINAL : public A { void f() { } };", ["B::f"]),
    "leading macros": (
        (
            "MY_INLINE void f() { g(); }\nstatic BOOL WINAPI h(DWORD t) { return 1; }\n"
            "MY_QUALIFIER T k(T const & x) { return x; }\ntemplate <class T> MY_QUALIFIER d::V<T> l(T x) { g(); }\n"
            "JNIEXPORT jlong JNICALL\nJava_x(JNIEnv * e, jclass) { return 1; }\n"
        ),
        ["f", "h", "k", "l", "Java_x"],
    ),
    "a macro before a constructor": ("MY_QUALIFIER V<T>::V() : a(1) { x(); }", ["V::V"]),
    "macros that stand for statements": (
        "FMT_BEGIN_NAMESPACE\nnamespace d { int a; }\nFMT_END_NAMESPACE\nint f() { return 1; }\nNS_OPEN(a)\nint g();\n",
        ["f"],
    ),
    "what macros are given": (
        (
            "SMALL_POLICY(signed char);\nclass A { STATS(Loop, Id,); int a; };\n"
            "void f() { CHECK_FIELD(0, float, A::B, x); if (COMPARE(<, a, b)) { g(); } }"
        ),
        ["f"],
    ),
    "pointers to members": (
        (
            "void g(float M::*f, M * a) { a->*f = 1; M m; m.*f = 2; }\n"
            "template <class T> struct X { void (T::*cb_)(int) const; T * o; void run() { (o->*cb_)(1); } };\n"
            "void h() { connect(static_cast<void (Q::*)(int)>(&Q::x)); std::map<int, double C::*> m; }"
        ),
        ["g", "X::run", "h"],
    ),
    "constraints of templates": (
        (
            "template <class T, std::enable_if_t<C<T>::v>* = 0> void f(T t) { x(); }\n"
            "template <class T> void g(T t, typename std::enable_if<C<T>::v>::type* = 0) { x(); }\n"
            "template <class T> T h(T t, std::enable_if_t<C<T>>* = nullptr) { x(); }"
        ),
        ["f", "g", "h"],
    ),
    "CUDA": (
        (
            "__global__ void k(float * a) { __shared__ float s[3]; a[0] = 1; }\n"
            "__host__ __device__ inline float f(float a) { return a; }\nvoid l() { k<<<1, 2, 0, s>>>(a); }\n"
        ),
        ["k", "f", "l"],
    ),
    "enumerations with a type and no name": ("struct A { enum : size_t { X = 0 }; void f() { } };", ["A::f"]),
    "operators by name": ("struct A { A(const A & r) { operator=(r); } };", ["A::A"]),
    "a destructor with arguments": ("template <class T> struct A { virtual ~A<T>() { x(); } };", ["A::~A"]),
    "decltype of two": (
        "template <class T> struct H<T, decltype((void)T::a, 0)> : B {};\nint f() { return 1; }",
        ["f"],
    ),
    "units": ("const double T = 0.01f METERS;\nint f() { return 64 KB; }", ["f"]),
    "exceptions": (
        (
            "TEST(a, b) { ASSERT_NO_THROW(t.tick();); EXPECT_THROW(\n try { f(); } catch (X & e) { throw; }, X); }\n"
            "INSTANTIATE_TEST_SUITE_P(/**/, B, testing::Values(1));"
        ),
        ["TEST(a,b)"],
    ),
    "directives": ("#if defined(A) && \\\n  B < 5 7\n#endif\nint f() { return A(B) \\  // here\n ; }", ["f"]),
    "macros that stand for types": (
        (
            "typedef STD_VECTOR(ns::Item) Items;\nvoid f() { STD_VECTOR(ns::Item) items; g(items); }\n"
            "Matrix<3, PLAIN(typename V::X)::Options> h() { return x; }"
        ),
        ["f", "h"],
    ),
    "macros behind a comment": (
        (
            "BEGIN_NAMESPACE_X\n\n/**\n * What it is.\n */\nclass A : public B\n{\npublic:\n  void f() { g(); }\n};\n"
            "END_NAMESPACE_X\n"
        ),
        ["A::f"],
    ),
    "statements without a semicolon": (
        'void f() {\n  if (a) { throw_pretty("a" << b) }\n  ASSERT_UNKNOWN(a)\n  // why\n  b.resize(n);\n}',
        ["f"],
    ),
    "a loop in small letters": ("void f() { item_foreach()\n g(); }", ["f"]),
    "words of a compiler": (
        (
            "_x_inline void f(int a);\nstatic const int m[3] PROGMEM = {1, 2, 3};\n"
            "void g() { *(__IO uint32_t *)a = 1; if (NS_OF_X isZero(b) == 1) { h(); } }\nextern int b __ALIGN_END;"
        ),
        ["g"],
    ),
    "what is deleted": ("void f() { delete[] (a); delete[] *b; delete[] (int *)c; }", ["f"]),
    "texts": ('void f() { write("a" NEWLINE_A); }', ["f"]),
}


@pytest.mark.parametrize("form", FORMS)
def test_it_parses(form):
    source, functions = FORMS[form]
    facts = parse_cpp(source.encode(), MACROS)
    assert facts.faults == ()
    assert [one.qualified_name for one in facts.functions] == functions


@pytest.mark.parametrize("form", FORMS)
def test_every_byte_keeps_its_place(form):
    content = FORMS[form][0].encode()
    source = tree_of_cpp(content, MACROS).source
    assert len(source) == len(content)
    assert [at for at, byte in enumerate(source) if byte == 10] == [at for at, byte in enumerate(content) if byte == 10]


def test_a_condition_keeps_its_statement():
    source = "void f() { if (a) LEAVE; g(); }\nvoid h() X_OVERRIDE;\nclass A { int k() const X_OVERRIDE; @ };"
    repaired = tree_of_cpp(source.encode(), MACROS).source
    assert b"if (a) LEAVE;" in repaired


def test_what_cannot_be_told_stays_a_fault():
    facts = parse_cpp(b"int f() { return 1; }\nint @ g(;\nint h() { return 2; }", MACROS)
    assert {one.line for one in facts.faults} == {2}
    assert [one.name for one in facts.functions] == ["f", "h"]
