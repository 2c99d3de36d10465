"""What is found in what is no longer used, and in backups, is a note."""

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.by_package.left_behind import as_notes_where_left_behind
from roslens.source.rules.hit import Hit


@pytest.mark.parametrize(
    ("path", "is_note"),
    [
        ("p/src/OLD/a.cpp", True),
        ("deprecated/tools/a.py", True),
        ("not_for_build/p/a.cpp", True),
        ("p/src/old.cpp", False),
        ("p/src/threshold/a.cpp", False),
        ("p/src/a.cpp", False),
        ("p/launch/LEGACY_LAUNCHERS/a.launch", True),
        ("p/config/legacy_params_no_longer_used/a.yaml", True),
        ("p/scripts/bkup_working/a.py", True),
        ("p/motors_backup/a.cpp", True),
        ("p/arm_old/a.cpp", True),
        ("p copy/a.cpp", True),
        ("p/scripts/drive (copy).py", True),
        ("p/scripts/drive copy 2.py", True),
        ("p/scripts/drive - Copy.py", True),
        ("p/src/zero_copy.cpp", False),
        ("p/zero_copy/a.cpp", False),
        ("p/household/a.cpp", False),
        ("p/old_town_map/a.cpp", False),
    ],
)
def test_the_name_of_a_folder_says_so(path, is_note):
    (only,) = as_notes_where_left_behind({path: [Hit("cpp.guard", "m", 1)]})[path]
    assert (only.certainty is Certainty.HEURISTIC) is is_note


@pytest.mark.parametrize(
    ("path", "names", "is_note"),
    [
        ("p/scripts/drive_old.py", {"drive_old.py", "drive.py"}, True),
        ("p/scripts/drive_old1.py", {"drive_old1.py", "drive.py"}, True),
        ("p/launch/rsp_original.launch.py", {"rsp_original.launch.py", "rsp.launch.py"}, True),
        ("p/launch/sick.launch_old.py", {"sick.launch_old.py", "sick.launch.py"}, True),
        ("p/scripts/backup_drive.py", {"backup_drive.py", "drive.py"}, True),
        ("p/config/arm(old).yaml", {"arm(old).yaml", "arm.yaml"}, True),
        ("p/scripts/drive_old.py", {"drive_old.py", "drive.cpp"}, False),
        ("p/scripts/backup_recovery.py", {"backup_recovery.py"}, False),
        ("p/scripts/threshold.py", {"threshold.py", "thresh.py"}, False),
    ],
)
def test_an_earlier_version_is_one_only_beside_a_later_one(path, names, is_note):
    (only,) = as_notes_where_left_behind({path: [Hit("cpp.guard", "m", 1)]}, names)[path]
    assert (only.certainty is Certainty.HEURISTIC) is is_note
