"""Only what roslens generated is a key or a token; no text that a person made up is, however long."""

import hashlib
import random
import secrets

import pytest

from roslens.intake.generated_secret import RANDOM_BITS, Secret, new_secret, not_generated

WORDS = [
    "correct", "horse", "battery", "staple", "robot", "arm", "gripper", "camera", "lidar", "map", "summer", "winter",
    "password", "secret", "dragon", "monkey", "welcome", "sunshine", "princess", "football", "master", "admin",
]  # fmt: skip


def passphrases(count):
    """Words, capitals, digits and dashes, up to several times the length of a key; some look like one."""
    chance = random.Random(5)
    for _ in range(count):
        words = chance.choices(WORDS, k=chance.randint(1, 20))
        text = chance.choice(["", "-", "_", " "]).join(one.title() if chance.random() < 0.5 else one for one in words)
        text += str(chance.randint(0, 99999))
        yield text
        yield chance.choice(["rlk_", "rlt_"]) + text
        yield (chance.choice(["rlk_", "rlt_"]) + text)[:55].ljust(55, "x")
        yield hashlib.sha256(text.encode()).hexdigest()


@pytest.mark.parametrize("kind", Secret)
def test_passphrases_are_refused_whatever_their_length(kind):
    assert [one for one in passphrases(5000) if not not_generated(kind, one)] == []


@pytest.mark.parametrize("kind", Secret)
def test_what_is_generated_is_taken_and_never_the_same(kind):
    made = {new_secret(kind) for _ in range(300)}
    assert len(made) == 300
    assert [one for one in made if not_generated(kind, one)] == []
    # All characters between prefix and check sum are random ones of 64: 43 of them hold 256 bits.
    assert {len(one) - len(kind.value) - 8 for one in made} == {43}
    assert RANDOM_BITS <= 43 * 6


def test_bits_come_from_the_source_of_the_system(monkeypatch):
    asked = []
    monkeypatch.setattr(secrets, "token_bytes", lambda size: asked.append(size) or bytes(size))
    new_secret(Secret.KEY)
    assert asked == [RANDOM_BITS // 8]


def test_every_changed_or_lost_character_shows():
    made = new_secret(Secret.KEY)
    wrong = [made[:at] + ("A" if made[at] != "A" else "B") + made[at + 1 :] for at in range(len(made))]
    wrong += [made[:at] + made[at + 1 :] for at in range(len(made))] + [made + "0", made + made]
    assert [one for one in wrong if not not_generated(Secret.KEY, one)] == []
    assert "check sum is wrong: something of it was changed or left out" in not_generated(Secret.KEY, made[:-1])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "an empty key"),
        ("hunter2", "a key of 7 characters that roslens did not generate"),
        ("0f" * 32, "did not generate, as earlier versions wrote and as the hash of a passphrase looks"),
        ("rlt_" + "0" * 51, "a token where a key is needed"),
    ],
)
def test_what_is_wrong_is_said_without_the_secret(text, said):
    found = not_generated(Secret.KEY, text)
    assert said in found
    assert not text or text not in found
