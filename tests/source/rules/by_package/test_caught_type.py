"""What is thrown is judged by who catches it, and by what derives from it, in all of a package."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.caught_type import as_notes_of_caught_types
from roslens.source.rules.hit import Hit

AGAIN = "void f() {{\n  try {{ g(); }} catch ({} & e) {{\n    throw e;\n  }}\n}}\n"
OWN = "class Fault : public std::exception {};\n"


def certainty_of(rule, line, context, text, package_view, folder):
    (folder / "package.xml").write_text("<package format='3'><name>p</name></package>")
    (folder / "thrown.cpp").write_text(text)
    placed = {"thrown.cpp": [Hit(rule, "m", line, context=context)]}
    return as_notes_of_caught_types(placed, package_view(folder))["thrown.cpp"][0].certainty


@pytest.mark.parametrize(
    ("thrown", "handler", "certainty"),
    [
        ("std::runtime_error", "catch (std::runtime_error* e)", Certainty.HEURISTIC),
        ("std::runtime_error", "catch (const std::exception *e)", Certainty.HEURISTIC),
        ("Fault", "catch(base::Fault const* e)", Certainty.HEURISTIC),
        ("std::runtime_error", "catch (const std::runtime_error& e)", None),
        ("std::string", "catch (std::runtime_error* e)", None),
        ("std::string", "catch (std::exception* e)", None),
    ],
)
def test_a_pointer_that_a_handler_of_the_package_catches_is_meant(thrown, handler, certainty, package_view, tmp_path):
    (tmp_path / "main.cpp").write_text(f"int main() {{ try {{ f(); }} {handler} {{}} }}\n")
    context = f'throw new {thrown}("x");'
    assert certainty_of("cpp.throw_pointer", 1, context, context, package_view, tmp_path) is certainty


@pytest.mark.parametrize(
    ("caught", "header", "certainty"),
    [
        ("const Fault", OWN, Certainty.HEURISTIC),
        ("drive::Fault", OWN, Certainty.HEURISTIC),
        ("Fault", OWN + "struct Timeout final : drive::Fault { int a; };\n", None),
        ("Fault", "class Fault;\n", None),
        ("std::exception", OWN, None),
        ("rclcpp::ParameterTypeException", "", Certainty.HEURISTIC),
        ("tf2::TransformException", "", None),
    ],
)
def test_a_type_from_which_nothing_derives_is_whole_as_a_copy(caught, header, certainty, package_view, tmp_path):
    (tmp_path / "fault.hpp").write_text(header)
    text = OWN.replace("Fault", "Other") + AGAIN.format(caught)
    assert certainty_of("cpp.rethrow_by_name", 4, "throw e;", text, package_view, tmp_path) is certainty
