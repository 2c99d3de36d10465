from roslens.store.cache import Cache, FileStat
from roslens.store.content_cache import ContentCache

NOW_S = 2e9
STAT = FileStat(1, 1, 1, "abc", "python", "own", "")


def test_contents_are_shared_and_paths_left_alone(tmp_path):
    path = tmp_path / "cache.sqlite"
    with Cache.open(path, now_s=NOW_S) as cache:
        cache.put_stats({"a.py": STAT}, now_s=NOW_S)
        cache.put({"key": b"1"})
    with ContentCache.open(path, now_s=NOW_S) as elsewhere:
        assert elsewhere.stats(now_s=NOW_S) == {}
        assert elsewhere.get(["key"]) == {"key": b"1"}
        elsewhere.put_stats({"a.py": FileStat(2, 2, 2, "def", "python", "own", "")}, now_s=NOW_S)
        elsewhere.forget(["a.py"])
        elsewhere.put({"other": b"2"})
    with Cache.open(path, now_s=NOW_S) as cache:
        assert cache.stats(now_s=NOW_S) == {"a.py": STAT}
        assert set(cache.get(["key", "other"])) == {"key", "other"}
