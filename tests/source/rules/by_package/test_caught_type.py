"""What is thrown is judged by who catches it, and by what derives from it, in all of a package."""

import pytest

from roslens.model.finding import Severity
from roslens.source.rules.by_package.caught_type import as_notes_of_caught_types
from roslens.source.rules.hit import Hit

AGAIN = "void f() {{\n  try {{ g(); }} catch ({} & e) {{\n    throw e;\n  }}\n}}\n"
OWN = "class Fault : public std::exception {};\n"


def severity_of(rule, line, context, text, package_view, folder):
    (folder / "package.xml").write_text("<package format='3'><name>p</name></package>")
    (folder / "thrown.cpp").write_text(text)
    placed = {"thrown.cpp": [Hit(rule, "m", line, context=context)]}
    return as_notes_of_caught_types(placed, package_view(folder))["thrown.cpp"][0].severity


@pytest.mark.parametrize(
    ("thrown", "handler", "severity"),
    [
        ("std::runtime_error", "catch (std::runtime_error* e)", Severity.NOTE),
        ("std::runtime_error", "catch (const std::exception *e)", Severity.NOTE),
        ("Fault", "catch(base::Fault const* e)", Severity.NOTE),
        ("std::runtime_error", "catch (const std::runtime_error& e)", None),
        ("std::string", "catch (std::runtime_error* e)", None),
        ("std::string", "catch (std::exception* e)", None),
    ],
)
def test_a_pointer_that_a_handler_of_the_package_catches_is_meant(thrown, handler, severity, package_view, tmp_path):
    (tmp_path / "main.cpp").write_text(f"int main() {{ try {{ f(); }} {handler} {{}} }}\n")
    context = f'throw new {thrown}("x");'
    assert severity_of("cpp.throw_pointer", 1, context, context, package_view, tmp_path) is severity


@pytest.mark.parametrize(
    ("caught", "header", "severity"),
    [
        ("const Fault", OWN, Severity.NOTE),
        ("drive::Fault", OWN, Severity.NOTE),
        ("Fault", OWN + "struct Timeout final : drive::Fault { int a; };\n", None),
        ("Fault", "class Fault;\n", None),
        ("std::exception", OWN, None),
        ("rclcpp::ParameterTypeException", "", Severity.NOTE),
        ("tf2::TransformException", "", None),
    ],
)
def test_a_type_from_which_nothing_derives_is_whole_as_a_copy(caught, header, severity, package_view, tmp_path):
    (tmp_path / "fault.hpp").write_text(header)
    text = OWN.replace("Fault", "Other") + AGAIN.format(caught)
    assert severity_of("cpp.rethrow_by_name", 4, "throw e;", text, package_view, tmp_path) is severity
