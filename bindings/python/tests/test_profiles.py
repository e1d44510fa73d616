"""Calibration profiles: found, inspected, distrusted, and never able to change an answer."""

from __future__ import annotations

import json
import pathlib

import pytest
from samples import rays, same_bits, soup

import raywise
from raywise import _declarations as c


@pytest.fixture(autouse=True)
def no_profile_of_this_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RAYWISE_CALIBRATION", "builtin")


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
