import pytest

from roslens.source.forge.forge_place import KNOWN, Forge, ForgeKind, given_forge, place_of_url


@pytest.mark.parametrize(
    ("url", "kind", "name"),
    [
        ("https://github.com/ros/geometry2.git", ForgeKind.GITHUB, "ros/geometry2"),
        ("https://user:secret@github.com/ros/geometry2", ForgeKind.GITHUB, "ros/geometry2"),
        ("git@github.com:ros/geometry2.git", ForgeKind.GITHUB, "ros/geometry2"),
        ("ssh://git@gitlab.com/a/b/c.git", ForgeKind.GITLAB, "a/b/c"),
        ("git@codeberg.org:a/b", ForgeKind.GITEA, "a/b"),
        ("HTTPS://GitHub.com/a/b/", ForgeKind.GITHUB, "a/b"),
    ],
)
def test_where_a_remote_is(url, kind, name):
    found = place_of_url(url, KNOWN)
    assert found is not None
    assert (found.forge.kind, found.name) == (kind, name)


@pytest.mark.parametrize(
    "url",
    [
        "", "/srv/git/a.git", "file:///srv/a/b", "https://github.com.evil.org/a/b", "https://evil.org/github.com/a/b",
        "https://github.com/a", "https://github.com/a/b/c", "https://github.com/a/../b", "https://[bad/a/b", "../a/b",
        "https://github.com@evil.org/a/b", "git@evil.org:a/b", "ftp://github.com/a/b",
    ],
)  # fmt: skip
def test_what_is_on_no_forge_that_is_known(url):
    assert place_of_url(url, KNOWN) is None


def test_forges_that_the_user_names():
    assert given_forge("git.x.org=gitlab") == ("git.x.org", Forge(ForgeKind.GITLAB, "https://git.x.org/api/v4"))
    assert given_forge("http://localhost:3000/git/=gitea") == (
        "localhost",
        Forge(ForgeKind.GITEA, "http://localhost:3000/git/api/v1"),
    )
    for text in ("git.x.org", "git.x.org=cvs", "=gitlab", "ftp://x=gitlab", "https://a:b@x=gitlab"):
        with pytest.raises(ValueError, match=r"is not HOST=|is neither"):
            given_forge(text)
