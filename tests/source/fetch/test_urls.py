"""Which URLs are fetched from, and what takes their place."""

import pytest

from roslens.source.fetch.urls import UrlError, checked, rewritten, without_password


def test_the_longest_prefix_is_replaced():
    rewrites = {"https://github.com/": "file:///mirror/", "https://github.com/ros/x.git": "file:///own/x"}
    assert rewritten("https://github.com/ros/x.git", rewrites) == "file:///own/x"
    assert rewritten("https://github.com/ros/y.git", rewrites) == "file:///mirror/ros/y.git"
    assert rewritten("https://gitlab.com/ros/y.git", rewrites) == "https://gitlab.com/ros/y.git"


@pytest.mark.parametrize(
    ("given", "meant"),
    [
        ("https://github.com/ros/x.git", "https://github.com/ros/x.git"),
        ("git@github.com:ros/x.git", "ssh://git@github.com/ros/x.git"),
        ("ssh://git@host:22/x", "ssh://git@host:22/x"),
        ("file:///srv/x", "file:///srv/x"),
    ],
)
def test_what_is_fetched_from(given, meant):
    assert checked(given, files=True) == meant


@pytest.mark.parametrize(
    "url",
    [
        "git://github.com/ros/x.git",
        "ext::sh -c true",
        "ext::sh",
        "ftp://host/x",
        "/srv/x",
        "-oProxyCommand=x",
        "ssh://-oProxyCommand=x/y",
        "ssh://host/-x",
        "https:///x",
        "file://host/x",
        "https://host/a\nb",
        "https://host/a b",
        "http://[host/x",
    ],
)
def test_what_is_not(url):
    with pytest.raises(UrlError):
        checked(url, files=True)


def test_a_document_from_elsewhere_names_no_folder_of_this_machine():
    with pytest.raises(UrlError, match="a folder of this machine, in a document from elsewhere"):
        checked("file:///srv/x", files=False)


def test_git_has_a_way_round():
    with pytest.raises(UrlError, match="rewrite it to https"):
        checked("git://github.com/ros/x.git", files=True)


def test_a_password_is_not_shown():
    assert without_password("https://me:secret@host/x") == "https://me@host/x"
    assert without_password("https://host/x") == "https://host/x"
