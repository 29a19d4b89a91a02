"""Where a mission's socket lies, and which folders are not to be trusted with one."""

import os
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.errors import OutputError
from fieldnav.operator.socket_place import LONGEST_PATH_BYTES, SocketPlace, socket_path


def test_the_users_runtime_folder_is_used_where_there_is_one(place: SocketPlace) -> None:
    assert place.make() == Path(place.environment["XDG_RUNTIME_DIR"]) / "fieldnav"


@pytest.mark.parametrize("runtime", ["", "relative/folder", "/nowhere/at/all", "/dev/null", "\0"])
def test_without_a_fine_runtime_folder_the_temporary_one_is_used(place: SocketPlace, runtime: str) -> None:
    elsewhere = replace(place, environment={"XDG_RUNTIME_DIR": runtime})
    assert elsewhere.make() == place.temporary / f"fieldnav-{os.getuid()}"


def test_a_runtime_folder_open_to_others_is_not_used(place: SocketPlace) -> None:
    Path(place.environment["XDG_RUNTIME_DIR"]).chmod(0o755)
    assert place.make() == place.temporary / f"fieldnav-{os.getuid()}"


def test_a_runtime_folder_too_deep_for_a_socket_is_not_used(place: SocketPlace) -> None:
    deep = place.temporary / ("d" * LONGEST_PATH_BYTES)
    deep.mkdir(mode=0o700)
    assert replace(place, environment={"XDG_RUNTIME_DIR": str(deep)}).make().parent == place.temporary


def test_a_folder_of_another_user_is_refused_in_one_line(place: SocketPlace) -> None:
    other = replace(place, user=os.getuid() + 1)
    other.folders[-1].mkdir(mode=0o700)  # by us, who are not that user
    with pytest.raises(
        OutputError, match=f"belongs to user {os.getuid()}; allowed is {other.user}"
    ) as caught:
        other.make()
    assert "\n" not in str(caught.value)


def test_a_folder_that_others_may_enter_is_refused_with_its_remedy(place: SocketPlace) -> None:
    place.folders[0].mkdir()
    place.folders[0].chmod(0o750)
    with pytest.raises(OutputError, match=r"mode 0750 lets others in; allowed is 0700: chmod 700 "):
        place.make()


def test_a_link_in_the_folders_place_is_refused(place: SocketPlace, tmp_path: Path) -> None:
    place.folders[0].symlink_to(tmp_path)
    with pytest.raises(OutputError, match="is no folder"):
        place.make()


def test_a_folder_that_cannot_be_made_is_one_clear_line(place: SocketPlace) -> None:
    nowhere = SocketPlace(place.user, place.temporary / "not" / "there", {})
    with pytest.raises(OutputError, match="cannot be made for the operator's socket: No such file"):
        nowhere.make()


@given(st.text(st.characters(exclude_characters="/\0", exclude_categories=["Cs"]), min_size=1, max_size=300))
def test_every_runs_socket_fits_and_is_its_own(run: str) -> None:
    folder = Path("/run/user/1000/fieldnav")
    path = socket_path(folder, run)
    assert len(os.fsencode(path)) <= LONGEST_PATH_BYTES
    assert path.parent == folder
    assert path != socket_path(folder, f"{run}-2")


def test_a_folder_too_long_for_any_socket_is_one_clear_line() -> None:
    with pytest.raises(OutputError, match="too long for a socket; allowed are 107 bytes"):
        socket_path(Path("/" + "d" * 100), "run")
