"""To which package a finding belongs that was made by looking at all of them."""

from roslens.model.finding import Finding, Severity
from roslens.model.source import Language, Location, Package, SourceFile
from roslens.source.owned_findings import owned_findings


def package(name, path):
    return Package(name, name, path, Location(f"{path}/package.xml"))


PACKAGES = [package("outer", "src/outer"), package("inner", "src/outer/inner"), package("other", "src/other")]
FILES = {
    "outer": (SourceFile("src/outer/a.py", Language.PYTHON),),
    "inner": (SourceFile("src/outer/inner/b.py", Language.PYTHON),),
    "other": (),
}


def owner(path="", entity="", packages=PACKAGES, files=FILES):
    found, none = owned_findings([Finding("graph.qos", Severity.ERROR, "m", path, entity=entity)], packages, files)
    assert sum(map(len, found.values())) + len(none) == 1
    return next(iter(found), "")


def test_the_package_that_holds_the_file_has_it():
    assert owner("src/outer/a.py", "node:/x") == "outer"
    assert owner("src/outer/inner/b.py", "package:outer") == "inner"


def test_a_file_that_was_not_looked_at_is_of_the_innermost_folder():
    assert owner("src/outer/launch/x.launch") == "outer"
    assert owner("src/outer/inner/launch/x.launch") == "inner"
    assert owner("src/outermost/x.launch") == ""
    assert owner("setup.cfg", packages=[package("root", ".")], files={"root": ()}) == "root"


def test_without_a_file_it_is_of_the_package_that_it_is_about():
    assert owner(entity="package:other") == "other"
    assert owner(entity="package:none") == ""
    assert owner(entity="node:/x") == ""


def test_each_package_has_its_findings_in_their_order():
    paths = ["src/outer/a.py", "src/outer/inner/b.py", "src/outer/c.py", "x"]
    findings = [Finding("graph.qos", Severity.ERROR, "m", path) for path in paths]
    found, none = owned_findings(findings, PACKAGES, FILES)
    assert found == {"inner": (findings[1],), "outer": (findings[0], findings[2])}
    assert none == (findings[3],)
