"""Calibration profiles: found, inspected, distrusted, and never able to change an answer."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
import sys

import pytest
from samples import rays, same_bits, soup

import raywise
from raywise import _declarations as c
from raywise._errors import status_text


def in_a_process(environment: "dict[str, str]", program: str) -> str:
    """What a program prints that looks for its profile anew: a process does so once."""
    done = subprocess.run(
        [sys.executable, "-c", "import raywise\n" + program],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def test_a_profile_is_found_once_and_kept(tmp_path: pathlib.Path) -> None:
    broken = tmp_path / "broken.json"
    broken.write_text("{")
    shown = in_a_process(
        {"RAYWISE_CALIBRATION": str(broken), "XDG_CACHE_HOME": str(tmp_path)},
        "import os\n"
        "for _ in range(2):\n"
        "    profile = raywise.profile()\n"
        "    print(profile.status, profile.source)\n"
        "    print(profile.status_text)\n"
        "    print('passed over' in str(profile), 'generic constants' in str(profile))\n"
        "    os.environ['RAYWISE_CALIBRATION'] = 'builtin'\n",
    )
    text = "a calibration profile was passed over: it is truncated or malformed"
    assert shown.splitlines() == [f"{c.RW_PROFILE_MALFORMED} generic", text, "True True"] * 2


def test_the_words_of_no_status_say_what_is_used_instead() -> None:
    statuses = [value for name, value in vars(c).items() if name.startswith("RW_PROFILE_") and "SOURCE" not in name]
    texts = [status_text(status) for status in statuses]
    assert len(texts) == 7 and all(text.startswith("a calibration profile was passed over: ") for text in texts)
    assert not any("generic" in text for text in texts)


def test_the_generic_constants_are_always_there() -> None:
    with raywise.profile() as profile:
        assert profile.source == "generic" and profile.machine == "generic" and profile.path == ""
        assert profile.status == c.RW_OK and profile.status_text
        assert profile.epoch >= 1 and profile.spread >= 0 and profile.threads >= 0
        assert isinstance(profile.date, str) and isinstance(profile.tool, str)
        assert "generic" in repr(profile)


def test_a_profile_can_be_read() -> None:
    profile = raywise.profile()
    assert str(profile).strip()
    assert isinstance(profile.json, dict) and profile.json
    json.dumps(profile.json)


def test_a_missing_file_is_an_error_or_a_fallback(tmp_path: pathlib.Path) -> None:
    with pytest.raises(raywise.ProfileNotFound) as caught:
        raywise.profile(tmp_path / "missing.json")
    assert isinstance(caught.value, FileNotFoundError) and "missing.json" in str(caught.value)
    profile = raywise.profile(tmp_path / "missing.json", fallback=True)
    assert profile.status == c.RW_PROFILE_NOT_FOUND and profile.source == "generic"


@pytest.mark.parametrize("text", ["", "{", "[]", '{"schema": 1', "not json"])
def test_a_broken_file_is_an_error_or_a_fallback(tmp_path: pathlib.Path, text: str) -> None:
    path = tmp_path / "broken.json"
    path.write_text(text)
    with pytest.raises(raywise.ProfileError) as caught:
        raywise.profile(path)
    assert caught.value.status >= c.RW_PROFILE_NOT_FOUND
    profile = raywise.profile(str(path), fallback=True)
    assert profile.status == caught.value.status and profile.source == "generic"


def test_a_profile_of_its_own_text_is_accepted_or_says_why(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "copy.json"
    path.write_text(json.dumps(raywise.profile().json))
    profile = raywise.profile(path, fallback=True)
    assert profile.source == ("path" if profile.status == c.RW_OK else "generic")


def test_scenes_can_be_given_a_profile() -> None:
    profile = raywise.profile()
    mesh, batch = soup(5, 200), rays(1, 200)
    expected = raywise.Scene(*mesh).intersect(*batch)
    scene = raywise.Scene(*mesh, profile=profile)
    once = raywise.intersect_once(mesh, *batch, profile=profile)
    profile.close()
    same_bits(scene.intersect(*batch), expected)
    same_bits(once, expected)
