"""The key of a journal: from the secret of this user and the folder of the journal, so that it opens no other."""

from __future__ import annotations

import hmac
import os
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

from roslens.intake.user_folder import user_folder, user_secret
from roslens.store.journals.signing import Signing


def journal_signing(path: Path, environment: Mapping[str, str]) -> Signing:
    """Return what the journal at ``path`` is signed with."""
    place = path.resolve()
    key = hmac.digest(user_secret(environment), b"journals of roslens in\0" + os.fsencode(place.parent), "sha256")
    name = sha256(os.fsencode(place)).hexdigest()[:32]
    return Signing(key, user_folder(environment) / "journals" / name)
