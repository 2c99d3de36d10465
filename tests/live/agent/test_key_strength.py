import base64
import random

import pytest

from roslens.live.agent.key_strength import weakness

FORMS = {
    "hexadecimal": lambda raw: raw.hex().encode(),
    "capitals": lambda raw: raw.hex().upper().encode(),
    "base64": base64.b64encode,
    "in URLs": lambda raw: base64.urlsafe_b64encode(raw).rstrip(b"="),
    "raw": lambda raw: b"\xff" + raw,
}


@pytest.mark.parametrize("form", FORMS)
def test_what_is_random_is_a_key(form):
    chance = random.Random(5)
    refused = sum(bool(weakness(FORMS[form](chance.randbytes(32)))) for _ in range(500))
    # Of base64 one key in 7,000 has neither a digit nor a sign.
    assert refused <= (1 if form in ("base64", "in URLs") else 0)


@pytest.mark.parametrize("bits", [8, 64, 128, 248])
@pytest.mark.parametrize("form", FORMS)
def test_fewer_than_256_bits_are_no_key(form, bits):
    assert weakness(FORMS[form](random.Random(5).randbytes(bits // 8 - (form == "raw")))).startswith("a key of")


@pytest.mark.parametrize(
    "text",
    [
        b"hunter2",
        b"a key of more than sixteen bytes, and of more than sixty-four besides: no",
        "ein Schl\u00fcssel, den man sich merken kann, und der deshalb keiner ist".encode(),
        b"correcthorsebatterystaplecorrecthorsebatterystaple",
        b"CorrectHorseBatteryStapleIsAFineOldPasswordForRobots",
        b"0" * 64,
        b"0123456789abcdef" * 4,
        b"deadbeef" * 8,
        b"Robot7Robot7Robot7Robot7Robot7Robot7Robot7Robot7",
        b"\xff\x00" * 20,
        b"",
    ],
)
def test_what_people_type_is_no_key(text):
    assert weakness(text)
