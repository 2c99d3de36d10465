from roslens.source.extract.ir.assigned_names import assigned_names

CPP = """
#include <std_msgs/String.h>
namespace n {
const std::string TOPIC = "t";
std::string g_set;
class A { public: void f() { x_ = 1; if (y) { z_ = 2; } } static constexpr int K = 3; };
class B : public A, public outer::C { void f(); };
void free() {}
}
"""


def test_what_names_mean(index_of):
    index = index_of(a_cpp=CPP)
    assert index.class_of("A", "pkg/a.cpp", "n").what.qualified_name == "n.A"
    assert index.class_of("A", "other.cpp", "").what.qualified_name == "n.A"
    assert index.class_of("m.A", "other.cpp", "") is None
    assert [one.what.name for one in index.functions_of("free", "pkg/a.cpp", "n")] == ["free"]
    assert index.constant("TOPIC", "pkg/a.cpp", "n.A")[1].value == "t"
    assert index.global_name("g_set", "pkg/a.cpp", "n.f") == "n.g_set"
    assert index.global_name("other", "pkg/a.cpp", "n.f") == ""


def test_classes_with_their_bases(index_of):
    index = index_of(a_cpp=CPP)
    derived = index.class_of("n.B", "pkg/a.cpp", "")
    assert [one.what.name for one in index.chain(derived)] == ["B", "A"]
    assert index.outer_bases(derived) == ["outer.C"]
    assert [one.what.name for one in index.methods(index.chain(derived)[1], "f")] == ["f"]


def test_members_that_methods_assign(index_of):
    text = "class A:\n  def __init__(self):\n    self.a = 1\n  def f(self):\n    if x:\n      self.b = 2\n"
    index = index_of(a_py=text)
    defined = index.class_of("A", "pkg/a.py", "")
    assert index.changed(defined) == {"b"}
    (method,) = index.methods(defined, "f")
    assert assigned_names(method.what.body) == {"b"}


def test_modules_of_python_are_found_by_the_end_of_their_path(index_of):
    index = index_of(a_py="class A:\n    pass\n", b_py="from pkg.a import A\n")
    assert index.class_of("A", "pkg/b.py", "").path == "pkg/a.py"


def test_packages_are_first_folders_where_nothing_else_is_said(index_of):
    assert index_of(a_cpp="").package("pkg/a.cpp") == "pkg"


def test_methods_that_are_defined_outside_of_their_namespace(index_of):
    header = "namespace a { namespace b { class C { public: C(); void f(); }; class D { public: void g(); }; } }"
    source = (
        'using a::b::C;\nusing namespace a::b;\nC::C() { g("x"); }\nvoid C::f() { g("x"); }\nvoid D::g() { g("x"); }'
    )
    index = index_of(c_hpp=header, c_cpp=source)
    for name, methods in (("C", ["C", "f"]), ("D", ["g"])):
        defined = index.class_of(name, "pkg/c.cpp", "")
        assert [one.what.name for one in index.methods_of(defined)] == methods
