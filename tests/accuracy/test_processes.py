import sys

import pytest

from accuracy.processes import Processes


@pytest.mark.timed
def test_processes_end_with_the_block_and_their_words_are_kept(tmp_path):
    with Processes(tmp_path) as processes:
        said = processes.start([sys.executable, "-c", "print('here')"], {})
        said.wait(30)
        stays = processes.start([sys.executable, "-c", "input() if 0 else __import__('signal').pause()"], {})
        assert "here" in processes.told()
        assert stays.poll() is None
    assert stays.poll() is not None
